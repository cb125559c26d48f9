"""Runs of transverse waves through the line contact of Venner and others (1997)."""

from pathlib import Path

import xarray as xr

from studies.validation.published import line_ratios, small_line_ratios
from studies.validation.sweep import swept

CELLS = (256, 512)
"""Of the marches, on the near domain."""

FINE_CELLS = 4096
"""Of the linear responses, which cost little; each is extrapolated from this and half as many."""

QUICK_CELLS = 1024
"""Of linear responses that are compared with each other, in 4 a."""

DOMAINS = {"near": (-2.5, 1.5), "wide": (-10.5, 1.5)}
"""x_min and x_max, P = 0 at both."""

OILS = {
    "default": {},
    "alpha_1.5": {"pressure_viscosity_per_pa": 1.5e-8},
    "z_0.6": {"roelands_index": 0.6},
    "incompressible": {"density_law": "incompressible"},
}
"""Keys of the oil, whose data beyond L are not known: the default, and what else it may be."""

_CONTACT = {"load_parameter_m": 100, "lubricant_parameter_l": 11, "radius_ratio_d": 0}


def settling_periods(wavelength_over_a: float) -> int:
    """Return the whole periods in T = 2, which the oil takes from the inlet to the centre.

    In the first period Ad/Ai of waves of 0.5 a is 0.6 % too large, then 0.05 % and less.
    """
    return max(1, round(2 / wavelength_over_a))


def transients(folder: Path) -> xr.Dataset:
    """Return marches of all 18 waves on both grids, each with its linear response."""
    rows = [
        {
            "wavelength_over_a": one.wavelength_over_a,
            "amplitude_over_film": one.amplitude_over_film,
            "cells_x": cells,
            "settling_periods": settling_periods(one.wavelength_over_a),
        }
        for cells in CELLS
        for one in line_ratios()
    ]
    waves = {"orientation": "transverse", "response": "both"}
    return swept(folder, "line_transients", {"conditions": _CONTACT, "waviness": waves}, rows)


def responses(
    folder: Path, domain: str = "near", oil: str = "default", cells: int = QUICK_CELLS
) -> xr.Dataset:
    """Return linear responses on a domain of ``DOMAINS`` with an oil of ``OILS``.

    `cells` are those of the near domain; the wide one has the same mesh size.
    """
    x_min, x_max = DOMAINS[domain]
    count = cells * round(x_max - x_min) // 4
    rows = [{"wavelength_over_a": wave, "cells_x": count} for wave in small_line_ratios()]
    groups = {
        "conditions": _CONTACT,
        "waviness": {"orientation": "transverse", "response": "harmonic"},
        "grid": {"x_min": x_min, "x_max": x_max},
        **({"lubricant": OILS[oil]} if OILS[oil] else {}),
    }
    return swept(folder, f"line_{domain}_{oil}_{cells}", groups, rows)
