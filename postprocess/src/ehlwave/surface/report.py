"""Predictions as text, JSON, CSV and HDF5."""

import json
import math
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from ehlwave.laws.transfer import EXTRAPOLATED
from ehlwave.results.cf import with_cf
from ehlwave.shown import percent, spread
from ehlwave.surface.answer import LIMITS_TEXT, answer_of
from ehlwave.surface.narrower import narrower
from ehlwave.surface.pair import PairStatistics
from ehlwave.surface.predict import Deformed
from ehlwave.surface.removal import film_text, removal_text
from ehlwave.surface.spectrum import Component
from ehlwave.surface.statistics import FilmStatistics
from ehlwave.writing import Writer

FORMAT_NAME = "ehlwave-deformed"
TITLE = "ehlwave: a surface as made and in the contact"
UM = 1e6
ANSWER = "Answer       "
"""Heading of the first line."""
UNJUDGED = "Not judged", "Extrapolated"
"""Headings of waves that the law does not cover."""
CSV_FORMAT: Any = {"index": False, "float_format": "%.9g", "lineterminator": "\r\n"}


def report_text(result: Deformed, others: Sequence[Deformed] = ()) -> str:
    """Return the report: the answer; conditions, statistics, parts not judged, warnings.

    `others`: the same surface by other transfers, for comparison.
    """
    c, s = result.conditions, result.statistics
    lines = [
        f"{ANSWER}{answer_of(s).text()}",
        f"Surface      {result.surface.name}: {_size_text(result)}; form removed: {result.form}; "
        f"ends: {result.window}",
        *(f"Read         {note}" for note in result.surface.notes),
        f"Conditions   M = {c.m:.6g}, L = {c.l:.6g}, D = {c.d:.6g}, S = {c.slip_parameter:g}; "
        f"a = {c.semi_axis_a_m * 1e3:.5g} mm, "
        + ("line contact" if c.is_line else f"b = {c.semi_axis_b_m * 1e3:.5g} mm"),
        f"Reduced by   {result.transfer_name}",
        f"Roughness    Rq {s.rq_before_m * UM:.4g} um before, {s.rq_after_m * UM:.4g} um after "
        f"({_ratio_text(s.rq_after_m, s.rq_before_m)}); from lowest to highest "
        f"{s.rz_before_m * UM:.4g} and {s.rz_after_m * UM:.4g} um",
    ]
    for name, after in result.parameters["after"].items():
        if name[1:] in ("a", "z", "sk", "ku"):
            before, unit = result.parameters["before"][name], 1 if name[1:] in ("sk", "ku") else UM
            if not math.isfinite(before):
                continue  # a smooth surface has none
            lines[-1] += f"; {name} {before * unit:.4g}, {after * unit:.4g}"
    if result.error_m is not None:
        share = result.error_m / s.rq_before_m if s.rq_before_m > 0 else 0.0
        lines.append(
            f"Error        {result.error_m * UM:.2g} um rms of the deformed heights, "
            f"{percent(share)} of Rq before: by the error bars of the responses"
        )
    if s.mean_film_m is not None:
        lines += _film_lines(result)
    for place, text in enumerate(removal_text(result.bands)):
        lines.append(f"{'Remove first' if place == 0 else '            '} {text}")
    if text := film_text(result.bands):
        lines.append(f"             {text}")
    if step := narrower(result):
        lines.append(f"To narrow    {step}")
    for other in others:
        t = other.statistics
        ratio = "" if t.lambda_ratio_after is None else f", lambda ratio {t.lambda_ratio_after:.4g}"
        lines.append(f"Others       {t.rq_after_m * UM:.4g} um Rq{ratio} by {other.transfer_name}")
    for group in result.unjudged:
        reason, is_included, _ = group.reason.partition(EXTRAPOLATED)
        heading = UNJUDGED[bool(is_included)]
        lines.append(
            f"{heading:<12} {group.components:,} waves {reason}: "
            f"{100 * group.share_before:.3g} % of the mean square before, "
            f"{100 * group.share_after:.3g} % after"
            f"{'; included in the error' if is_included else ''}"
        )
        # Components below a hundredth of Rq are counted, not named.
        least = 0.01 * s.rq_before_m
        named = [one for one in group.largest if one.amplitude_before_m > least]
        lines += [f"             {_component_text(component)}" for component in named]
    lines += [f"Warning      {warning}" for warning in result.warnings]
    return "\n".join(lines)


def brief_text(result: Deformed) -> str:
    """Return the answer, surface, conditions, film, errors, unjudged components and warnings."""
    kept = "Answer", "Surface", "Conditions", "Reduced by", "Film", "To narrow"
    kept += "Warning", *UNJUDGED
    lines, heading = [], ""
    for line in report_text(result).splitlines():
        heading = heading if line.startswith(" ") else line
        # Components that are not judged are counted, not named.
        if heading.startswith(kept) and (line == heading or not heading.startswith(UNJUDGED)):
            lines.append(line)
    return "\n".join([lines[0], f"Limits       {LIMITS_TEXT}", *lines[1:]])


def _film_lines(result: Deformed) -> list[str]:
    """Return mean and smallest film, and the lambda ratios with their error."""
    c, s = result.conditions, result.statistics
    rise = "its rise by the roughness is not known"
    if s.mean_rise_m is not None:
        by = "to second order" if s.mean_rise_by == "second order" else f"by {s.mean_rise_by}"
        rise = f"{s.mean_rise_m * UM:.3g} um of it by the roughness, {by}"
    elif s.extrapolated:
        rise = "its rise by the roughness is not used at this amplitude"
    least = "the surfaces touch: no smallest film"
    if s.minimum_film_m is not None:
        least = f"minimum {s.minimum_film_m * UM:.4g} um"
    if s.minimum_film_m is not None and s.boundary_film_m:
        least += f": does not touch (boundary film {s.boundary_film_m * UM:.4g} um)"
    within = ""
    if s.mean_rise_by == "averaged flow" and s.mean_film_error is not None:
        most = f"{s.mean_film_m * UM * (1 + s.mean_film_error):.2g} um"
        within = f" {spread(s.mean_film_error, most)}"
    lines = [
        f"Film         mean {s.mean_film_m * UM:.4g} um{within} (smooth: {c.film_source}; {rise}), "
        f"{least}",
        f"             lambda ratio {s.lambda_ratio_before:.4g} with the undeformed roughness, "
        f"{s.lambda_ratio_after:.4g} with the deformed one (of this surface alone)",
    ]
    why = "" if c.central_film_error is None else ", this transfer has none"
    return lines + _error_lines(s, why)


def pair_text(pair: PairStatistics) -> str:
    """Return the results of two surfaces that pass each other, as text."""
    lines = [
        f"Both         Rq {pair.rq_before_m * UM:.4g} um as made, {pair.rq_after_m * UM:.4g} um in "
        "the contact: phases are free, so mean squares add",
        f"             lambda ratio {pair.lambda_ratio_before:.4g} with the undeformed roughness, "
        f"{pair.lambda_ratio_after:.4g} with the deformed one",
    ]
    return "\n".join(lines + _error_lines(pair))


def _error_lines(s: FilmStatistics | PairStatistics, why: str = "") -> list[str]:
    if s.lambda_error is None or s.lambda_errors is None:
        return [f"             error of the latter: not known{why}"]
    parts = ", ".join(f"{name} {percent(error)}" for name, error in s.lambda_errors.items())
    note = " (extrapolated)" if s.extrapolated else ""
    return [f"             error of the latter {percent(s.lambda_error)}: {parts}{note}"]


def report_json(result: Deformed) -> str:
    """Return the report as a JSON document; infinite and unknown numbers become null."""
    document = {
        "format": FORMAT_NAME,
        "answer": answer_of(result.statistics).summary(),
        "surface": result.surface.name,
        "read": list(result.surface.notes),
        "points": list(result.height.shape),
        "steps_m": [result.surface.step_x_m, result.surface.step_y_m],
        "form_removed": result.form,
        "ends": result.window,
        "transfer": result.transfer_name,
        "conditions": asdict(result.conditions),
        "cutoffs_m": list(result.cutoffs_m),
        "statistics": asdict(result.statistics),
        "parameters": result.parameters,
        "error_m": result.error_m,
        "remove_first": [asdict(band) for band in result.bands],
        "not_judged": [asdict(group) for group in result.unjudged],
        "warnings": result.warnings,
    }
    return json.dumps(plain(document), indent=2, allow_nan=False)


def to_dataset(result: Deformed) -> xr.Dataset:
    """Return heights before and after over x and y, m, with the report as attributes."""
    nx, ny = result.height.shape
    surface = result.surface
    films = {
        "central_film_m": result.conditions.central_film_m,
        "mean_film_m": result.statistics.mean_film_m,
    }

    def in_metres(dims: Sequence[str], values: Any, name: str) -> xr.Variable:  # noqa: ANN401
        return xr.Variable(dims, values, {"units": "m", "long_name": name})

    variables = {
        "height": in_metres(("x", "y"), surface.height, "before, peaks positive"),
        "deformed": in_metres(("x", "y"), result.height, "inside the contact"),
    }
    coordinates = {
        "x": in_metres(("x",), np.arange(nx) * surface.step_x_m, "along rolling"),
        "y": in_metres(("y",), np.arange(ny) * surface.step_y_m, "across"),
    }
    attributes: dict[str, Any] = {"format": FORMAT_NAME, "report": report_json(result)}
    attributes |= {name: film for name, film in films.items() if film is not None}
    return xr.Dataset(variables, coords=coordinates, attrs=attributes)


def write_results(result: Deformed, directory: Path, writer: Writer | None = None) -> list[Path]:
    """Write ``deformed.h5``, ``spectrum.csv``, ``deformed.json``, for a trace ``deformed.csv`` too.

    Returns the paths.
    """
    chosen = writer or Writer()
    paths = [
        chosen.dataset(directory / "deformed.h5", with_cf(to_dataset(result), TITLE)),
        chosen.table(directory / "spectrum.csv", _spectrum_table(result), **CSV_FORMAT),
        chosen.text(directory / "deformed.json", report_json(result) + "\n"),
    ]
    if result.surface.is_trace:
        table = _trace_table(result)
        paths.append(chosen.table(directory / "deformed.csv", table, **CSV_FORMAT))
    return paths


def _trace_table(result: Deformed) -> pd.DataFrame:
    step = max(result.surface.step_x_m, result.surface.step_y_m)
    before, after = result.surface.height.ravel(), result.height.ravel()
    film = result.statistics.mean_film_m
    table = pd.DataFrame(
        {
            f"{result.surface.trace_axis}_um": np.arange(before.size) * step * UM,
            "height_um": before * UM,
            "deformed_um": after * UM,
        }
    )
    if film is not None:
        film_um = (film - after) * UM
        table["film_um"] = np.where(film_um > 0, film_um, np.nan)  # nothing where they touch
    return table


def _spectrum_table(result: Deformed) -> pd.DataFrame:
    parts = []
    for name, spectrum in result.spectra.items():
        if spectrum.waves.size == 1:
            continue
        with np.errstate(divide="ignore"):
            columns = {
                "direction": name,
                "wavelength_um": UM / spectrum.waves,
                "mean_square_before_um2": spectrum.before * UM**2,
                "mean_square_after_um2": spectrum.after * UM**2,
            }
        parts.append(pd.DataFrame(columns))
    return pd.concat(parts)


def _size_text(result: Deformed) -> str:
    nx, ny = result.height.shape
    lengths = (nx * result.surface.step_x_m * UM, ny * result.surface.step_y_m * UM)
    if result.surface.is_trace:
        where = "along rolling" if result.surface.trace_axis == "x" else "across rolling"
        return f"trace {where}, {max(nx, ny)} points, {max(lengths):.5g} um"
    return f"map, {nx} x {ny} points, {lengths[0]:.5g} um along rolling x {lengths[1]:.5g} um"


def _component_text(component: Component) -> str:
    return (
        f"lambda_x = {_length(component.wavelength_x_m)}, lambda_y = "
        f"{_length(component.wavelength_y_m)}, amplitude {component.amplitude_before_m * UM:.3g} um"
        f" before, {component.amplitude_after_m * UM:.3g} um after"
    )


def _length(value: float) -> str:
    return f"{value * UM:.4g} um" if math.isfinite(value) else "infinite"


def _ratio_text(part: float, whole: float) -> str:
    return f"ratio {part / whole:.4g}" if whole > 0 else "smooth"


def plain(value: Any) -> Any:  # noqa: ANN401
    """Return a document for JSON: infinite and unknown numbers become null."""
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, (float, np.floating)):
        return float(value) if math.isfinite(value) else None
    return value
