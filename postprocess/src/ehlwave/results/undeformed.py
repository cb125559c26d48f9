"""Waves of a case as they would pass the contact undeformed."""

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave.inputs.effective_input import keys_of_input
from ehlwave.results.case_file import central_film, number, positive

Floats = NDArray[np.float64]


def undeformed_history(case: xr.Dataset) -> Floats | None:
    """Return the film at the centre that rigid waves would leave, in units of c.

    Theory eq. (12) and (13): waves start at the inlet boundary behind a smooth front and move with
    S, waves of surface 2 with 2 - S. None for smooth cases, standing waves and measured surfaces.
    """
    central, slip = central_film(case), number(case, "slip_parameter")
    waves = [rigid_wave(case, end, speed) for end, speed in (("", slip), ("_2", 2 - slip))]
    known = [wave for wave in waves if wave is not None]
    return np.asarray(central * (1 + sum(known))) if known else None


def rigid_wave(case: xr.Dataset, end: str, slip: float) -> Floats | None:
    """Return the waves of a surface at the centre over the film; None: it has none that move."""
    given, key = given_key(case, f"amplitude_over_film{end}"), f"wavelength_x_over_a{end}"
    wave = number(case, key) if key in case else 0.0
    if given is None or not wave > 0 or case.attrs.get(f"orientation{end}") == "none":
        return None
    place = -number(case, "domain_x_min") - slip * case["time"].values
    front = 10.0 ** (-10 * np.minimum(np.maximum(place / wave, 0) ** 2, 30))
    amplitude = positive(given, f"amplitude_over_film{end}", case)
    return np.asarray(amplitude * front * np.cos(2 * np.pi * place / wave))


def given_key(case: xr.Dataset, key: str) -> float | str | None:
    """Return the value of a key of the input."""
    return keys_of_input(str(case.attrs.get("effective_input", ""))).get(key)
