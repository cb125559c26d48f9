"""Stresses below rough contacts as text, JSON and HDF5."""

import json
import math
from dataclasses import asdict
from typing import Any

import numpy as np
import xarray as xr

from ehlwave.shown import percent
from ehlwave.stress.body import INNER, BodyStress, Peak
from ehlwave.stress.dang_van import Path, limit_text
from ehlwave.stress.removal import risk_text
from ehlwave.stress.rough import RoughStress

FORMAT_NAME = "ehlwave-stress"
UM, MPA = 1e6, 1e-6
LEAST_PLACE = 1e-4
"""In um, or a: an atom."""
NAMES = {
    "von_mises": "von Mises",
    "largest_shear": "largest shear",
    "orthogonal_shear": "orthogonal shear",
}


def stress_text(result: RoughStress) -> str:
    """Return the report as text: a table per body, and the limits of its validity."""
    c = result.conditions
    lines = [
        f"Conditions   M = {c.m:.6g}, L = {c.l:.6g}, D = {c.d:.6g}, S = {c.slip_parameter:g}; "
        f"a = {c.semi_axis_a_m * UM:.4g} um, ph = {result.hertz_pa * 1e-9:.4g} GPa",
        f"Surfaces     {', '.join(surface.surface.name for surface in result.surfaces)}; by "
        f"{result.surfaces[0].transfer_name}",
        f"Ripple       pressure {result.ripple_rq_pa * MPA:.4g} MPa rms at the centre, within "
        f"{percent(result.ripple_error)}; friction coefficient {result.friction:.3g}",
    ]
    for body in result.bodies:
        lines += ["", f"{body.name[0].upper()}{body.name[1:]}, S = {body.slip:g}", *_table(body)]
        ripple = body.ripple_shear
        lines += [
            _row("ripple, largest shear", _megapascals(ripple.value_pa), "", *_places(ripple))
            + f"   within {body.ripple_shear_error_pa * MPA:.2g} MPa; |x| < {INNER:g} a",
            _row(
                "Dang Van's factor",
                f"{body.dang_van:.3f}",
                f"{body.dang_van_smooth:.3f}",
                f"{body.dang_van_depth_m * UM:.3g}",
                "",
            )
            + f"   within {body.dang_van_error:.2g}; N = {result.cycles:.3g}",
            _row(
                "  near the surface",
                f"{body.dang_van_near:.3f}",
                f"{body.dang_van_near_smooth:.3f}",
            )
            + f"   down to {body.near_m * UM:.3g} um",
            _row("share of surface at risk", f"{100 * body.share_at_risk:.3g} %"),
            _row("life over that without", f"{body.life_ratio:.3g}"),
            *(f"  remove first              {line}" for line in risk_text(body.bands)),
        ]
    lines += ["", limit_text(result.cycles)]
    if result.valid_within_a > 0:
        lines.append(
            f"Valid        for |x| < {result.valid_within_a:.2f} a; the outlet edge and the "
            "pressure spike are not predicted"
        )
    lines += [f"Warning      {warning}" for warning in result.warnings]
    return "\n".join(lines).rstrip()


def _table(body: BodyStress) -> list[str]:
    return [
        _row("MPa", "with roughness", "without", "depth um", "x um"),
        *(
            _row(NAMES[key], *map(_megapascals, (one.value_pa, one.smooth_pa)), *_places(one))
            for key, one in body.peaks.items()
        ),
    ]


def _row(name: str, *columns: str) -> str:
    widths = 16, 10, 11, 11
    cells = (f"{text:>{width}}" for text, width in zip(columns, widths, strict=False))
    return f"  {name:26}{''.join(cells)}"


def _places(peak: Peak) -> tuple[str, str]:
    return place_text(peak.depth_m * UM), place_text(peak.place_m * UM)


def place_text(place: float) -> str:
    """Return a place, um or a; rounding errors become 0."""
    return f"{place:.3g}" if abs(place) > LEAST_PLACE else "0"


def _megapascals(value_pa: float) -> str:
    return f"{value_pa * MPA:.4g}"


def stress_summary(result: RoughStress) -> dict[str, Any]:
    """Return the report as numbers; unknown and infinite values are None."""
    bodies = []
    for body in result.bodies:
        entry = {
            key: value
            for key, value in vars(body).items()
            if not isinstance(value, xr.DataArray | np.ndarray | Path | dict | list | Peak)
        }
        entry["bands"] = [asdict(band) for band in body.bands]
        entry["peaks"] = {key: asdict(peak) for key, peak in body.peaks.items()}
        entry["ripple_shear"] = asdict(body.ripple_shear)
        bodies.append(entry)
    document = {
        "format": FORMAT_NAME,
        "surfaces": [surface.surface.name for surface in result.surfaces],
        "transfer": result.surfaces[0].transfer_name,
        "conditions": asdict(result.conditions),
        "hertz_pa": result.hertz_pa,
        "ripple_rq_pa": result.ripple_rq_pa,
        "ripple_error": result.ripple_error,
        "friction": result.friction,
        "cycles": result.cycles,
        "poisson_ratio": result.poisson_ratio,
        "valid_within_a": result.valid_within_a,
        "bodies": bodies,
        "warnings": result.warnings,
    }
    return plain(document)


def stress_json(result: RoughStress) -> str:
    """Return the summary as a JSON document."""
    return json.dumps(stress_summary(result), indent=2, allow_nan=False)


def stress_dataset(result: RoughStress) -> xr.Dataset:
    """Return maps of Dang Van's factor and the paths of the worst points, for a file."""
    variables: dict[str, Any] = {}
    for number, body in enumerate(result.bodies, 1):
        risk = body.risk.rename(point=f"point_{number}")
        variables[f"dang_van_{number}"] = risk.assign_attrs(long_name=f"factor, {body.name}")
        for name, values in zip(("shear", "hydrostatic"), body.path, strict=True):
            variables[f"path_{name}_{number}_pa"] = (
                "time",
                np.asarray(values),
                {"units": "Pa", "long_name": f"{name} stress of the worst point, {body.name}"},
            )
    data = xr.Dataset(variables)
    return data.assign_attrs(format=FORMAT_NAME, report=stress_json(result))


def plain(value: Any) -> Any:  # noqa: ANN401
    """Return a value of which JSON can be made."""
    if isinstance(value, dict):
        return {key: plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [plain(one) for one in value]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
