"""Stresses below the bodies of a rough, sliding, lubricated contact, without a simulation."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from ehlwave.choices import POISSON_RATIO
from ehlwave.contact.conditions import Conditions
from ehlwave.error_bars import bar
from ehlwave.errors import StressError, see
from ehlwave.shown import Shown, within
from ehlwave.stress.body import BodyStress, judge_body
from ehlwave.stress.case import stress_of_case
from ehlwave.stress.dang_van import fatigue_shear
from ehlwave.stress.history import follow
from ehlwave.stress.life import CYCLE_POWER, LINE_CYCLE_POWER
from ehlwave.stress.loads import (
    DEEPEST,
    PoissonRatio,
    checked_depths,
    checked_number,
    checked_poisson_ratios,
)
from ehlwave.stress.removal import risk_bands
from ehlwave.stress.trust import LINEAR_LIMIT, MODEL_ERROR, doubts, reach
from ehlwave.surface.predict import Deformed
from ehlwave.surface.ripple import hertz_pressure_of
from ehlwave.surface.rough_pressure import Ripple, ripple_of

Floats = NDArray[np.float64]

AMPLITUDE_ERROR = bar("stress.ripple_amplitude")
"""Relative error of the ripple at that amplitude, of both surfaces; it grows with the amplitude."""

REACH = 2.0
"""Over the mean wave number of the pressure: depth where a third of the shear of a wave is left."""

DEPTHS = 10
"""Number of depths chosen by default."""


@dataclass(frozen=True, repr=False)
class RoughStress(Shown):
    """Stresses below a rough contact.

    Attributes
    ----------
    conditions : Conditions
        Of the contact.
    surfaces : tuple of Deformed
        The rough surfaces, as they are deformed.
    ripples : tuple of Ripple
        Their pressure.
    bodies : tuple of BodyStress
        The first, and the second.
    hertz_pa, ripple_rq_pa, friction : float
        Largest Hertz pressure; root mean square of the pressure ripple at the centre; traction
        over pressure.
    ripple_error : float
        Relative error of the ripple: the atlas' bars, the linear response, and waves of the centre
        in place of the whole contact.
    cycles : float
        N of Dang Van's criterion.
    poisson_ratio : float or pair of float
        Of both bodies; of each where they differ.
    valid_within_a : float
        Distance from the centre, in semi-axes, within which the pressure is above 0 everywhere;
        farther out, with the edge and the pressure spike, nothing is predicted.
    warnings : list of str
        Where it is not to be trusted.
    """

    conditions: Conditions
    surfaces: tuple[Deformed, ...]
    ripples: tuple[Ripple, ...]
    bodies: tuple[BodyStress, ...]
    hertz_pa: float
    ripple_rq_pa: float
    friction: float
    ripple_error: float
    cycles: float
    poisson_ratio: PoissonRatio
    valid_within_a: float
    warnings: list[str] = field(default_factory=list)

    def _shown_rows(self) -> dict[str, str]:
        """Return pressures, friction, and Dang Van's factor of both bodies."""
        rows = {
            "Hertz pressure": f"{self.hertz_pa * 1e-9:.4g} GPa",
            "pressure ripple": within(self.ripple_rq_pa * 1e-6, self.ripple_error, " MPa"),
            "friction": f"{self.friction:.3g}",
        }
        for body in self.bodies:
            rows[f"Dang Van's factor, {body.name}"] = (
                f"{body.dang_van:.3g} within {body.dang_van_error:.2g}"
            )
        return rows | {"warnings": str(len(self.warnings))}


def rough_stress(
    surfaces: Sequence[Deformed],
    friction: float = 0.0,
    cycles: float = 1e8,
    poisson_ratio: PoissonRatio = POISSON_RATIO,
    depths_m: ArrayLike | None = None,
    smooth: xr.Dataset | str | Path | None = None,
) -> RoughStress:
    """Return the stresses of both bodies of a contact with one or two rough surfaces.

    Parameters
    ----------
    surfaces : sequence of Deformed
        Deformed shapes, from :meth:`ehlwave.Contact.deform`: of the first body, and of the other,
        whose slip parameter is 2 - S.
    friction : float
        Traction over pressure: its size. It drags the faster body back; in pure rolling neither
        is, and friction is refused.
    cycles : float
        N of Dang Van's criterion.
    poisson_ratio : float or pair of float
        Of both bodies, or of the first and the second.
    depths_m : array_like, optional
        Depths; otherwise chosen by the waves of the pressure and by the contact.
    smooth : Dataset or path, optional
        File of ehlwave-case of the smooth contact, whose pressure replaces the Hertz pressure, and
        whose shear stress replaces the friction.

    Raises
    ------
    StressError
        If the contact has no lengths, a body stands still, or a number is out of range.
    """
    conditions = surfaces[0].conditions
    slip = conditions.slip_parameter
    if not 0 < slip < 2:
        raise StressError(f"slip_parameter = {slip:g}: a body that stands still does not pass")
    if len(surfaces) > 1 and abs(surfaces[1].conditions.slip_parameter - (2 - slip)) > 1e-9:
        raise StressError(
            f"the second surface has slip_parameter {surfaces[1].conditions.slip_parameter:g}, not "
            f"{2 - slip:g} = 2 - S of the first"
        )
    friction = abs(checked_number(friction, "friction"))
    if friction > 0 and slip == 1:
        raise StressError(
            f"friction = {friction:g} in pure rolling (slip_parameter = 1), where it drags neither "
            f"body back: remove it, or give the slip of the first body{see('slip')}"
        )
    cycles = checked_number(cycles, "cycles")
    ratios = checked_poisson_ratios(poisson_ratio)
    if depths_m is not None:
        depths_m = checked_depths(depths_m, DEEPEST * conditions.semi_axis_a_m)
    ripples = tuple(ripple_of(surface) for surface in surfaces)
    depths = _depths(conditions, ripples) if depths_m is None else depths_m
    near = max(REACH / _mean_number(conditions, ripples), float(depths.min()))
    hertz, rq = hertz_pressure_of(conditions), _rq(ripples)
    amplitude = math.hypot(*(one.statistics.amplitude_over_film or 0.0 for one in surfaces))
    bar = _bar(ripples)
    error = math.hypot(bar, MODEL_ERROR, AMPLITUDE_ERROR * amplitude / LINEAR_LIMIT)
    tau_f = float(fatigue_shear(cycles))
    power = LINE_CYCLE_POWER if conditions.is_line else CYCLE_POWER
    names = ("first body", "second body")
    bodies = []
    for index, own_slip in enumerate((slip, 2 - slip)):
        own = ripples[index] if index < len(ripples) else None
        pull = -friction * float(np.sign(own_slip - 1))
        below = None if smooth is None else _midplane(smooth, depths, index + 1, ratios[index])
        histories = follow(conditions, ripples, own, own_slip, depths, pull, ratios[index], below)
        bodies.append(
            judge_body(
                f"{names[index]}, {'rough' if own else 'smooth'}",
                own_slip,
                own is not None,
                histories,
                conditions.semi_axis_a_m,
                tau_f,
                near,
                (error, MODEL_ERROR),
                power,
                partial(
                    risk_bands,
                    histories,
                    ripples=ripples,
                    slip=own_slip,
                    friction=pull,
                    poisson_ratio=ratios[index],
                    fatigue_pa=tau_f,
                ),
            )
        )
    return RoughStress(
        conditions=conditions,
        surfaces=tuple(surfaces),
        ripples=ripples,
        bodies=tuple(bodies),
        hertz_pa=hertz,
        ripple_rq_pa=rq,
        friction=friction,
        ripple_error=error,
        cycles=cycles,
        poisson_ratio=ratios[0] if ratios[0] == ratios[1] else ratios,
        valid_within_a=reach(ripples, hertz),
        warnings=doubts(surfaces, ripples, amplitude, bar),
    )


def _midplane(
    smooth: xr.Dataset | str | Path, depths: Floats, body: int, poisson_ratio: float
) -> xr.Dataset:
    """Return the stresses of a solved smooth contact in the plane y = 0."""
    below = stress_of_case(smooth, depths, body, poisson_ratio)
    if below.attrs["length_unit"] != "m":
        raise StressError("smooth: the case has no lengths: give it dimensional conditions")
    return below.isel(y=int(np.argmin(np.abs(below["y"].values))))


def _weights(ripple: Ripple) -> Floats:
    """Return the mean squares of the waves of the surface, m^2."""
    twice = np.where(ripple.waves.number_x > 0, 2.0, 1.0)
    return np.asarray(twice * np.abs(ripple.amplitude) ** 2)


def _rq(ripples: Sequence[Ripple]) -> float:
    """Return the root mean square of the pressure ripple at the centre, Pa."""
    return math.sqrt(
        sum(float((_weights(one) * np.abs(one.waves.at(0.0)) ** 2).sum()) for one in ripples)
    )


def _bar(ripples: Sequence[Ripple]) -> float:
    """Return the relative error of the ripple by the error bars of the responses."""
    square = sum(float((_weights(one) * one.waves.error**2).sum()) for one in ripples)
    whole = _rq(ripples)
    return math.sqrt(square) / whole if whole > 0 else 0.0


def _depths(conditions: Conditions, ripples: Sequence[Ripple]) -> Floats:
    """Return depths from the surface, for the ripple, to the scale of the contact, m.

    The stress of a wave is largest at 0.15 wavelengths, the stress of the contact at 0.5 to 0.8 of
    the shorter semi-axis.
    """
    largest = min(conditions.semi_axis_a_m, conditions.semi_axis_b_m)
    first = 0.25 / _mean_number(conditions, ripples)
    first = min(max(first, 1e-3 * largest), 0.1 * largest)
    return np.concatenate([[0.0], np.geomspace(first, 1.2 * largest, DEPTHS - 1)])


def _mean_number(conditions: Conditions, ripples: Sequence[Ripple]) -> float:
    """Return the mean wave number of the pressure ripple at the centre, 1/m."""
    square, weight = 0.0, 0.0
    for one in ripples:
        power = _weights(one) * np.abs(one.waves.at(0.0)) ** 2
        square += float((power * np.hypot(one.waves.number_x, one.waves.number_y)).sum())
        weight += float(power.sum())
    usual = 20 / min(conditions.semi_axis_a_m, conditions.semi_axis_b_m)
    return square / weight if square > 0 else usual
