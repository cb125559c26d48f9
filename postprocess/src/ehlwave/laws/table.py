"""Harmonic tables: computed transfers of single waves, interpolated to any component."""

from dataclasses import replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.contact.formula import amplitude_ratio_formula
from ehlwave.errors import SurfaceError
from ehlwave.laws.table_conditions import weighted_conditions
from ehlwave.laws.transfer import Waves, orientation_and_wave

Complex = NDArray[np.complex128]

FINE_POINTS = 2000
"""Of each curve, between which it is interpolated linearly: millions of components want it fast."""


class _Curve:
    """Transfers of an orientation against log(f(r) V), V of the smaller wavelength."""

    def __init__(self, angle: float, log_v: Waves, transfer: Complex) -> None:
        """Interpolate real and imaginary part monotonically between increasing waves."""
        self.angle = angle
        self.log_v = log_v
        self._fine = np.linspace(log_v[0], log_v[-1], FINE_POINTS)
        real = PchipInterpolator(log_v, transfer.real)(self._fine)
        self._values = real + 1j * PchipInterpolator(log_v, transfer.imag)(self._fine)

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


class _RiseCurve(_Curve):
    """Rise of the mean film in place of the transfer: real."""

    def at(self, log_v: Waves) -> Complex:
        """Return the rise; beyond the ends constant, or falling with the square of the formula."""
        return self._continued(log_v, 2)


class _Chart:
    """Transfers of a condition: curves of several orientations, by their angle."""

    def __init__(self, curves: list[_Curve]) -> None:
        self.curves = curves

    def at(self, angle: Waves, log_v: Waves) -> Complex:
        """Return transfers, linear in the angle between curves, the nearest curve beyond them."""
        value = np.empty(angle.shape, dtype=np.complex128)
        angles = [curve.angle for curve in self.curves]
        last = max(1, len(angles) - 1)
        upper = np.clip(np.searchsorted(angles, angle, side="right"), 1, last)
        for index in range(1, last + 1):
            chosen = upper == index
            low, high = self.curves[index - 1], self.curves[min(index, len(angles) - 1)]
            width = high.angle - low.angle
            share = np.clip((angle[chosen] - low.angle) / width, 0, 1) if width > 0 else 0.0
            wave = log_v[chosen]
            value[chosen] = (1 - share) * low.at(wave) + share * high.at(wave)
        return value

    def holds(self, angle: Waves, log_v: Waves) -> NDArray[np.bool_]:
        """Return whether waves lie within the curves on both sides of their angle."""
        inside = np.zeros(angle.shape, dtype=bool)
        for index, low in enumerate(self.curves):
            inside |= (np.abs(angle - low.angle) <= 1e-6) & low.holds(log_v)
            for high in self.curves[index + 1 : index + 2]:
                between = (angle >= low.angle) & (angle <= high.angle)
                inside |= between & low.holds(log_v) & high.holds(log_v)
        return inside


class TableTransfer:
    """Transfer by interpolation in a harmonic table.

    Along each orientation of the table, real and imaginary part are interpolated monotonically
    (PCHIP) in log(f(r) V), V of the smaller wavelength; between orientations linearly in the angle
    arctan(lambda_x/lambda_y); between conditions as in
    :func:`ehlwave.laws.table_conditions.weighted_conditions`. Transfers that depend on f(r) V alone
    are thus interpolated across orientations and conditions without error.
    """

    def __init__(self, conditions: Conditions, rows: pd.DataFrame, name: str = "table") -> None:
        """Make curves from rows of :func:`ehlwave.laws.table_read.read_table`.

        Raises SurfaceError if the contact does not lie among the table's conditions, or no
        orientation of a condition has two wavelengths.
        """
        self._name = name
        self._v_per_wavelength = conditions.v_per_wavelength
        chosen = weighted_conditions(rows, conditions, name)
        self._charts = [(weight, _Chart(_curves(part, name))) for weight, part in chosen]
        rises = [(weight, _rise_curves(part, name)) for weight, part in chosen]
        self._rises = [(weight, _Chart(curves)) for weight, curves in rises if curves]

    @property
    def name(self) -> str:
        """Name and size of the table."""
        curves = [curve for _, chart in self._charts for curve in chart.curves]
        waves = sum(curve.log_v.size for curve in curves)
        between = f" between {len(self._charts)} conditions" if len(self._charts) > 1 else ""
        return f"harmonic table {self._name}, {waves} waves{between}"

    @property
    def covers_all(self) -> bool:
        """A table ends somewhere."""
        return False

    @property
    def outside_reason(self) -> str:
        """Why components are not covered."""
        return f"outside the wavelengths and orientations of {self._name}: continued beyond its end"

    def ratio(self, per_length_x: Waves, per_length_y: Waves) -> Complex:
        """Return the transfer for waves per metre along x (any sign) and y."""
        value = self._weighted(self._charts, per_length_x, per_length_y)
        value.imag *= np.sign(np.broadcast_to(per_length_x, value.shape))
        return value

    def rise(self, per_length_x: Waves, per_length_y: Waves) -> Waves | None:
        """Return ``mean_rise`` of waves; None if a wave of the contact's conditions has none."""
        if len(self._rises) < len(self._charts):
            return None
        return self._weighted(self._rises, per_length_x, per_length_y).real

    def error(self, per_length_x: Waves, per_length_y: Waves) -> Waves | None:
        """Return None: tables come without errors."""

    def is_covered(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.bool_]:
        """Return whether a wave lies within the wavelengths and orientations of the table."""
        angle, log_v, shape = self._polar(per_length_x, per_length_y)
        inside = np.ones(angle.shape, dtype=bool)
        for _, chart in self._charts:
            inside &= chart.holds(angle, log_v)
        return inside.reshape(shape)

    def _weighted(
        self, charts: list[tuple[float, _Chart]], per_length_x: Waves, per_length_y: Waves
    ) -> Complex:
        """Return the values of charts by their weights."""
        angle, log_v, shape = self._polar(per_length_x, per_length_y)
        value = np.zeros(angle.shape, dtype=np.complex128)
        for weight, chart in charts:
            value += weight * chart.at(angle, log_v)
        return value.reshape(shape)

    def _polar(
        self, per_length_x: Waves, per_length_y: Waves
    ) -> tuple[Waves, Waves, tuple[int, ...]]:
        """Return arctan(r), log(f(r) V) of flattened waves, and their shape."""
        qx, qy = np.broadcast_arrays(np.abs(per_length_x), np.abs(per_length_y))
        factor, wavelength = orientation_and_wave(qx, qy)
        log_v = np.log(factor * wavelength * self._v_per_wavelength)
        return np.arctan2(qy, qx).ravel(), log_v.ravel(), qx.shape


def _curves(rows: pd.DataFrame, name: str) -> list[_Curve]:
    curves = []
    for angle, log_v, of_wave in _orientations(rows, name):
        transfer = of_wave["transfer_real"].to_numpy() + 1j * of_wave["transfer_imag"].to_numpy()
        if angle > np.pi / 2 - 1e-5:
            transfer.imag = 0  # standing ridges: nothing moves, no phase
        curves.append(_Curve(angle, log_v, transfer))
    if not curves:
        raise SurfaceError(f"{name}: no orientation has two or more wavelengths to interpolate in")
    return curves


def _rise_curves(rows: pd.DataFrame, name: str) -> list[_Curve]:
    """Return curves of the rise of the mean, none if a wave has none."""
    groups = _orientations(rows, name)
    if not all(np.isfinite(of_wave["mean_rise"]).all() for _, _, of_wave in groups):
        return []
    return [
        _RiseCurve(angle, log_v, of_wave["mean_rise"].to_numpy(dtype=complex))
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
        numbers = members[["log_wave", "transfer_real", "transfer_imag", "mean_rise"]]
        of_wave = numbers.groupby(members["log_wave"].round(9)).mean()
        if len(of_wave) >= 2:
            groups.append(
                (float(angle), of_wave["log_wave"].to_numpy() + np.log(v_per_wave), of_wave)
            )
    return groups
