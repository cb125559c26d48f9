"""The report of stresses below a solved contact: table, JSON, figure."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave.stress.body import INNER
from ehlwave.stress.case import (
    SolvedContact,
    line_stress_over_time,
    point_histories,
    solved_contact,
    stress_of_case,
)
from ehlwave.stress.criteria import CRITERIA, Largest, largest, largest_shear
from ehlwave.stress.dang_van import dang_van_factor, fatigue_shear, limit_text
from ehlwave.stress.loads import DEEPEST, checked_depths
from ehlwave.stress.report import MPA, NAMES, place_text
from ehlwave.stress.waves import COMPONENTS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Floats = NDArray[np.float64]

UM = 1e6

DEPTHS = 14
POINTS = 128
"""Points of a body that are followed over time."""

DANG_VAN = "Dang Van's factor"

HISTORY = "fields over time, of a march with &output fields_every in which points pass the contact"

ROOM = 1.3
"""Half of the passage of a point, in semi-axes: those that have come and gone are judged."""


def usual_depths(contact: SolvedContact) -> Floats:
    """Return depths from the surface to 1.2 shorter semi-axes, in the unit of the contact."""
    a, b = contact.scales_m
    reach = 1.2 * (a if contact.case["y"].size == 1 else min(a, b))
    return np.concatenate([[0.0], np.geomspace(0.02 * reach, reach, DEPTHS - 1)])


def judge_case(
    path: Path | str, depths: Floats | None, cycles: float, poisson_ratio: float
) -> tuple[dict[str, Any], list[xr.Dataset]]:
    """Return the numbers of both bodies of a solved contact, and their stresses.

    Depths are in um, of a case without lengths in units of a.
    """
    contact = solved_contact(path)
    if depths is None:
        depths = usual_depths(contact)
    elif contact.has_lengths:
        depths = checked_depths(depths / UM, DEEPEST * contact.scales_m[0])
    stresses, bodies = [], []
    for body in (1, 2):
        stress = stress_of_case(contact.case, depths, body, poisson_ratio)
        peaks = {name: asdict(largest(of(stress))) for name, of in CRITERIA.items()}
        entry: dict[str, Any] = {"body": body, "peaks": peaks}
        if "field_time" in contact.case:
            entry |= _over_time(contact, depths, body, cycles, poisson_ratio)
        stresses.append(stress)
        bodies.append(entry)
    document = {
        "format": "ehlwave-stress",
        "file": str(path),
        "hertz_pa": contact.hertz_pa,
        "length_unit": "m" if contact.has_lengths else "a",
        "slip_parameter": contact.slip,
        "poisson_ratio": poisson_ratio,
        "cycles": cycles,
        "bodies": bodies,
    }
    return document, stresses


def _over_time(
    contact: SolvedContact, depths: Floats, body: int, cycles: float, poisson_ratio: float
) -> dict[str, Any]:
    """Return the results of the fields over time: shear of the ripple, Dang Van's factor."""
    over = line_stress_over_time(contact.case, depths, body, poisson_ratio)
    inner = slice(-INNER * contact.scales_m[0], INNER * contact.scales_m[0])
    change = {name: (over[name] - over[f"{name}_smooth"]).sel(x=inner) for name in COMPONENTS}
    shear = largest_shear(change)
    found: dict[str, Any] = {"ripple_shear_pa": float(shear.max())}
    slip = contact.slip if body == 1 else 2 - contact.slip
    room, way = ROOM * contact.scales_m[0], float(over["time"][-1])
    if slip * way <= 2 * room:
        return found
    points = np.linspace(room - slip * way, -room, POINTS)
    tau_f = float(fatigue_shear(cycles))
    factor = dang_van_factor(point_histories(over, slip, points), tau_f)
    smooth = xr.Dataset({n: over[f"{n}_smooth"].rename(x="time") for n in COMPONENTS})
    worst = factor.max("point")
    return found | {
        "dang_van": float(worst.max()),
        "dang_van_depth_m": float(worst["z"][int(np.argmax(worst.values))]),
        "dang_van_smooth": float(dang_van_factor(smooth, tau_f).max()),
        "share_at_risk": float((factor.max("z") >= 1).mean()),
    }


def case_text(document: dict[str, Any]) -> str:
    """Return the text of the report."""
    has_lengths = document["length_unit"] == "m"
    scale, unit = (UM, "um") if has_lengths else (1.0, "a")
    lines = [
        f"File         {document['file']}: last solution, S = {document['slip_parameter']:g}, "
        f"ph = {document['hertz_pa'] * 1e-9:.4g} GPa"
    ]
    for entry in document["bodies"]:
        slip = document["slip_parameter"] if entry["body"] == 1 else 2 - document["slip_parameter"]
        lines += ["", f"{('First', 'Second')[entry['body'] - 1]} body, S = {slip:g}"]
        lines += [f"  {'':26}{'MPa':>10}{'depth ' + unit:>11}{'x ' + unit:>11}{'y ' + unit:>11}"]
        for name, values in entry["peaks"].items():
            peak = Largest(**values)
            places = (peak.depth_m, peak.x_m, peak.y_m)
            lines += [
                f"  {NAMES[name]:26}{peak.value * MPA:10.4g}"
                + "".join(f"{place_text(place * scale):>11}" for place in places)
            ]
        if "ripple_shear_pa" in entry:
            text = f"  {'ripple, largest shear':26}{entry['ripple_shear_pa'] * MPA:10.4g}"
            lines += [f"{text}   over time, |x| < {INNER:g} a, y = 0"]
        if "dang_van" in entry:
            lines += [
                f"  {DANG_VAN:26}{entry['dang_van']:9.3f} at "
                f"{entry['dang_van_depth_m'] * scale:.3g} {unit}; smooth "
                f"{entry['dang_van_smooth']:.3f}; N = {document['cycles']:.3g}; share of surface "
                f"at risk {100 * entry['share_at_risk']:.3g} %"
            ]
    if any("dang_van" in entry for entry in document["bodies"]):
        lines += ["", limit_text(document["cycles"])]
    else:
        lines += ["", f"{DANG_VAN}: not known, cycles have no effect: it needs {HISTORY}"]
    return "\n".join(lines)


def case_section(path: Path | str, stress: xr.Dataset) -> "Figure":
    """Draw the section of a body of a solved contact."""
    from ehlwave.stress.figures import section_figure

    contact = solved_contact(path)
    a, b = contact.scales_m
    pressure = contact.loads(1, contact.last)["pressure_pa"]
    near = {letter: slice(-1.6 * size, 1.6 * size) for letter, size in (("x", a), ("y", b))}
    if stress["y"].size == 1:
        del near["y"]
    unit = (r"$\mu$m", UM) if contact.has_lengths else ("$a$", 1.0)
    return section_figure(stress.sel(near), pressure.sel(near), *unit)
