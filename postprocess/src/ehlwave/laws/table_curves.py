"""Curves of harmonic tables: responses along orientations, interpolated, with their errors."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pandas as pd
import scipy
from numpy.typing import NDArray

from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.contact.formula import amplitude_ratio_formula
from ehlwave.errors import SurfaceError
from ehlwave.laws.table_read import OPTIONAL
from ehlwave.laws.transfer import Waves

Complex = NDArray[np.complex128]

FINE_POINTS = 2000
"""Points of each curve, between which it is interpolated linearly, for millions of components."""
HALVED = 4.0
"""Divisor of the error of an interpolation when its intervals are halved."""


class Curve:
    """Transfers of an orientation against log(f(r) V), V of the smaller wavelength."""

    def __init__(
        self, angle: float, log_v: Waves, transfer: Complex, error: Waves | None = None
    ) -> None:
        """Interpolate real and imaginary part monotonically between increasing waves.

        `error` belongs to the transfers, absolute; None: not known.
        """
        self.angle = angle
        self.log_v = log_v
        self._fine = np.linspace(log_v[0], log_v[-1], FINE_POINTS)
        self._values = _monotone(log_v, transfer, self._fine)
        self._node_errors = error
        self._between = _between(log_v, transfer)

    @property
    def has_error(self) -> bool:
        """Whether the errors of the transfers are known."""
        return self._node_errors is not None

    def at(self, log_v: Waves) -> Complex:
        """Return the transfer.

        Beyond the ends it is continued: towards short waves to 1, its difference from 1 in
        proportion to the wavelength as in formula (18); towards long waves in proportion to the
        formula, so that the mean has 0.
        """
        value = self._continued(log_v, 1)
        short = log_v < self.log_v[0]
        if np.any(short):
            value[short] = 1 - (1 - self._values[0]) * np.exp(log_v[short] - self.log_v[0])
        return value

    def error(self, log_v: Waves) -> Complex:
        """Return the absolute error: of the waves, of the interpolation, of the continuation."""
        inside = np.clip(log_v, self.log_v[0], self.log_v[-1])
        interval = np.clip(np.searchsorted(self.log_v, inside) - 1, 0, self._between.size - 1)
        assert self._node_errors is not None, "asked where has_error is"
        found = np.interp(inside, self.log_v, self._node_errors) + self._between[interval]
        value = self.at(log_v)
        found += np.where(log_v < self.log_v[0] - 1e-9, np.abs(1 - value), 0)
        return np.asarray(found + np.where(log_v > self.log_v[-1] + 1e-9, np.abs(value), 0))

    def holds(self, log_v: Waves) -> NDArray[np.bool_]:
        """Return whether waves lie within the curve."""
        return np.asarray((log_v >= self.log_v[0] - 1e-9) & (log_v <= self.log_v[-1] + 1e-9))

    def _continued(self, log_v: Waves, power: int) -> Complex:
        """Return values: the first for shorter waves, a power of the formula for longer waves."""
        value = np.interp(log_v, self._fine, self._values)
        long = log_v > self.log_v[-1]
        if np.any(long):
            end = amplitude_ratio_formula(np.exp(self.log_v[-1]))
            value[long] *= (amplitude_ratio_formula(np.exp(log_v[long])) / end) ** power
        return np.asarray(value)


class RiseCurve(Curve):
    """Rise of the mean film in place of the transfer: real."""

    def at(self, log_v: Waves) -> Complex:
        """Return the rise; beyond the ends constant, or falling with the square of the formula."""
        return self._continued(log_v, 2)


def _monotone(log_v: Waves, transfer: Complex, at: Waves) -> Complex:
    real = scipy.interpolate.PchipInterpolator(log_v, transfer.real)(at)
    return np.asarray(real + 1j * scipy.interpolate.PchipInterpolator(log_v, transfer.imag)(at))


def _between(log_v: Waves, transfer: Complex) -> Waves:
    """Return the error of the interpolation in each interval.

    Without a wave the interpolation misses it by HALVED times its error half-way with it. Two or
    three waves alone: a quarter of their differences.
    """
    count = log_v.size
    if count < 4:
        return np.abs(np.diff(transfer)) / HALVED
    missed = np.zeros(count)
    for k in range(1, count - 1):
        left = np.delete(np.arange(count), k)
        found = _monotone(log_v[left], transfer[left], log_v[k : k + 1])
        missed[k] = abs(found[0] - transfer[k]) / HALVED
    missed[[0, -1]] = missed[[1, -2]]
    return np.maximum(missed[:-1], missed[1:])


class Chart:
    """Transfers of a condition: curves of several orientations, by their angle."""

    def __init__(self, curves: list[Curve]) -> None:
        self.curves = curves

    def at(self, angle: Waves, log_v: Waves) -> Complex:
        """Return transfers, linear in the angle between curves, the nearest curve beyond them."""
        value = np.empty(angle.shape, dtype=np.complex128)
        for chosen, low, high, share in self._sectors(angle):
            wave = log_v[chosen]
            value[chosen] = (1 - share) * low.at(wave) + share * high.at(wave)
        return value

    def error(self, angle: Waves, log_v: Waves) -> Waves:
        """Return absolute errors; half-way between curves a quarter of their difference counts."""
        value = np.empty(angle.shape)
        for chosen, low, high, share in self._sectors(angle):
            wave = log_v[chosen]
            own = (1 - share) * low.error(wave) + share * high.error(wave)
            value[chosen] = own + share * (1 - share) * np.abs(high.at(wave) - low.at(wave))
        return value

    def _sectors(self, angle: Waves) -> Iterator[tuple[NDArray[np.bool_], Curve, Curve, Waves]]:
        """Yield which angles lie between two curves, the curves and the share of the second."""
        angles = [curve.angle for curve in self.curves]
        last = max(1, len(angles) - 1)
        upper = np.clip(np.searchsorted(angles, angle, side="right"), 1, last)
        for index in range(1, last + 1):
            chosen = upper == index
            low, high = self.curves[index - 1], self.curves[min(index, len(angles) - 1)]
            width = high.angle - low.angle
            share = np.clip((angle[chosen] - low.angle) / (width or np.inf), 0, 1)
            yield chosen, low, high, share

    def holds(self, angle: Waves, log_v: Waves) -> NDArray[np.bool_]:
        """Return whether waves lie within the curves on both sides of their angle."""
        inside = np.zeros(angle.shape, dtype=bool)
        for index, low in enumerate(self.curves):
            inside |= (np.abs(angle - low.angle) <= 1e-6) & low.holds(log_v)
            for high in self.curves[index + 1 : index + 2]:
                between = (angle >= low.angle) & (angle <= high.angle)
                inside |= between & low.holds(log_v) & high.holds(log_v)
        return inside


def curves_of(rows: pd.DataFrame, name: str) -> list[Curve]:
    """Return curves of the transfer, one an orientation with two waves or more."""
    curves = []
    for angle, log_v, of_wave in _orientations(rows, name):
        transfer = of_wave["transfer_real"].to_numpy() + 1j * of_wave["transfer_imag"].to_numpy()
        if angle > np.pi / 2 - 1e-5:
            transfer.imag = 0  # standing ridges: nothing moves, no phase
        error = of_wave["transfer_error"].to_numpy()
        is_known = bool(np.isfinite(error).all())
        curves.append(Curve(angle, log_v, transfer, error if is_known else None))
    if not curves:
        raise SurfaceError(f"{name}: no orientation has two or more wavelengths to interpolate in")
    return curves


def rise_curves_of(rows: pd.DataFrame, name: str) -> list[Curve]:
    """Return curves of the rise of the mean, none if a wave has none."""
    groups = _orientations(rows, name)
    if not all(np.isfinite(of_wave["mean_rise"]).all() for _, _, of_wave in groups):
        return []
    return [
        RiseCurve(angle, log_v, of_wave["mean_rise"].to_numpy(dtype=complex))
        for angle, log_v, of_wave in groups
    ]


def _orientations(rows: pd.DataFrame, name: str) -> list[tuple[float, Waves, pd.DataFrame]]:
    """Return angle, log(f(r) V) and means of the waves of each orientation with two or more."""
    m, l, d = (float(rows[key].iloc[0]) for key in ("M", "L", "D"))  # noqa: E741
    moes = {"load_parameter_m": m, "lubricant_parameter_l": l, "radius_ratio_d": d}
    contact = conditions_from_keys(moes, name, needs_lengths=False)
    # With a = 1 a wavelength in units of a is in metres.
    v_per_wave = replace(contact, semi_axis_a_m=1.0).v_per_wavelength
    groups = []
    for angle, members in rows.groupby(rows["angle"].round(6)):
        numbers = members[["log_wave", "transfer_real", "transfer_imag", *OPTIONAL]]
        of_wave = numbers.groupby(members["log_wave"].round(9)).mean()
        if len(of_wave) >= 2:
            groups.append(
                (float(angle), of_wave["log_wave"].to_numpy() + np.log(v_per_wave), of_wave)
            )
    return groups
