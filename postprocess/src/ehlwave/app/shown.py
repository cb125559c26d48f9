"""Answers as HTML: a line first, then numbers with their errors, then parts not judged."""

import base64
import math
from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass
from html import escape
from typing import Any

from ehlwave.app.messages import plain, words
from ehlwave.app.task import DOTS_PER_INCH, Answer
from ehlwave.shown import percent, spread, spread_of, within
from ehlwave.surface.answer import answer_of
from ehlwave.surface.narrower import narrower
from ehlwave.surface.predict import Deformed
from ehlwave.surface.report import report_text

UM = 1e6
NOT_KNOWN = "Not available"
"""Row of the results that an answer does not have."""

SHOWN_PER_INCH = 130
"""Pixels of the page."""


def decided(answer: Answer) -> str:
    """Return whether an answer is decided: "decided", "open" or "neutral" (films alone)."""
    found = answer.found
    if found is None or found.statistics.lambda_ratio_after is None:
        return "neutral"
    judged = answer_of(found.statistics)
    is_decided = len(judged.regimes) == 1 and not (judged.extrapolated or judged.surfaces_touch)
    return "decided" if is_decided else "open"


def advice(answer: Answer) -> str:
    """Return the step that would narrow the error, '' where none is needed."""
    step = "" if answer.found is None else narrower(answer.found)
    return f"<p class='note'>To narrow the error: {escape(plain(step))}</p>" if step else ""


def headline(answer: Answer) -> str:
    """Return the answer in one sentence or two."""
    film, found = answer.film, answer.found
    if found is not None and (first := report_text(found).splitlines()[0]).startswith("Answer "):
        said = escape(first.removeprefix("Answer").strip())
        head, mark, rest = said.partition(", ")
        return f"<b>{head}</b>{mark}{rest}"
    if found is not None and found.statistics.lambda_ratio_after is not None:
        s = found.statistics
        error = "error not known"
        if s.lambda_error is not None:
            error = spread_of(s.lambda_ratio_after, s.lambda_error)
        return (
            f"<b>Lambda ratio {s.lambda_ratio_after:.4g}</b> {error}, with the roughness as it is "
            f"deformed in the contact ({s.lambda_ratio_before:.4g} with the undeformed one). "
            f"<b>Film {s.mean_film_m * UM:.4g} um</b>, {_least(found)}."
        )
    if film is None:
        return ""
    central, least, unit = film.central_moes, film.minimum_moes, " in the Moes scale"
    if film.central_m is not None:
        central, least, unit = film.central_m * UM, (film.minimum_m or math.nan) * UM, " um"
    thinnest = "the smallest film is not known"
    if math.isfinite(least):
        thinnest = f"{within(least, film.minimum_error, unit)} at the thinnest place"
    error = spread_of(central, film.central_error, unit)
    return f"<b>Film {central:.4g}{unit}</b> {error} at the contact centre, {thinnest}."


def tables(answer: Answer) -> dict[str, list[tuple[str, str]]]:
    """Return names and values of all results, by the title of their table."""
    found = {"Contact": contact_rows(answer.contact)}
    film = answer.film
    if film is not None:
        rolls = answer.contact.conditions.rolls
        found["Smooth contact"] = list(rows(film, ("friction",) if rolls else ()))
        if rolls:
            found["Smooth contact"].append(("Friction coefficient", "0 in pure rolling"))
        if film.heated is not None:
            # Friction and films stand in the table above, with a single error each.
            hidden = [one.name for one in fields(film.heated) if "error" in one.name]
            hidden.append("friction")
            found["With heat"] = list(rows(film.heated, hidden))
    if answer.found is not None:
        found["Surface in the contact"] = list(rows(answer.found.statistics))
    return found


def numbers(answer: Answer) -> str:
    """Return tables of contact, film and the statistics of the surface."""
    parts = [table(title, lines) for title, lines in tables(answer).items()]
    if answer.outside:
        parts.append(f"<p class='note'>{escape(plain(answer.outside))}</p>")
    return "".join(parts)


def contact_rows(contact: Any) -> list[tuple[str, str]]:  # noqa: ANN401
    """Return Hertz pressure, semi-axes and Moes parameters of a contact."""
    c = contact.conditions
    found = [("Hertz pressure", f"{c.hertz_pa / 1e9:.4g} GPa")]
    if math.isfinite(c.semi_axis_a_m or math.nan):
        found.append(("Semi-axis a, along rolling", f"{c.semi_axis_a_m * UM:.4g} um"))
        if not c.is_line:
            found.append(("Semi-axis b, across", f"{c.semi_axis_b_m * UM:.4g} um"))
    return [*found, ("M, L, D", f"{c.m:.4g}, {c.l:.4g}, {c.d:.4g}")]


def compared(first: Answer, second: Answer) -> str:
    """Return the results of two variants side by side, with the changes."""
    left, right = tables(first), tables(second)
    heads = ("", "kept variant", "new variant", "change")
    head = f"<tr>{''.join(f'<td><b>{one}</b></td>' for one in heads)}</tr>"
    parts = []
    for title in dict.fromkeys([*left, *right]):
        a, b = dict(left.get(title, [])), dict(right.get(title, []))
        lines = "".join(
            f"<tr><th scope='row'>{escape(name)}</th><td>{_cell(a.get(name, '-'))}</td>"
            f"<td>{_cell(b.get(name, '-'))}</td>"
            f"<td>{_cell(change(a.get(name, ''), b.get(name, '')))}</td></tr>"
            for name in dict.fromkeys([*a, *b])
            if name not in ("Source", NOT_KNOWN)
        )
        parts.append(f"<table><caption>{escape(title)}</caption>{head}{lines}</table>")
    return "".join(parts)


def _cell(text: str) -> str:
    """Return a value as HTML; numbers stay in one line with their percent signs."""
    return escape(text).replace(" %", "&nbsp;%")


def change(before: str, after: str) -> str:
    """Return the relative change from one value of a table to another, '' where it has none."""
    if before.endswith("%") and "within" not in before:
        return ""  # an error
    try:
        old, new = float(before.split()[0]), float(after.split()[0])
    except (IndexError, ValueError):
        return ""
    return f"{100 * (new / old - 1):+.3g} %" if old and new != old else ""


def rows(part: Any, hidden: Iterable[str] = ()) -> Iterable[tuple[str, str]]:  # noqa: ANN401
    """Yield name and value, with unit and error, of every known field of a result."""
    values = {one.name: getattr(part, one.name) for one in fields(part)}
    values = {name: value for name, value in values.items() if name not in (*hidden, "warnings")}
    errors = {name: _error_name(name) for name in values}
    joined = {error for error in errors.values() if error in values}
    unknown = []
    for name, value in values.items():
        if isinstance(value, Mapping):
            yield from ((f"{words(name)}: {key}", percent(v)) for key, v in value.items())
        elif value is None or (isinstance(value, float) and math.isnan(value)):
            unknown += [words(name)] if name not in joined else []
        elif not is_dataclass(value) and name not in joined:
            error = values.get(errors[name])
            said = _value(name, value)
            if isinstance(error, float):
                said += f" {spread(error, _value(name, value * (1 + error)))}"
            yield words(name), said
    unknown = [name for name in unknown if name != words("heated")]
    if unknown:
        yield NOT_KNOWN, ", ".join(unknown)


def _error_name(name: str) -> str:
    """Return the name of the error that stands beside a quantity."""
    stem = name
    for end in ("_coefficient", "_ratio_after", "_moes", "_m"):
        stem = stem.removesuffix(end)
    return f"{stem}_error"


def table(title: str, lines: Iterable[tuple[str, str]]) -> str:
    """Return a table of two columns."""
    body = "".join(
        f"<tr><th scope='row'>{escape(name)}</th><td>{_cell(text)}</td></tr>"
        for name, text in lines
    )
    return f"<table><caption>{escape(title)}</caption>{body}</table>"


def doubts(found: Deformed) -> str:
    """Return the waves that the law does not cover: whether they are extrapolated or kept."""
    lines = [
        f"{group.components:,} waves {group.reason}: {100 * group.share_before:.3g} % of the mean "
        f"square of the roughness outside the contact, {100 * group.share_after:.3g} % inside"
        for group in found.unjudged
    ]
    listed = "".join(f"<li>{escape(line)}</li>" for line in lines)
    return f"<h3>Waves outside the law</h3><ul>{listed or '<li>None.</li>'}</ul>"


def warnings_of(answer: Answer) -> str:
    """Return the warnings about film and surface."""
    return "".join(
        f"<p class='note'>Warning: {escape(plain(line))}</p>" for line in answer.warnings
    )


def report(found: Deformed) -> str:
    """Return the report of the command line."""
    return f"<pre>{escape(report_text(found))}</pre>"


def pictures(answer: Answer) -> str:
    """Return the figures."""
    return "".join(
        f"<figure><img alt='{escape(title)}' style='max-width: {_width(png)}px' "
        f"src='data:image/png;base64,{base64.b64encode(png).decode()}'>"
        f"<figcaption>{escape(title)}</figcaption></figure>"
        for title, png in answer.pictures.items()
    )


def _width(png: bytes) -> int:
    """Return the display width of a picture in pixels, from its header."""
    return round(int.from_bytes(png[16:20], "big") / DOTS_PER_INCH * SHOWN_PER_INCH)


def _least(found: Deformed) -> str:
    least = found.statistics.minimum_film_m
    return "the surfaces touch" if least is None else f"smallest {least * UM:.4g} um"


def _value(name: str, value: Any) -> str:  # noqa: ANN401
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not isinstance(value, (int, float)):
        return str(value)
    if name.endswith("_error"):
        return percent(value)
    if name.endswith("_m"):
        return f"{value * UM:.4g} um"
    if name.endswith("_pa"):
        return f"{value / 1e9:.4g} GPa"
    if name.endswith("_k"):
        return f"{value:.4g} K"
    return f"{value:.4g}"


def old(text: str) -> str:
    """Return an answer, marked as outdated after a change of the input."""
    return f"<p class='old'>Something was changed: press Compute again.</p>{text}"
