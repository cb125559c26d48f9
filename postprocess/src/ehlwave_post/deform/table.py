"""Harmonic tables: computed transfers of single waves, interpolated to any component.

A table has one row per wave: the operating condition ``M``, ``L``, ``D``, and ``slip_parameter``
(1 if absent); the wave by ``lambda_x_over_a`` and ``lambda_y_over_b``, 0 standing for infinite,
or by ``lambda_over_a`` (the smaller, both in units of a) and ``r`` = lambda_x/lambda_y; and the
transfer by ``transfer_real`` and ``transfer_imag``, or by ``amplitude_ratio``, which has no phase.
CSV, or HDF5 with one dataset per column.
"""

from pathlib import Path

import h5py
import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from ehlwave_post.deform.conditions import Conditions, ellipticity
from ehlwave_post.deform.transfer import Waves
from ehlwave_post.errors import SurfaceError
from ehlwave_post.formula import amplitude_ratio_formula, f_of_r

CONDITION_COLUMNS = ("M", "L", "D")
LARGEST_DIFFERENCE = 0.01
"""Relative, between the M, L, D of a contact and those of a table's rows that are used for it."""


FINE_POINTS = 2000
"""Of each curve, between which it is interpolated linearly: millions of components want it fast."""


class _Curve:
    """Transfers of one orientation against the logarithm of f(r) min(lambda)/a."""

    def __init__(self, angle: float, log_wave: Waves, transfer: NDArray[np.complex128]) -> None:
        """Interpolate real and imaginary part monotonically between increasing waves."""
        self.angle = angle
        self.log_wave = log_wave
        self._fine = np.linspace(log_wave[0], log_wave[-1], FINE_POINTS)
        real = PchipInterpolator(log_wave, transfer.real)(self._fine)
        self._values = real + 1j * PchipInterpolator(log_wave, transfer.imag)(self._fine)

    def at(self, log_wave: Waves, v_per_wave: float) -> NDArray[np.complex128]:
        """Return the transfer.

        Beyond the ends it is continued: towards short waves to 1, its difference from 1 in
        proportion to the wavelength as in formula (18); towards long waves in proportion to the
        formula, so that the mean has 0.
        """
        value = np.interp(log_wave, self._fine, self._values)
        short = log_wave < self.log_wave[0]
        if np.any(short):
            share = np.exp(log_wave[short] - self.log_wave[0])
            value[short] = 1 - (1 - self._values[0]) * share
        long = log_wave > self.log_wave[-1]
        if np.any(long):
            end = amplitude_ratio_formula(v_per_wave * np.exp(self.log_wave[-1]))
            value[long] *= amplitude_ratio_formula(v_per_wave * np.exp(log_wave[long])) / end
        return np.asarray(value)

    def holds(self, log_wave: Waves, slack: float) -> NDArray[np.bool_]:
        """Return whether waves lie within the curve."""
        low, high = self.log_wave[0] - slack, self.log_wave[-1] + slack
        return np.asarray((log_wave >= low) & (log_wave <= high))


class TableTransfer:
    """Transfer by interpolation in a harmonic table of the contact's own condition.

    Along each orientation of the table, real and imaginary part are interpolated monotonically
    (PCHIP) in log(f(r) lambda/a), lambda the smaller wavelength; between orientations linearly in
    the angle arctan(lambda_x/lambda_y). A table whose transfer depends on f(r) lambda alone is thus
    interpolated across orientations without error.
    """

    def __init__(self, conditions: Conditions, rows: pd.DataFrame, name: str = "table") -> None:
        """Make curves from rows of :func:`read_table`.

        Raises
        ------
        SurfaceError
            If no rows belong to the condition, or no orientation has two wavelengths.
        """
        self._conditions = conditions
        self._name = name
        chosen = _of_condition(rows, conditions, name)
        self._curves = _curves(chosen, name)
        self._v_per_wave = conditions.v_per_wavelength * conditions.semi_axis_a_m

    @property
    def name(self) -> str:
        """Name and size of the table."""
        waves = sum(curve.log_wave.size for curve in self._curves)
        return f"harmonic table {self._name}, {waves} waves of {len(self._curves)} orientations"

    @property
    def covers_all(self) -> bool:
        """A table ends somewhere."""
        return False

    @property
    def outside_reason(self) -> str:
        """Why components are not covered."""
        return (
            f"outside the wavelengths and orientations of {self._name}: continued beyond its edge"
        )

    def ratio(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.complex128]:
        """Return the transfer for waves per metre along x (any sign) and y."""
        angle, log_wave, shape = self._polar(per_length_x, per_length_y)
        value = np.empty(angle.shape, dtype=np.complex128)
        angles = [curve.angle for curve in self._curves]
        upper = np.clip(np.searchsorted(angles, angle, side="right"), 1, max(1, len(angles) - 1))
        for index in range(1, max(2, len(angles))):
            chosen = upper == index
            low = self._curves[index - 1]
            high = self._curves[min(index, len(angles) - 1)]
            width = high.angle - low.angle
            share = np.clip((angle[chosen] - low.angle) / width, 0, 1) if width > 0 else 0.0
            wave = log_wave[chosen]
            value[chosen] = (1 - share) * low.at(wave, self._v_per_wave) + share * high.at(
                wave, self._v_per_wave
            )
        value = value.reshape(shape)
        value.imag *= np.sign(np.broadcast_to(per_length_x, shape))
        return value

    def is_covered(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.bool_]:
        """Return whether a wave lies within the wavelengths and orientations of the table."""
        angle, log_wave, shape = self._polar(per_length_x, per_length_y)
        slack = 1e-9
        inside = np.zeros(angle.shape, dtype=bool)
        for index, low in enumerate(self._curves):
            near = np.abs(angle - low.angle) <= 1e-6
            inside |= near & low.holds(log_wave, slack)
            for high in self._curves[index + 1 : index + 2]:
                between = (angle >= low.angle) & (angle <= high.angle)
                inside |= between & low.holds(log_wave, slack) & high.holds(log_wave, slack)
        return inside.reshape(shape)

    def _polar(
        self, per_length_x: Waves, per_length_y: Waves
    ) -> tuple[Waves, Waves, tuple[int, ...]]:
        """Return arctan(r), log(f(r) lambda/a) of flattened waves, and their shape."""
        qx, qy = np.broadcast_arrays(np.abs(per_length_x), np.abs(per_length_y))
        a = self._conditions.semi_axis_a_m
        longest = np.maximum(qx, qy)
        with np.errstate(divide="ignore", invalid="ignore"):
            # f = exp(1 - 1/r) for r = qy/qx > 1
            log_f = np.where(qy > qx, 1 - qx / qy, 0.0)
            log_wave = log_f - np.log(longest * a)
        return np.arctan2(qy, qx).ravel(), log_wave.ravel(), qx.shape


def read_table(path: str | Path) -> pd.DataFrame:
    """Read a harmonic table.

    Returns
    -------
    pandas.DataFrame
        Columns ``M``, ``L``, ``D``, ``slip_parameter``, ``angle`` = arctan(lambda_x/lambda_y),
        ``log_wave`` = log(f(r) min(lambda)/a), ``transfer_real``, ``transfer_imag``. Rows without
        a finite transfer are left out.

    Raises
    ------
    SurfaceError
        If the file cannot be read or a column is missing.
    """
    file = Path(path)
    if not file.is_file():
        raise SurfaceError(f"{file}: no such file")
    try:
        if file.suffix.lower() == ".csv":
            raw = pd.read_csv(file, comment="#", skipinitialspace=True)
        else:
            with h5py.File(file, "r") as opened:
                raw = pd.DataFrame(
                    {key: opened[key][()] for key in opened if opened[key].ndim == 1}
                )
    except (OSError, ValueError, AttributeError, pd.errors.ParserError) as error:
        raise SurfaceError(f"{file}: not a harmonic table ({error})") from error
    return table_rows(raw, str(file))


def table_rows(raw: pd.DataFrame, place: str) -> pd.DataFrame:
    """Return the rows of a table with the columns of :func:`read_table`, whatever it is given by.

    Raises
    ------
    SurfaceError
        If a column is missing or not numeric.
    """
    needed = [*CONDITION_COLUMNS]
    needed += ["lambda_over_a", "r"] if "r" in raw else ["lambda_x_over_a", "lambda_y_over_b"]
    needed += ["transfer_real", "transfer_imag"] if "transfer_real" in raw else ["amplitude_ratio"]
    for column in needed:
        if column not in raw:
            raise SurfaceError(f"{place}: a harmonic table needs the column {column}")
        if raw[column].dtype.kind not in "fiu":
            raise SurfaceError(f"{place}: column {column} does not hold numbers")
    rows = raw[[*CONDITION_COLUMNS]].astype(float)
    rows["slip_parameter"] = raw.get("slip_parameter", 1.0)
    if "r" in raw:
        ratio, wave = raw["r"].to_numpy(float), raw["lambda_over_a"].to_numpy(float)
    else:
        kappa = raw["D"].map({d: ellipticity(d) for d in raw["D"].unique()}).to_numpy(float)
        wave_x = raw["lambda_x_over_a"].to_numpy(float)
        wave_y = raw["lambda_y_over_b"].to_numpy(float) / kappa
        with np.errstate(divide="ignore", invalid="ignore"):
            qx, qy = np.where(wave_x > 0, 1 / wave_x, 0.0), np.where(wave_y > 0, 1 / wave_y, 0.0)
            ratio, wave = np.where(qx > 0, qy / qx, np.inf), 1 / np.maximum(qx, qy)
    rows["angle"] = np.arctan(ratio)
    with np.errstate(divide="ignore"):
        rows["log_wave"] = np.log(f_of_r(ratio) * wave)
    if "transfer_real" in raw:
        rows["transfer_real"], rows["transfer_imag"] = raw["transfer_real"], raw["transfer_imag"]
    else:
        rows["transfer_real"], rows["transfer_imag"] = raw["amplitude_ratio"], 0.0
    finite = np.isfinite(rows.drop(columns="slip_parameter")).all(axis=1)
    return rows[finite]


def _of_condition(rows: pd.DataFrame, conditions: Conditions, name: str) -> pd.DataFrame:
    wanted = {"M": conditions.m, "L": conditions.l, "D": conditions.d}
    off = np.max([np.abs(rows[key] / value - 1) for key, value in wanted.items()], axis=0)
    same_slip = np.abs(rows["slip_parameter"] - conditions.slip_parameter) < 1e-6
    chosen = rows[(off <= LARGEST_DIFFERENCE) & same_slip]
    if chosen.empty:
        there = rows[[*CONDITION_COLUMNS, "slip_parameter"]].drop_duplicates()
        if len(rows):
            there = there.loc[[rows.index[int(np.argmin(off))]]] if len(there) > 4 else there
        text = "; ".join(
            f"M = {row.M:g}, L = {row.L:g}, D = {row.D:g}, S = {row.slip_parameter:g}"
            for row in there.itertuples()
        )
        raise SurfaceError(
            f"{name}: has no rows for M = {conditions.m:.5g}, L = {conditions.l:.5g}, "
            f"D = {conditions.d:.5g}, S = {conditions.slip_parameter:g} (within 1 %); nearest or "
            f"all: {text or 'none'}. Compute the table for this condition, or use the formula"
        )
    return chosen


def _curves(rows: pd.DataFrame, name: str) -> list[_Curve]:
    curves = []
    for angle, members in rows.groupby(rows["angle"].round(6)):
        of_wave = members.groupby(members["log_wave"].round(9)).mean()
        if len(of_wave) < 2:
            continue
        waves = of_wave["log_wave"].to_numpy()
        imag = of_wave["transfer_imag"].to_numpy()
        if float(angle) > np.pi / 2 - 1e-5:
            imag = np.zeros_like(imag)  # standing ridges: nothing moves, no phase
        curves.append(_Curve(float(angle), waves, of_wave["transfer_real"].to_numpy() + 1j * imag))
    if not curves:
        raise SurfaceError(f"{name}: no orientation has two or more wavelengths to interpolate in")
    return curves
