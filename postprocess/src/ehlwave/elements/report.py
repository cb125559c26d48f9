"""The report of an element: text, JSON, and an HTML file that includes its figures."""

from __future__ import annotations

import base64
import io
import json
import math
import re
from collections.abc import Callable
from html import escape
from typing import Any

import numpy as np
import xarray as xr

from ehlwave.elements.columns import TEXTS
from ehlwave.elements.figure import element_figure
from ehlwave.elements.formulas import FORMULAS, heading, written
from ehlwave.shown import split_words, spread

DOTS_PER_INCH = 130
SUMMARY = (
    *("rolling_power_w", "sliding_power_w", "efficiency", "assumed_eyring_stress_pa"),
    *("peak_hertz_pressure_pa", "peak_hertz_distance_m", "geometry_note"),
    *("kappa_iso_281", "centrifugal_over_load", "reversals_deg", "opposite_speeds_deg"),
)
"""Numbers of an element that the text has."""

STYLE = (
    "body{font:15px/1.45 sans-serif;max-width:62em;margin:2em auto;padding:0 1em;color:#223}"
    "table{border-collapse:collapse;font-size:12.5px}td,th{padding:2px 7px;text-align:right;"
    "border-bottom:1px solid #dde}th{color:#345;text-align:left}caption{text-align:left;"
    "font-weight:600;padding:.8em 0 .2em}img{max-width:100%}.wide{overflow-x:auto}"
    ".wide th{white-space:nowrap;position:sticky;left:0;background:#fff}"
    ".text{text-align:left}th a{color:inherit;text-decoration-style:dotted}"
    ".note{background:#fff6e0;padding:.4em .8em}"
)


SOURCES = (
    "Names above lead to these lines. The manual derives the formulas: the page of machine"
    " elements for loads, radii and speeds; Theory for equations in brackets, such as (T2): film,"
    " friction, heat, deformed roughness, starvation and stress."
)
"""Text above the formulas."""


def title(table: xr.Dataset) -> str:
    """Return the plain name of an element.

    Parameters
    ----------
    table : xarray.Dataset
        Of the element.
    """
    return split_words(str(table.attrs["element"])).capitalize()


def report_text(table: xr.Dataset) -> str:
    """Return the text for a terminal: worst places, powers, figures of practice, refusals.

    Parameters
    ----------
    table : xarray.Dataset
        Of an element.
    """
    lines = [title(table)]
    lines += [f"  {part}" for part in str(table.attrs["worst"]).split("; ") if part]
    lines += [f"  {_summed(table, name)}" for name in SUMMARY if name in table.attrs]
    left, places = int(table.attrs["unanswered_places"]), table["load_n"].size
    found = reasons(table)
    if left and not any(one.startswith(f"{left} of {places} places") for one in found):
        lines.append(f"  {left} of {places} places have no film")
    lines += [f"  {reason}" for reason in found]
    return "\n".join(lines)


def _summed(table: xr.Dataset, name: str) -> str:
    """Return a number of an element with its unit and error."""
    value = table.attrs[name]
    if isinstance(value, float) and math.isnan(value):
        return f"{FORMULAS[name].label}: not available"
    error = table.attrs.get(f"{name.removesuffix('_w')}_error")
    label, unit = FORMULAS[name].label, "" if value == "none" else FORMULAS[name].unit
    said = f"{label}: {written(name, value)} {unit}".rstrip()
    if not isinstance(error, float):
        return said
    return f"{said} {spread(error, f'{written(name, value * (1 + error))} {unit}'.rstrip())}"


def reasons(table: xr.Dataset) -> list[str]:
    """Return why numbers are missing, each kind once with the number of its places.

    Parameters
    ----------
    table : xarray.Dataset
        Of an element.
    """
    return _kinds(table, "refusal")


def _kinds(table: xr.Dataset, column: str) -> list[str]:
    """Return texts of a column; of texts that differ in numbers alone the one with the largest."""
    largest: dict[str, str] = {}
    counts: dict[str, int] = {}
    for text in table[column].values.ravel():
        for part in filter(None, str(text).split("\n")):
            kind = re.sub(r"\d\S*", "#", part)
            largest[kind] = max(largest.get(kind, part), part, key=_numbers)
            counts[kind] = counts.get(kind, 0) + 1
    return [f"{counts[kind]} of {table['load_n'].size} places: {largest[kind]}" for kind in largest]


def _numbers(text: str) -> list[float]:
    """Return the numbers of a text, the largest first."""
    return sorted(map(float, re.findall(r"\d+(?:\.\d+)?", text)), reverse=True)


def report_json(table: xr.Dataset) -> str:
    """Return attributes and columns as JSON; numbers that are not known are null.

    Parameters
    ----------
    table : xarray.Dataset
        Of an element.
    """
    document: dict[str, Any] = {"attributes": {k: _plain(v) for k, v in table.attrs.items()}}
    document["dimensions"] = {str(name): int(size) for name, size in table.sizes.items()}
    document["columns"] = {
        str(name): {**_strings(one.attrs), "dims": list(one.dims), "values": _plain(one.values)}
        for name, one in table.variables.items()
    }
    return json.dumps(document, indent=1)


def report_html(
    table: xr.Dataset,
    inputs: str = "",
    drawing_svg: str = "",
    words: Callable[[str], str] = str,
) -> str:
    """Return the report as a single HTML page.

    Parameters
    ----------
    table : xarray.Dataset
        Of an element.
    inputs : str
        Text of the input file.
    drawing_svg : str
        Drawing of the element.
    words : callable
        Returns a note in the words of its readers.
    """
    name = title(table)
    given = f"<h2>Input</h2><pre>{escape(inputs)}</pre>" if inputs else ""
    return (
        f"<!doctype html><html lang='en'><head><meta charset='utf-8'><title>{name}</title>"
        f"<style>{STYLE}</style></head><body><h1>{name}</h1>{drawing_svg}"
        f"{report_body(table, words)}{given}</body></html>"
    )


def report_body(table: xr.Dataset, words: Callable[[str], str] = str) -> str:
    """Return the report as a part of a page: worst places, figures, numbers, sources.

    Parameters
    ----------
    table : xarray.Dataset
        Of an element.
    words : callable
        Returns a note in the words of its readers.
    """
    name = title(table)
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    file = io.BytesIO()
    figure = element_figure(table)
    figure.set_dpi(DOTS_PER_INCH)
    FigureCanvasAgg(figure).print_png(file)
    picture = base64.b64encode(file.getvalue()).decode()
    worst = "".join(
        f"<li>{escape(one)}</li>" for one in str(table.attrs["worst"]).split("; ") if one
    )
    texts = [*reasons(table), *_kinds(table, "doubts")]
    texts += [str(table.attrs["geometry_note"])] if "geometry_note" in table.attrs else []
    notes = "".join(f"<p class='note'>{escape(words(text))}</p>" for text in texts)
    numbers = [str(key) for key in table.attrs if key not in ("worst", "element")]
    attributes = "".join(
        f"<tr><th>{_linked(key)}</th>"
        f"<td class='text'>{escape(written(key, table.attrs[key]))}</td></tr>"
        for key in numbers
    )
    names = dict.fromkeys([*_rows(table), *numbers])
    formulas = "".join(
        f"<tr id='{key}'><th>{escape(FORMULAS[key].label)}</th>"
        f"<td class='text'>{escape(FORMULAS[key].formula)}</td></tr>"
        for key in names
    )
    return (
        f"<h2>Worst places</h2><ul>{worst}</ul><h2>Figures</h2>"
        f"<p>Bands are errors of the solid curves.</p><img alt='{name}' "
        f"src='data:image/png;base64,{picture}'><h2>Not answered, or doubtful</h2>"
        f"{notes or '<p>Nothing.</p>'}<h2>Numbers of the element</h2><table>{attributes}</table>"
        f"<h2>Numbers of each place</h2><div class='wide'>{_html_table(table)}</div>"
        f"<h2>Where the numbers come from</h2><p>{SOURCES}</p><table>{formulas}</table>"
    )


def _html_table(table: xr.Dataset) -> str:
    """Return a table a ring, a column a place."""
    parts = []
    rings = table["ring"].values.tolist() if "ring" in table.dims else [None]
    for ring in rings:
        part = table if ring is None else table.sel(ring=ring)
        rows = []
        for name in _rows(part):
            values = np.atleast_1d(part[name].values).tolist()
            cells = "".join(f"<td>{escape(written(name, value))}</td>" for value in values)
            rows.append(f"<tr><th>{_linked(name)}</th>{cells}</tr>")
        caption = f"<caption>{ring} ring</caption>" if ring else ""
        parts.append(f"<table>{caption}{''.join(rows)}</table>")
    return "".join(parts)


def _rows(table: xr.Dataset) -> list[str]:
    """Return coordinates and columns with numbers, as they are printed."""
    names = [*(str(one) for one in table.coords if one != "ring"), *map(str, table.data_vars)]
    return [name for name in names if name not in TEXTS and not _is_empty(table[name].values)]


def _is_empty(values: Any) -> bool:  # noqa: ANN401
    return bool(np.isnan(values).all())


def _linked(name: str) -> str:
    """Return the heading of a number, a link to its formula."""
    return f"<a href='#{name}'>{escape(heading(name))}</a>"


def _strings(attributes: dict[Any, Any]) -> dict[str, str]:
    return {str(key): str(value) for key, value in attributes.items()}


def _plain(value: Any) -> Any:  # noqa: ANN401
    """Return lists, numbers and texts of the standard library; null for NaN and infinity."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, list):
        return [_plain(one) for one in value]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
