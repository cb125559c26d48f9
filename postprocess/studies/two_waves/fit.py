"""Fits of the rolling transfer and of the wave launched by the inlet, and their held-out errors."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from ehlwave.contact.rolling import AMPLITUDE, PHASE, rolling_transfer
from ehlwave.contact.two_waves import LAUNCH_LENGTH, SLIP_POWERS, Launch, launch_length, launched
from studies.folds import grouped_folds
from studies.two_waves.points import Pairs, Rolling

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]

SCATTER = 0.02
"""Scatter of the formulas, about: a point weighs s/sqrt(s^2 + e^2), e its error bar."""


@dataclass(frozen=True)
class Law:
    """Coefficients: rolling transfer, and wave launched by the inlet."""

    amplitude: Floats
    phase: Floats
    launch: Floats

    def rolling(self, points: Rolling | Pairs) -> Complex:
        """Return the transfer in pure rolling."""
        return _rolling(points, self.amplitude, self.phase)

    def film(self, pairs: Pairs, rolling: Complex | None = None) -> Complex:
        """Return a + c; `rolling` in place of the formula's transfer, as for the law alone."""
        transfer = self.rolling(pairs) if rolling is None else rolling
        return pairs.attenuated + complementary(self.launch, pairs, transfer)


PACKAGED = Law(np.array(AMPLITUDE), np.array(PHASE), np.array([*SLIP_POWERS, *LAUNCH_LENGTH]))
"""As installed."""


def complementary(launch: Floats, pairs: Pairs, rolling: Complex) -> Complex:
    """Return c of the law with these coefficients: the powers, and the three of the length."""
    powers, length = np.split(launch, [len(SLIP_POWERS)])
    columns = ("slip", "along", "load", "l", "alphabar", "thinning")
    slip, along, load, l, alphabar, thinning = (pairs.table[name].to_numpy() for name in columns)
    waves = pairs.attenuated, pairs.mismatch, pairs.mismatch_rolling
    place = slip, along, load, launch_length(load, l, alphabar, tuple(length)), thinning
    return launched(rolling, Launch(*waves, *place), tuple(powers))


def fitted_rolling(points: Rolling) -> tuple[Floats, Floats]:
    """Return the coefficients of amplitude and phase that fit best."""
    ratio, angle = np.abs(points.film), np.angle(points.film)
    weight = _weight(points.error)

    def amplitude_left(c: Floats) -> Floats:
        return weight * (np.abs(_rolling(points, c, PHASE)) - ratio)

    amplitude = _solution(amplitude_left, AMPLITUDE)

    def phase_left(c: Floats) -> Floats:
        return weight * ratio * (np.angle(_rolling(points, amplitude, c)) - angle)

    return amplitude, _solution(phase_left, PHASE)


def fitted_launch(pairs: Pairs, rolling: Complex | None = None) -> Floats:
    """Return the coefficients of the launched wave, with computed transfers in pure rolling."""
    transfer = pairs.rolling if rolling is None else rolling
    weight = _weight(pairs.error)

    def left(c: Floats) -> Floats:
        miss = weight * (pairs.attenuated + complementary(c, pairs, transfer) - pairs.film)
        return np.concatenate([miss.real, miss.imag])

    return _solution(left, [*SLIP_POWERS, *LAUNCH_LENGTH])


def fitted(rolling: Rolling, pairs: Pairs) -> Law:
    """Return the law that fits best."""
    return Law(*fitted_rolling(rolling), fitted_launch(pairs))


def held_out(rolling: Rolling, pairs: Pairs, folds: int = 10) -> tuple[Complex, Complex]:
    """Return the film of pure rolling and that under slip, each from fits without its condition.

    Whole operating conditions are left out, of both fits at once.
    """
    conditions = np.concatenate([rolling.table["condition"], pairs.table["condition"]]).astype(str)
    index = np.unique(conditions, return_inverse=True)[1]
    size = len(rolling.table)
    of_rolling, of_pairs = np.full(size, np.nan + 0j), np.full(len(pairs.table), np.nan + 0j)
    for fold in grouped_folds(index, folds):
        law = fitted(rolling.part(~fold[:size]), pairs.part(~fold[size:]))
        of_rolling[fold[:size]] = law.rolling(rolling.part(fold[:size]))
        of_pairs[fold[size:]] = law.film(pairs.part(fold[size:]))
    return of_rolling, of_pairs


def rms(left: NDArray[np.generic]) -> float:
    """Return the root mean square."""
    return float(np.sqrt(np.mean(np.abs(left) ** 2)))


def amplitude_error(film: Complex, computed: Complex) -> float:
    """Return the rms error of the film response |a + c|/Ai."""
    return rms(np.abs(film) - np.abs(computed))


def _rolling(points: Rolling | Pairs, amplitude: Floats, phase: Floats) -> Complex:
    t = points.table
    waves = (t["wavelength_x_over_a"].to_numpy(), t["wavelength_y_over_a"].to_numpy())
    return rolling_transfer(
        t["m"].to_numpy(), t["l"].to_numpy(), t["gamma"].to_numpy(), *waves, amplitude, phase
    )


def _weight(error: Floats) -> Floats:
    return SCATTER / np.hypot(SCATTER, error)


def _solution(left: Callable[[Floats], Floats], start: Floats) -> Floats:
    return np.asarray(least_squares(left, np.asarray(start, float), x_scale="jac", max_nfev=400).x)
