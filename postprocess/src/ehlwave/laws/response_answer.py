"""Response of a contact to one wave: by the atlas, or by a law."""

import cmath
import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.line_contact import ROLLS_ALONE, TRANSVERSE_ALONE
from ehlwave.contact.scales import moes_per_film
from ehlwave.contact.starvation import WAVES_TEXT, is_fitted
from ehlwave.contact.two_waves import SLIP_ERRORS, two_waves
from ehlwave.errors import RangeError
from ehlwave.hints import see
from ehlwave.inputs.slip import RATIO, ratio_of
from ehlwave.laws.answers import Response
from ehlwave.laws.atlas.atlas import Atlas, atlas_for
from ehlwave.laws.atlas.chart import Chart
from ehlwave.laws.atlas.coordinates import wave_components
from ehlwave.laws.atlas.ranges import SLIDING_RANGES, WAVE_RANGE
from ehlwave.laws.atlas_transfer import with_atlas_film
from ehlwave.laws.sheared_ridges import ridges_under_slip
from ehlwave.laws.starved_transfer import StarvedTransfer
from ehlwave.laws.two_wave_transfer import TwoWaveTransfer

SLIPS = SLIDING_RANGES["slip_parameter"]
"""Slip parameters that the law of the two waves answers for in :meth:`Contact.response`."""


def response_of(
    conditions: Conditions,
    wavelength_over_a: float,
    angle_deg: float,
    chart_at: Callable[[float], Chart],
    own_atlas: Atlas | None,
) -> Response:
    """Return what :meth:`ehlwave.Contact.response` does, with the slip of the conditions.

    Parameters
    ----------
    conditions : Conditions
        Of the contact; S is that of the surface that carries the wave.
    wavelength_over_a, angle_deg : float
        Of the wave; the angle is one of 0 to 90.
    chart_at : callable
        The contact's chart of the atlas at a slip parameter; raises RangeError outside.
    own_atlas : Atlas or None
        Another atlas than that of the package.
    """
    slip = conditions.slip_parameter
    if conditions.is_starved:
        return _starved(conditions, wavelength_over_a, angle_deg)
    low, high = WAVE_RANGE
    if not low * (1 - 1e-9) <= wavelength_over_a <= high * (1 + 1e-9):
        raise RangeError(
            f"wavelength_over_a = {wavelength_over_a:.5g} lies outside the atlas, which holds "
            f"{low:g} to {high:g}"
        )
    if conditions.is_line and (angle_deg > 1e-9 or not conditions.has_atlas):
        raise RangeError(TRANSVERSE_ALONE if angle_deg > 1e-9 else ROLLS_ALONE)
    if not conditions.has_atlas:
        if angle_deg < 90:
            return _under_slip(conditions, wavelength_over_a, angle_deg, own_atlas)
        slip = 1.0
    try:
        chart = chart_at(slip)
    except RangeError:
        low, high = SLIPS
        is_law_for = conditions.slip_parameter != 1 and conditions.oil.name == "Ree-Eyring"
        has_law = is_law_for and low <= slip <= high
        if conditions.is_line or not has_law or angle_deg == 90:
            raise
        return _under_slip(conditions, wavelength_over_a, angle_deg, own_atlas)
    found = chart.responses(wavelength_over_a, angle_deg)
    film, pressure, error = complex(found.film), complex(found.pressure), float(found.error)
    if conditions.has_atlas or conditions.oil.name == "Newtonian":
        return Response(film, pressure, error, chart.source)
    reasons = TwoWaveTransfer(conditions).reasons()
    if reasons:
        raise RangeError(f"{'; '.join(reasons)}; compute it (ehlwave.Case){see('slip')}")
    height = chart.film().central_moes / moes_per_film(conditions.m, conditions.kappa)
    ridges, bar = ridges_under_slip(conditions, height, wavelength_over_a, film, error)
    source = f"{chart.source}, ridges by the law of slip"
    return Response(complex(ridges), complex(math.nan, math.nan), float(bar), source)


def _under_slip(
    conditions: Conditions, wave: float, angle_deg: float, own_atlas: Atlas | None
) -> Response:
    """Return the response by the law of the two waves, with the film of the atlas."""
    slip, (low, high) = conditions.slip_parameter, SLIPS
    if not low <= slip <= high:
        raise RangeError(
            f"slip_parameter = {slip:g} ({RATIO} = {ratio_of(slip):g}) lies outside {low:g} to "
            f"{high:g}, where the law of the two waves is known to hold"
        )
    reasons = TwoWaveTransfer(conditions).reasons()
    if reasons:
        raise RangeError(f"{'; '.join(reasons)}; compute it (ehlwave.Case){see('slip')}")
    oil = conditions.oil.name
    if oil == "Ree-Eyring":  # outside the atlas of those that slide
        conditions = replace(conditions, slip_parameter=1.0)
    conditions = with_atlas_film(conditions, atlas_for(conditions, own_atlas))
    components = wave_components(wave, angle_deg)
    film = two_waves(conditions, slip, *components).at(0.0)
    return Response(
        film=complex(film),
        pressure=complex(math.nan, math.nan),
        error=SLIP_ERRORS[oil],
        source=f"law of the two waves, {oil} oil",
    )


def _starved(conditions: Conditions, wave: float, angle_deg: float) -> Response:
    """Return the response by the law of starved contacts."""
    transfer = StarvedTransfer(replace(conditions, semi_axis_a_m=1.0))
    if not is_fitted(wave, angle_deg):
        raise RangeError(
            f"wavelength_over_a = {wave:.5g} at angle_deg = {angle_deg:.5g} lies outside the law "
            f"of starved contacts, which holds {WAVES_TEXT}"
        )
    turn = cmath.rect(1 / wave, math.radians(angle_deg)) if angle_deg < 90 else 1j / wave
    along, across = np.array(turn.real), np.array(turn.imag)
    film, error = complex(transfer.ratio(along, across)), float(transfer.error(along, across))
    return Response(film, complex(math.nan, math.nan), error, transfer.name, has_phase=False)
