"""Gradient of Dang Van's factor by the spectrum of rough surfaces: which waves to remove first.

The factor of a material point is a function of its stresses over time, theory eq. (B5), and these
are sums of waves: the derivative by a band of waves is a difference along its part of the stresses.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ehlwave.stress.dang_van import dang_van_factor
from ehlwave.stress.history import Histories
from ehlwave.stress.passage import wave_stresses
from ehlwave.surface.removal import DIRECTIONS, OCTAVE, Waves, band_key, places_of_bands
from ehlwave.surface.rough_pressure import Ripple

Floats = NDArray[np.float64]

STEP = 1e-3
"""Step of the amplitudes of a band, relative, of centred differences."""


@dataclass(frozen=True)
class RiskBand(Waves):
    """Waves of similar length and direction of a rough surface.

    Attributes
    ----------
    surface : int
        1 or 2, the surface that has them.
    gradient : float
        d ln(factor)/d ln(amplitude of these waves): Dang Van's largest factor near the surface of
        the body. Above 0: less of them lowers it.
    """

    surface: int
    gradient: float


def risk_bands(
    histories: Histories,
    z: int,
    point: int,
    ripples: Sequence[Ripple],
    slip: float,
    friction: float,
    poisson_ratio: float,
    fatigue_pa: float,
) -> list[RiskBand]:
    """Return the bands of all rough surfaces by their exponents in a point's factor, largest first.

    Parameters
    ----------
    histories : Histories
        Of the points of the body.
    z, point : int
        Indices of depth and point.
    ripples : sequence of Ripple
        Of the rough surfaces, as they were followed.
    slip, friction, poisson_ratio
        As of :func:`ehlwave.stress.history.follow`.
    fatigue_pa : float
        tau_f of Dang Van's criterion.
    """
    stress = {name: values[:, z, point] for name, values in histories.total.items()}
    if not 0 < float(dang_van_factor(stress, fatigue_pa)) < np.inf:
        return []
    bands = []
    for number, (ripple, (at, lines)) in enumerate(zip(ripples, histories.met, strict=True), 1):
        turn = _turn(ripple, float(at[point]), int(lines[point]))
        near = np.flatnonzero(histories.fall[:, z])
        waves = wave_stresses(
            ripple,
            histories.places_m[near],
            histories.depths_m[z : z + 1],
            ripple.slip / slip,
            friction,
            poisson_ratio,
        )
        place, lowest = _places(ripple)
        count = place.max() + 1
        parts = {name: np.zeros((histories.places_m.size, count)) for name in stress}
        for time, total in zip(near, waves, strict=True):
            for name, values in total.items():
                share = histories.fall[time, z] * (values[0] * turn).real.ravel()
                parts[name][time] = np.bincount(place, share)
        up, down = (
            np.log(
                dang_van_factor(
                    {
                        name: stress[name][:, None] + side * STEP * part
                        for name, part in parts.items()
                    },
                    fatigue_pa,
                )
            )
            for side in (1, -1)
        )
        bands += _bands((up - down) / (2 * STEP), ripple, place, lowest, number)
    return sorted(bands, key=lambda band: -band.gradient)


def _turn(ripple: Ripple, at: float, line: int) -> NDArray[np.complex128]:
    """Return the factors of waves (kx, ky) in the value of a point, which may be between two."""
    rows = np.arange(ripple.amplitude.shape[0])
    low = np.floor(at)
    steps = np.exp(2j * np.pi * np.outer(rows, [low, low + 1]) / ripple.points)
    along = (1 - at + low) * steps[:, 0] + (at - low) * steps[:, 1]
    twice = np.where((rows > 0) & (2 * rows != ripple.points), 2.0, 1.0)
    across = np.exp(1j * ripple.waves.number_y[0] * ripple.lines_m[line])
    return np.asarray((twice * along)[:, None] * across)


def _places(ripple: Ripple) -> tuple[NDArray[np.intp], int]:
    """Return the numbers of the bands of the waves, and the lowest octave."""
    numbers = ripple.waves.number_x, ripple.waves.number_y
    return places_of_bands(*(np.abs(number) / (2 * np.pi) for number in numbers))


def _bands(
    gradients: Floats, ripple: Ripple, place: NDArray[np.intp], lowest: int, surface: int
) -> Iterator[RiskBand]:
    """Yield the bands of a surface."""
    for one in np.unique(place[np.abs(ripple.amplitude.ravel()) > 0]):
        octave, turn = band_key(int(one), lowest)
        yield RiskBand(
            shortest_m=OCTAVE**octave,
            longest_m=OCTAVE ** (octave + 1),
            direction=DIRECTIONS[turn],
            surface=surface,
            gradient=float(gradients[one]),
        )


def risk_text(bands: Sequence[RiskBand], most: int = 3, least: float = 0.02) -> list[str]:
    """Return lines of a report: the waves to remove first."""
    return [
        f"{band.text}, surface {band.surface}: 1 % less amplitude gives {band.gradient:.2g} % "
        "less factor"
        for band in bands[:most]
        if band.gradient > least
    ]
