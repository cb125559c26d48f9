"""Read harmonic tables.

A table has a row per wave: the operating condition ``M``, ``L``, ``D``, and ``slip_parameter`` (1
if absent) or ``slide_to_roll_ratio``; the wave by ``lambda_x_over_a`` and ``lambda_y_over_b``, 0
for infinite, or by ``lambda_over_a`` (the smaller, both in units of a) and ``r`` =
lambda_x/lambda_y; and the transfer by ``transfer_real`` and ``transfer_imag``, or by
``amplitude_ratio``, which has no phase. CSV, or HDF5 with a dataset per column.

The transfer is the ratio of the film's component at the contact centre to the surface's, both
written as exp(i qx x) with x counted on the surface along its motion.

``mean_rise``, which may be absent, is the rise of the mean film at the contact centre by such a
wave of amplitude A, to second order: (mean film less smooth film)/film = ``mean_rise`` (A/film)^2.

``transfer_error``, which may be absent, is the absolute error of the transfer.

Other keys that a response depends on (:mod:`ehlwave.laws.table_keys`) are columns of their names;
a table serves contacts whose keys are its own.
"""

from pathlib import Path

import h5py
import numpy as np
import pandas as pd

from ehlwave.contact.formula import f_of_r
from ehlwave.contact.moes_parameters import SMALLEST_RADIUS_RATIO
from ehlwave.contact.scales import ellipticity
from ehlwave.errors import ResultsError, SurfaceError
from ehlwave.hdf5 import check_is_file, opened, reason
from ehlwave.inputs.slip import RATIO, SLIP, refuse_both, slip_of
from ehlwave.laws.table_keys import table_columns
from ehlwave.laws.table_matching import refuse_two_responses

CONDITION_COLUMNS = ("M", "L", "D")
OPTIONAL = ("mean_rise", "transfer_error")
"""Columns of numbers that a table need not have."""


def read_table(path: str | Path) -> pd.DataFrame:
    """Read a harmonic table.

    Returns
    -------
    pandas.DataFrame
        Columns ``M``, ``L``, ``D``, ``slip_parameter``, ``angle`` = arctan(lambda_x/lambda_y),
        ``log_wave`` = log(f(r) min(lambda)/a), ``transfer_real``, ``transfer_imag``, ``mean_rise``
        and ``transfer_error`` (NaN where they are not known). Rows without a finite transfer are
        left out.

    Raises
    ------
    SurfaceError
        If the file cannot be read or a column is missing.
    """
    file = Path(path)
    try:
        check_is_file(file)
        if file.suffix.lower() == ".csv":
            raw = pd.read_csv(file, comment="#", skipinitialspace=True)
        else:
            with opened(file) as inside:
                names = [name for name in inside if isinstance(inside[name], h5py.Dataset)]
                raw = pd.DataFrame(
                    {name: inside[name][()] for name in names if inside[name].ndim == 1}
                )
    except ResultsError as error:
        raise SurfaceError(str(error)) from error
    except Exception as error:
        # The readers raise whatever a damaged file makes them stumble into.
        raise SurfaceError(f"{file}: not a harmonic table ({reason(error)})") from error
    return table_rows(raw, str(file))


def table_rows(raw: pd.DataFrame, place: str) -> pd.DataFrame:
    """Return the rows of a table with the columns of :func:`read_table`, whatever it is given by.

    Raises SurfaceError if a column is missing or not numeric.
    """
    raw = _with_slip(raw, place)
    needed = [*CONDITION_COLUMNS]
    needed += ["lambda_over_a", "r"] if "r" in raw else ["lambda_x_over_a", "lambda_y_over_b"]
    needed += ["transfer_real", "transfer_imag"] if "transfer_real" in raw else ["amplitude_ratio"]
    for column in needed:
        if column not in raw:
            raise SurfaceError(f"{place}: a harmonic table needs the column {column}")
        if raw[column].dtype.kind not in "fiu":
            raise SurfaceError(f"{place}: column {column} does not hold numbers")
    _check_numbers(raw, needed, place)
    rows = raw[[*CONDITION_COLUMNS]].astype(float)
    rows[SLIP] = raw.get(SLIP, 1.0)
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
    for column in OPTIONAL:
        rows[column] = raw.get(column, np.nan)
    rows = rows.assign(**table_columns(raw, place))[finite]
    refuse_two_responses(rows, place)
    return rows


def _with_slip(raw: pd.DataFrame, place: str) -> pd.DataFrame:
    """Return a table with the slip parameter where it has slide-to-roll ratios."""
    refuse_both({name: "a column" for name in (SLIP, RATIO) if name in raw}, place)
    if RATIO not in raw:
        return raw
    if raw[RATIO].dtype.kind not in "fiu":
        raise SurfaceError(f"{place}: column {RATIO} does not hold numbers")
    return raw.assign(**{SLIP: raw[RATIO].map(slip_of)}).drop(columns=RATIO)


def _check_numbers(raw: pd.DataFrame, needed: list[str], place: str) -> None:
    """Refuse optional columns that are not numbers, and numbers that no contact or wave has."""
    for column in ("slip_parameter", *OPTIONAL):
        if column in raw and raw[column].dtype.kind not in "fiu":
            raise SurfaceError(f"{place}: column {column} does not hold numbers")
    slip = raw.get("slip_parameter", pd.Series(1.0)).to_numpy(float)
    if not ((slip >= 0) & (slip <= 2)).all():
        wrong_slip = slip[~((slip >= 0) & (slip <= 2))][0]
        raise SurfaceError(f"{place}: slip_parameter = {wrong_slip:g} must lie in 0 to 2")
    least = {name: 0.0 for name in needed if name.startswith("lambda_") or name == "r"}
    above = {"M": np.inf, "L": np.inf, "D": 1.0}
    for column, most in above.items():
        values = raw[column].to_numpy(float)
        wrong = ~((values > 0) & (values <= most) & np.isfinite(values))
        wrong |= (values < SMALLEST_RADIUS_RATIO) & (column == "D")
        if wrong.any():
            raise SurfaceError(
                f"{place}: {column} = {values[wrong][0]:g} in row {np.argmax(wrong) + 1}: harmonic "
                "tables are of elliptical contacts, M and L above 0, D of 0.005 to 1"
            )
    for column, low in least.items():
        values = raw[column].to_numpy(float)
        if (values < low).any():
            raise SurfaceError(
                f"{place}: {column} = {values[values < low][0]:g} in row "
                f"{np.argmax(values < low) + 1} must not be negative"
            )
