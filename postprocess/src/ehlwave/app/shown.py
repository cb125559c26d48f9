"""Answers as HTML: a line first, then numbers with their errors, then parts not judged."""

import base64
import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass
from html import escape
from typing import Any

from ehlwave.app.element_quantities import TABS
from ehlwave.app.quantities import every_quantity
from ehlwave.app.task import DOTS_PER_INCH, Answer
from ehlwave.shown import split_words
from ehlwave.surface.answer import answer_of
from ehlwave.surface.narrower import narrower
from ehlwave.surface.predict import Deformed
from ehlwave.surface.report import report_text

UM = 1e6
LABELS = {one.key: one.label for one in every_quantity()} | {
    one.key: one.label
    for tab in TABS.values()
    for asked in tab.values()
    for p in asked
    for one in p
}
"""Labels of the fields of all tabs by their keys."""
SHOWN_PER_INCH = 130
"""Pixels of the page."""
NAMES = {
    "central_m": "Central film",
    "minimum_m": "Minimum film",
    "central_moes": "Central film (Moes)",
    "minimum_moes": "Minimum film (Moes)",
    "central_error": "Error of the central film",
    "minimum_error": "Error of the minimum film",
    "friction": "Friction coefficient",
    "rolling_resistance": "Rolling resistance, N (line: N/m)",
    "rolling_resistance_coefficient": "Rolling resistance over load",
    "film_factor": "Film with heat over film without",
    "inlet_factor": "of it by the warm inlet",
    "minimum_factor": "Minimum film with heat over film without",
    "isothermal_friction": "Friction coefficient without heat",
    "rise_mid_film_k": "Temperature rise, mid-film",
    "rise_surfaces_k": "Temperature rise, surfaces",
    "rq_before_m": "Rq outside the contact",
    "rq_after_m": "Rq in the contact",
    "rz_before_m": "Lowest to highest point, outside",
    "rz_after_m": "Lowest to highest point, in the contact",
    "mean_film_m": "Mean film",
    "mean_rise_m": "Rise of the mean film by the roughness",
    "minimum_film_m": "Smallest film",
    "surfaces_touch": "Surfaces touch",
    "lambda_ratio_before": "Lambda ratio, roughness as made",
    "lambda_ratio_after": "Lambda ratio, roughness in the contact",
    "lambda_errors": "Part of the lambda error",
    "lambda_error": "Lambda error",
    "amplitude_over_film": "Amplitude over film",
}
"""Names of results on the page."""

PLAIN = (
    (r"give heat data \(heat=\)", "choose 'with heat' under Film and friction"),
    (r"\s*\(manual: [^)]*\)", ""),
    (r"\s*\(\w+=\)", ""),
    (r"^(?:Contact|Body|Oil|Heat)(?:\.\w+)?: ", ""),
    (r"\b(?:ehlwave\.)?(?:Contact|Body|Oil|Heat)\.(\w+)(?:\(\))?", r"\1"),
    (r"""\b(\w+)=(["'])(\w+)\2""", r"\1 = \3"),
    (r"\b(\w+)=(?=[\s,;.:)]|$)", r"\1"),
    (r"(?<!\w)--(\w)", r"\1"),
)
"""Python of messages, and its replacement on the page."""

SYMBOLS = {"rq": "Rq", "rz": "Rz", "lambda": "Lambda"}


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
        error = "error not known" if s.lambda_error is None else f"within {_share(s.lambda_error)}"
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
        thinnest = f"{least:.4g}{unit} within {_share(film.minimum_error)} at the thinnest place"
    return (
        f"<b>Film {central:.4g}{unit}</b> within {_share(film.central_error)} at the contact "
        f"centre, {thinnest}."
    )


def tables(answer: Answer) -> dict[str, list[tuple[str, str]]]:
    """Return names and values of all results, by the title of their table."""
    found = {"Contact": contact_rows(answer.contact)}
    film = answer.film
    if film is not None:
        found["Smooth contact"] = list(rows(film))
        if film.heated is not None:
            # Friction and films stand in the table above, with one error each.
            hidden = ("friction", "film_error", "minimum_error")
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
    parts = []
    for title in dict.fromkeys([*left, *right]):
        a, b = dict(left.get(title, [])), dict(right.get(title, []))
        lines = "".join(
            f"<tr><th scope='row'>{escape(name)}</th><td>{escape(a.get(name, '-'))}</td>"
            f"<td>{escape(b.get(name, '-'))}</td></tr>"
            for name in dict.fromkeys([*a, *b])
            if name not in ("Source", "Not known")
        )
        head = "<tr><th></th><td><b>kept variant</b></td><td><b>this one</b></td></tr>"
        parts.append(f"<table><caption>{escape(title)}</caption>{head}{lines}</table>")
    return "".join(parts)


def rows(part: Any, hidden: Iterable[str] = ()) -> Iterable[tuple[str, str]]:  # noqa: ANN401
    """Yield name and value, with unit and error, of every known field of a result."""
    values = {one.name: getattr(part, one.name) for one in fields(part)}
    values = {name: value for name, value in values.items() if name not in (*hidden, "warnings")}
    errors = {name: _error_name(name) for name in values}
    joined = {error for error in errors.values() if error in values}
    unknown = []
    for name, value in values.items():
        if isinstance(value, Mapping):
            yield from ((f"{_words(name)}: {key}", _share(v)) for key, v in value.items())
        elif value is None or (isinstance(value, float) and math.isnan(value)):
            unknown += [_words(name)] if name not in joined else []
        elif not is_dataclass(value) and name not in joined:
            error = values.get(errors[name])
            within = f" within {_share(error)}" if isinstance(error, float) else ""
            yield _words(name), _value(name, value) + within
    unknown = [name for name in unknown if name != _words("heated")]
    if unknown:
        yield "Not known", ", ".join(unknown)


def _error_name(name: str) -> str:
    """Return the name of the error that stands beside a quantity; films have a row for it."""
    stem = name
    for end in ("_coefficient", "_ratio_after"):
        stem = stem.removesuffix(end)
    return f"{stem}_error"


def table(title: str, lines: Iterable[tuple[str, str]]) -> str:
    """Return a table of two columns."""
    body = "".join(
        f"<tr><th scope='row'>{escape(name)}</th><td>{escape(text)}</td></tr>"
        for name, text in lines
    )
    return f"<table><caption>{escape(title)}</caption>{body}</table>"


def doubts(found: Deformed) -> str:
    """Return the parts not judged."""
    lines = [
        f"{group.components} component(s) {group.reason}: {100 * group.share_before:.3g} % of the "
        f"mean square before, {100 * group.share_after:.3g} % after"
        for group in found.unjudged
    ]
    judged = "".join(f"<li>{escape(line)}</li>" for line in lines) or "<li>Nothing.</li>"
    return f"<h3>Not judged</h3><ul>{judged}</ul>"


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


def _words(name: str) -> str:
    if name in NAMES:
        return NAMES[name]
    ends = ("_m", "_pa", "_k", "_n")
    plain_name = next((name[: -len(end)] for end in ends if name.endswith(end)), name)
    first, *rest = plain_name.split("_")
    return " ".join([SYMBOLS.get(first, first.capitalize()), *rest])


def _value(name: str, value: Any) -> str:  # noqa: ANN401
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not isinstance(value, (int, float)):
        return str(value)
    if name.endswith("_error"):
        return _share(value)
    if name.endswith("_m"):
        return f"{value * UM:.4g} um"
    if name.endswith("_pa"):
        return f"{value / 1e9:.4g} GPa"
    if name.endswith("_k"):
        return f"{value:.4g} K"
    return f"{value:.4g}"


def _share(share: float) -> str:
    return f"{100 * share:.2g} %" if share < 1 else "above 100 %"


def plain(message: str, labels: Mapping[str, str] | None = None) -> str:
    """Return a message with the labels of the page in place of the names of Python."""
    known = LABELS | dict(labels or {})
    for pattern, text in PLAIN:
        message = re.sub(pattern, text, message)

    def label(match: re.Match[str]) -> str:
        word = match[0]
        return known.get(word) or NAMES.get(word) or _words(word).lower()

    message = re.sub(r"\b[a-z][a-z0-9]*(?:_[a-z0-9]+)+\b(?!\.\w)", label, message)
    return re.sub(r"\b(?:[A-Z][a-z]+){2,}\b", lambda m: split_words(m[0]), message)


def failure(message: str, shown: Iterable[Any]) -> str:
    """Return an error in the labels of the page, and the field that it names."""
    labels = {one.key: one.label for one in shown}
    named = next((labels[word] for word in re.findall(r"\w+", message) if word in labels), "")
    where = f"<p>Field: {escape(named)}</p>" if named else ""
    text = plain(message, labels)
    return f"<div class='error' role='alert'><b>Error</b> {escape(text)}{where}</div>"


def old(text: str) -> str:
    """Return an answer, marked as outdated after a change of the input."""
    return f"<p class='old'>Something was changed: press Compute again.</p>{text}"
