"""Differences between entry points of the package for a contact, as texts; none if they agree.

``python agreement.py COUNT SEED`` prints the differences of as many random contacts.
"""

from __future__ import annotations

import contextlib
import io
import json
import math
import sys
import tempfile
import warnings
from pathlib import Path
from typing import Any

import numpy as np

import ehlwave
from ehlwave.app.contacts import Given
from ehlwave.app.task import Task, answered
from ehlwave.cli import main
from ehlwave.errors import RangeError, ResultsError
from ehlwave.programs.case_input import case_keys, case_text
from studies.judged.drawn_contacts import Drawn, drawn

OF_AI = 1e-3
"""Largest difference of a deformed cosine and the response, over Ai."""
POINTS = 64
"""Points of a wave along each direction."""


def cosine(wavelength_m: float, angle_deg: float, shortest_m: float) -> ehlwave.surface.Surface:
    """Return a small periodic cosine, long enough for a contact, of 1e-11 m."""
    turn = math.radians(angle_deg)
    lengths = [
        wavelength_m / share if share > 1e-9 else math.inf
        for share in (math.cos(turn), math.sin(turn))
    ]
    waves = [max(1, math.ceil(shortest_m / length)) for length in lengths]
    phases = [
        2 * np.pi * np.arange(POINTS * count) / POINTS if math.isfinite(length) else np.zeros(1)
        for count, length in zip(waves, lengths, strict=True)
    ]
    height = 1e-11 * np.cos(phases[0][:, None] + phases[1][None, :])
    steps = [length / POINTS if math.isfinite(length) else 0.0 for length in lengths]
    return ehlwave.surface.Surface(height, steps[0], steps[1], "cosine")


def response_differences(one: Drawn) -> list[str]:
    """Return the differences between the response to a wave and the deformed cosine."""
    contact = one.contact()
    conditions = contact.conditions
    a_m, b_m = conditions.semi_axis_a_m, conditions.semi_axis_b_m
    longest = a_m if conditions.is_line else max(a_m, b_m)
    surface = cosine(one.wavelength_over_a * a_m, one.angle_deg, 0.2 * longest)
    wave = {"wavelength_over_a": one.wavelength_over_a, "angle_deg": one.angle_deg}
    try:
        found = contact.response(**wave, by="laws")
    except RangeError as error:
        return _not_refused(contact, surface, str(error))
    try:
        deformed = contact.deform(surface, by="laws", form="none", ends="none")
    except RangeError as error:
        return [] if _has_no_film(contact) else [f"response, but deform is refused: {error}"]
    before, after = (np.fft.fft2(heights) for heights in (surface.height, deformed.height))
    place = np.unravel_index(np.argmax(np.abs(before) * _is_forward(before.shape)), before.shape)
    ratio = after[place] / before[place]
    differences = []
    if not abs(ratio - found.film) <= OF_AI:
        differences.append(f"film {found.film:.5f}, deformed {ratio:.5f}")
    rms = float(np.sqrt(np.mean(surface.height**2)))
    error = None if deformed.error_m is None else deformed.error_m / rms
    if error is None or not math.isclose(error, found.error, rel_tol=1e-3, abs_tol=1e-6):
        differences.append(f"error {found.error:.5g}, of the deformed {error}")
    return differences


def _has_no_film(contact: ehlwave.Contact) -> bool:
    """Return whether no law has the film, which statistics of a surface need."""
    try:
        contact.film(by="laws")
    except RangeError:
        return True
    return False


def _is_forward(shape: tuple[int, ...]) -> Any:  # noqa: ANN401
    """Return where both wave numbers are not negative."""
    forward = [np.arange(count) <= count // 2 for count in shape]
    return forward[0][:, None] & forward[1][None, :]


def _not_refused(
    contact: ehlwave.Contact, surface: ehlwave.surface.Surface, reason: str
) -> list[str]:
    """Return a difference where a surface is judged whose wave has no response."""
    try:
        deformed = contact.deform(surface, by="laws", form="none", ends="none")
    except RangeError:
        return []
    return [] if deformed.unjudged else [f"deformed, but the response is refused: {reason}"]


def door_answers(one: Drawn, folder: Path) -> dict[str, tuple[Any, ...]]:
    """Return central film, um, its error and the warnings by every door."""
    contact = one.contact()
    a_m = contact.conditions.semi_axis_a_m
    surface = cosine(a_m, 0.0, a_m)
    np.save(folder / "trace.npy", surface.height[:, 0])
    found: dict[str, tuple[Any, ...]] = {}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            film = contact.film(by="laws")
        except RangeError:
            film = None
    said = {str(one.message) for one in caught}
    found["film"] = (*_film(film and film.central_m, film and film.central_error), said)
    c = contact.conditions
    found["conditions"] = (*_film(c.central_film_m, c.central_film_error), None)
    options: dict[str, Any] = {"form": "none", "ends": "none", "by": "laws"}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with contextlib.suppress(RangeError):
            deformed = contact.deform(surface, **options)
            found["deform"] = _of_conditions(deformed)
            pair = contact.deform_pair(surface, surface, **options)
            found["deform_pair"] = _of_conditions(pair.first)
    found |= _command(one, folder, surface)
    found |= _page(one)
    return found


def _of_conditions(deformed: Any) -> tuple[Any, ...]:  # noqa: ANN401
    c = deformed.conditions
    said = [text for text in deformed.warnings if _is_of_film(text)]
    return (*_film(c.central_film_m, c.central_film_error), set(said))


def _is_of_film(text: str) -> bool:
    return text.startswith(("the inlet would warm", "large errors"))


def _film(central_m: float | None, error: float | None) -> tuple[float | None, float | None]:
    known = central_m is not None and error is not None
    return (float(f"{central_m * 1e6:.9g}"), float(f"{error:.9g}")) if known else (None, None)


def _command(
    one: Drawn, folder: Path, surface: ehlwave.surface.Surface
) -> dict[str, tuple[Any, ...]]:
    """Return the answer of ``ehlwave lambda --json`` for the input file of the contact."""
    contact = one.contact()
    (folder / "contact.nml").write_text(
        case_text(case_keys(contact.conditions, contact.heat)), encoding="utf-8"
    )
    words = ["lambda", str(folder / "trace.npy"), "--conditions", str(folder / "contact.nml")]
    words += ["--length-unit", "m", "--height-unit", "m", "--step", repr(surface.step_x_m)]
    words += ["--form", "none", "--ends", "none", "--json", "--by", "laws"]
    text = io.StringIO()
    with contextlib.redirect_stdout(text), contextlib.redirect_stderr(io.StringIO()):
        status = main(words)
    if status != 0:
        return {}
    document = json.loads(text.getvalue())
    c = document["conditions"]
    said = {text for text in document["warnings"] if _is_of_film(text)}
    return {"lambda": (*_film(c["central_film_m"], c["central_film_error"]), said)}


def _page(one: Drawn) -> dict[str, tuple[Any, ...]]:
    """Return the answer of the page, which has the same keys."""
    keys = dict(one.keys) | ({"heat": one.contact().heat} if one.heat else {})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            answer = answered(Task(Given(keys), options={"by": "laws"}))
        except ResultsError:
            return {}
    film = answer.film
    central = _film(film and film.central_m, film and film.central_error)
    return {"page": (*central, set(answer.warnings))}


def door_differences(one: Drawn) -> list[str]:
    """Return the entry points whose film, error or warnings differ from ``film()``."""
    with tempfile.TemporaryDirectory() as folder:
        found = door_answers(one, Path(folder))
    film, error, said = found["film"]
    expected = {"lambda"} if "deform" in found else set()
    if film is not None:
        expected.add("page")
    differences = [f"{door}: no answer" for door in sorted(expected - set(found))]
    for door, (own, own_error, own_said) in found.items():
        if (own, own_error) != (film, error):
            differences.append(f"{door}: {own} +- {own_error}, film(): {film} +- {error}")
        if own_said is not None and own_said != said:
            differences.append(f"{door}: warnings {own_said}, film(): {said}")
    return differences


def differences(count: int, seed: int) -> dict[int, list[str]]:
    """Return all differences of random contacts, by their numbers."""
    found: dict[int, list[str]] = {}
    for number, one in enumerate(drawn(count, seed)):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            texts = response_differences(one) + door_differences(one)
        if texts:
            found[number] = [f"{one}", *texts]
    return found


if __name__ == "__main__":
    counts = [int(word) for word in sys.argv[1:3]]
    bad = differences(*counts)
    for lines in bad.values():
        print("\n  ".join(lines))
    print(f"{counts[0] - len(bad)} of {counts[0]} contacts agree")
