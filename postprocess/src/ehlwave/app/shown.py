"""Answers as HTML: a line first, then numbers with their errors, then parts not judged."""

import base64
import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass
from html import escape
from typing import Any

from ehlwave.app.task import DOTS_PER_INCH, Answer
from ehlwave.surface.predict import Deformed
from ehlwave.surface.report import report_text

UM = 1e6
SHOWN_PER_INCH = 130
"""Pixels of the page."""
SYMBOLS = {"rq": "Rq", "rz": "Rz", "lambda": "Lambda"}


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


def numbers(answer: Answer) -> str:
    """Return tables of all film results and statistics of the surface."""
    heated = None if answer.film is None else answer.film.heated
    parts: list[tuple[str, Any]] = [("Smooth contact", answer.film), ("With heat", heated)]
    if answer.found is not None:
        parts.append(("Surface in the contact", answer.found.statistics))
    tables = [table(title, rows(part)) for title, part in parts if part is not None]
    if answer.outside:
        tables.append(f"<p class='note'>{escape(answer.outside)}</p>")
    return "".join(tables)


def rows(part: Any) -> Iterable[tuple[str, str]]:  # noqa: ANN401 - any dataclass of results
    """Yield name and value, with unit, of every field that is known."""
    for one in fields(part):
        value = getattr(part, one.name)
        if one.name == "warnings":
            continue  # they are above the tables
        if isinstance(value, Mapping):
            yield from ((f"{_words(one.name)}: {key}", _share(v)) for key, v in value.items())
        elif value is not None and not is_dataclass(value):
            yield _words(one.name), _value(one.name, value)
    unknown = [_words(one.name) for one in fields(part) if getattr(part, one.name) is None]
    if unknown:
        yield "Not known", ", ".join(unknown)


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
    return "".join(f"<p class='note'>Warning: {escape(line)}</p>" for line in answer.warnings)


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
    ends = ("_m", "_pa", "_k", "_n")
    plain = next((name[: -len(end)] for end in ends if name.endswith(end)), name)
    first, *rest = plain.split("_")
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


def failure(message: str, shown: Iterable[Any]) -> str:
    """Return an error as on the command line, and the field that it names."""
    labels = {one.key: one.label for one in shown}
    named = next((labels[word] for word in re.findall(r"\w+", message) if word in labels), "")
    where = f"<p>Field: {escape(named)}</p>" if named else ""
    return f"<div class='error' role='alert'><b>Error</b> {escape(message)}{where}</div>"


def old(text: str) -> str:
    """Return an answer, marked as outdated after a change of the input."""
    return f"<p class='old'>Something was changed: press Compute again.</p>{text}"
