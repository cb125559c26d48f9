"""Harmonic tables: computed transfers of single waves, interpolated to any component."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.laws.table_conditions import weighted_conditions
from ehlwave.laws.table_curves import Chart, Complex, curves_of, rise_curves_of
from ehlwave.laws.table_read import read_table
from ehlwave.laws.transfer import Transfer, Waves, orientation_and_wave


@dataclass(frozen=True, eq=False)
class HarmonicTable:
    """A harmonic table, and its name in messages."""

    rows: pd.DataFrame
    name: str = "table"


def harmonic_table_of(given: str | Path | pd.DataFrame | HarmonicTable) -> HarmonicTable:
    """Return the harmonic table of a file, or of rows of :func:`ehlwave.surface.read_table`."""
    if isinstance(given, HarmonicTable):
        return given
    if isinstance(given, pd.DataFrame):
        return HarmonicTable(given)
    return HarmonicTable(read_table(given), Path(given).name)


class TableTransfer(Transfer):
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
        self._charts = [(weight, Chart(curves_of(part, name))) for weight, part in chosen]
        rises = [(weight, rise_curves_of(part, name)) for weight, part in chosen]
        self._rises = [(weight, Chart(curves)) for weight, curves in rises if curves]

    @property
    def name(self) -> str:
        """Name and size of the table."""
        curves = [curve for _, chart in self._charts for curve in chart.curves]
        waves = sum(curve.log_v.size for curve in curves)
        between = f" between {len(self._charts)} conditions" if len(self._charts) > 1 else ""
        return f"harmonic table {self._name}, {waves} waves{between}"

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
        """Return the absolute error of the transfer; None of tables without ``transfer_error``.

        It has the errors of the waves and of the interpolation. Between conditions a share of their
        differences counts, a quarter half-way.
        """
        if not all(curve.has_error for _, chart in self._charts for curve in chart.curves):
            return None
        angle, log_v, shape = self._polar(per_length_x, per_length_y)
        found = np.zeros(angle.shape)
        seen: list[tuple[float, Complex]] = []
        for weight, chart in self._charts:
            value = chart.at(angle, log_v)
            found += weight * chart.error(angle, log_v)
            for other_weight, other in seen:
                found += weight * other_weight * np.abs(value - other)
            seen.append((weight, value))
        found[~np.isfinite(log_v)] = 0  # the mean is not deformed
        return found.reshape(shape)

    def is_covered(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.bool_]:
        """Return whether a wave lies within the wavelengths and orientations of the table."""
        angle, log_v, shape = self._polar(per_length_x, per_length_y)
        inside = np.ones(angle.shape, dtype=bool)
        for _, chart in self._charts:
            inside &= chart.holds(angle, log_v)
        return inside.reshape(shape)

    def _weighted(
        self, charts: list[tuple[float, Chart]], per_length_x: Waves, per_length_y: Waves
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
