"""Cases of an element for ``ehlwave-sweep``: a table and an input file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from ehlwave.contact.heat_data import heat_of
from ehlwave.elements.hertz import reduced_modulus
from ehlwave.elements.place import ElementContact
from ehlwave.errors import SurfaceError
from ehlwave.writing import Writer

ACCURACY = 0.01
"""Relative error of the central film that the cases ask for: the default grid leaves ends of the
path of a gear unresolved."""


def case_table(places: Sequence[ElementContact]) -> pd.DataFrame:
    """Return the keys of ``ehlwave-case`` of contacts, a row each.

    Places whose surfaces move in opposite directions are no cases and are left out.

    Parameters
    ----------
    places : sequence of ElementContact
        From ``contacts`` or ``contact_at`` of elements; either all points or all lines.

    Examples
    --------
    >>> import ehlwave
    >>> from ehlwave.elements import CylindricalRollerBearing, case_table
    >>> bearing = CylindricalRollerBearing(roller_diameter_m=0.016, roller_length_m=0.016,
    ...     pitch_diameter_m=0.08, rollers=9)
    >>> oil = ehlwave.Oil(viscosity_pa_s=0.01, pressure_viscosity_per_pa=2.2e-8)
    >>> table = case_table(bearing.contacts(radial_load_n=10800, inner_speed_rpm=5000, oil=oil))
    >>> table["load_n_per_m"].round(-3).tolist()
    [308000.0, 229000.0, 44000.0, 44000.0, 229000.0]
    """
    if len({place.length_m is None for place in places}) > 1:
        raise SurfaceError("case_table: points and lines need a table each")
    rows = []
    for place in places:
        if place.is_opposite or place.mean_speed_m_per_s == 0:
            continue
        row = {"radius_x_m": place.radius_x_m}
        if place.length_m is None:
            row |= {"radius_y_m": place.radius_y_m, "load_n": place.load_n}
        else:
            row["load_n_per_m"] = place.load_n_per_m
        row |= {
            "reduced_modulus_pa": reduced_modulus(*place.bodies),
            "mean_speed_m_per_s": abs(place.mean_speed_m_per_s),
            "slip_parameter": min(max(round(1 + place.slide_to_roll_ratio / 2, 12), 0.0), 2.0),
            "viscosity_pa_s": place.oil.viscosity_pa_s,
            "pressure_viscosity_per_pa": place.oil.pressure_viscosity_per_pa,
        }
        rows.append(row)
    return pd.DataFrame(rows)


def write_sweep(
    places: Sequence[ElementContact],
    folder: str | Path,
    *,
    heat: bool = False,
    keys: Mapping[str, Mapping[str, Any]] | None = None,
    writer: Writer | None = None,
) -> list[Path]:
    """Write ``cases.csv`` and ``sweep.nml`` of contacts; ``scripts/run-sweep sweep.nml`` runs them.

    Parameters
    ----------
    places : sequence of ElementContact
        As :func:`case_table`, with a single oil.
    folder : path
        Of both files.
    heat : bool
        With ``&heat``, by the own data of oil and bodies of the first place.
    keys : mapping, optional
        More keys by their groups, such as ``{"solver": {"accuracy": 0.005}}``.
    writer : Writer, optional
        Existing files to overwrite.
    """
    if not places:
        raise SurfaceError("write_sweep: no contacts are given")
    sliding = next((one for one in places if one.slide_to_roll_ratio), places[0])
    oil, out = sliding.flow_oil if heat else sliding.oil, Writer() if writer is None else writer
    groups: dict[str, dict[str, Any]] = {"lubricant": {"roelands_index": oil.roelands_index}}
    if oil.eyring_stress_pa is not None:
        groups["lubricant"] |= {"flow_law": "eyring", "eyring_stress_pa": oil.eyring_stress_pa}
    if heat:
        found = heat_of(oil, places[0].bodies).keys()
        groups["lubricant"]["temperature_k"] = found.pop("temperature_k")
        groups["heat"] = dict(found)
    groups["solver"] = {"accuracy": ACCURACY}
    groups["sweep"] = {"case_file": "cases.csv", "output": "results.h5"}
    for group, more in (keys or {}).items():
        groups[group] = groups.get(group, {}) | dict(more)
    lines = [f"&{name}\n{_keys(values)}/" for name, values in groups.items()]
    place = Path(folder)
    table = out.table(place / "cases.csv", case_table(places))
    return [table, out.text(place / "sweep.nml", "\n".join(lines) + "\n")]


def _keys(values: Mapping[str, Any]) -> str:
    return "".join(
        f"  {key} = {repr(value) if isinstance(value, (str, float)) else value}\n"
        for key, value in values.items()
    )
