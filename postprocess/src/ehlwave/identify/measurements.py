"""Tables of rigs: measured results over the conditions that vary."""

import re
import warnings
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Mapping
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from ehlwave.errors import ArgumentError, did_you_mean
from ehlwave.identify.headings import rig_heading
from ehlwave.inputs.key_table import KEYS
from ehlwave.quantities import ZERO_CELSIUS_K

RESULTS = {
    "central_film_m": "central film, m",
    "minimum_film_m": "smallest film, m",
    "friction_coefficient": "friction coefficient",
    "harmonic_ratio": "Ad/Ai",
}
"""Measured results in SI units, and their labels."""

UNITS = {"_um": 1e-6, "_nm": 1e-9}
_LENGTHS = {
    name.removesuffix("_m") + ending: (name, factor)
    for name in RESULTS
    if name.endswith("_m")
    for ending, factor in UNITS.items()
}
_OTHER = {"mean_speed_mm_per_s": ("mean_speed_m_per_s", 1e-3)}
TEMPERATURE, CELSIUS = "temperature_k", "temperature_c"
_MOST = dict(zip(RESULTS, (1e-4, 1e-4, 1.0, 2.0), strict=True))
"""Largest plausible results."""
_MARKS = (",", ";", "\t", "|")
"""Separators of columns. Semicolons leave the comma to numbers."""
ERROR = "_error"
"""Ending of a column of relative standard errors."""


@dataclass(frozen=True)
class Measurements:
    """Measured results, one a row.

    Attributes
    ----------
    conditions : list of dict
        Keys that vary, of each row.
    result : list of str
        Name of the result of each row, a key of `RESULTS`.
    value, error : ndarray
        Measured values in SI units, and relative standard errors; NaN: not known.
    """

    conditions: list[dict[str, float]]
    result: list[str]
    value: NDArray[np.float64]
    error: NDArray[np.float64]

    def __len__(self) -> int:
        """Return the number of values."""
        return len(self.value)


def read_measurements(source: "str | Path | pd.DataFrame") -> Measurements:
    """Read a table whose columns are keys that vary and measured results.

    Parameters
    ----------
    source : path or DataFrame
        CSV with headings. Keys of input files, such as ``mean_speed_m_per_s``, ``load_n``,
        ``slide_to_roll_ratio`` and ``wavelength_over_a``, or ``temperature_c``; results
        ``central_film_um``, ``minimum_film_um`` (or ``_nm``, ``_m``), ``friction_coefficient``
        and ``harmonic_ratio`` (Ad/Ai); relative standard errors as ``central_film_error``.
        Headings of rigs are words with a unit: ``Entrainment speed (mm/s)``, ``SRR (%)``,
        ``Load (N)``, ``Temperature (°C)``, ``Film thickness (nm)``, ``Traction coefficient``.
        Empty cells of results are left out; empty cells of keys take the value of the conditions.

    Raises
    ------
    ArgumentError
        If a column is not known, or a value is no number above 0.

    Examples
    --------
    >>> import pandas as pd
    >>> from ehlwave.identify import read_measurements
    >>> rig = pd.DataFrame({"mean_speed_m_per_s": [0.1, 1], "central_film_nm": [60, 280]})
    >>> read_measurements(rig).value
    array([6.0e-08, 2.8e-07])
    """
    table, place = _table_of(source)
    columns = _known_columns(table, place)
    results = [name for name in columns if name in RESULTS]
    if not results:
        known = ", ".join((*RESULTS, *_LENGTHS))
        raise ArgumentError(f"{place}: no measured result: give one of the columns {known}")
    conditions: list[dict[str, float]] = []
    names: list[str] = []
    values: list[float] = []
    errors: list[float] = []
    keys = [name for name in columns if name in KEYS]
    for row in range(len(table)):
        given = {key: columns[key][row] for key in keys if np.isfinite(columns[key][row])}
        for name in results:
            value = columns[name][row]
            if not np.isfinite(value):
                continue
            if not 0 < value <= _MOST[name]:
                raise ArgumentError(
                    f"{place}, row {row + 1}: {name} = {value:g} must be above 0 and at most "
                    f"{_MOST[name]:g}: check its unit"
                )
            conditions.append(given)
            names.append(name)
            values.append(value)
            error = columns.get(name.removesuffix("_m") + ERROR)
            errors.append(np.nan if error is None else error[row])
    if not values:
        raise ArgumentError(f"{place}: no measured value in the columns {', '.join(results)}")
    return Measurements(conditions, names, np.array(values), np.array(errors))


def _table_of(source: "str | Path | pd.DataFrame") -> tuple[pd.DataFrame, str]:
    if isinstance(source, pd.DataFrame):
        return source, "measurements"
    if not Path(source).is_file():
        raise ArgumentError(f"{source}: no such file: give a CSV table of measurements")
    try:
        lines = _decoded(Path(source).read_bytes()).splitlines()
        head = next((line for line in lines if line.strip() and line[0] != "#"), "")
        mark = max(_MARKS, key=head.count)
        if mark not in head and not re.search(r"[\[(]", head):  # words of rigs have spaces
            mark = r"\s+"
        decimal = "," if mark == ";" else "."
        with warnings.catch_warnings():
            warnings.simplefilter("error", pd.errors.ParserWarning)  # cells without a heading
            text = StringIO("\n".join(lines))
            table = pd.read_csv(text, sep=mark, comment="#", decimal=decimal, index_col=False)
    except pd.errors.ParserWarning:
        raise ArgumentError(f"{source}: a row has more cells than the heading") from None
    except ValueError as error:
        raise ArgumentError(f"{source}: not a CSV table: {error}") from error
    return table.rename(columns=lambda name: str(name).strip()), str(source)


def _known_columns(table: pd.DataFrame, place: str) -> Mapping[str, NDArray[np.float64]]:
    """Return the columns in SI units by the names of keys and results."""
    known = {}
    errors = [name.removesuffix("_m") + ERROR for name in RESULTS]
    words = [key for key, entry in KEYS.items() if entry.kind == "number"]
    words += [*RESULTS, *_LENGTHS, *_OTHER, *errors, CELSIUS]
    for heading in table.columns:
        name, factor, offset = heading, 1.0, 0.0
        if heading in _LENGTHS or heading in _OTHER:
            name, factor = (_LENGTHS | _OTHER)[heading]
        elif heading == CELSIUS:
            name, offset = TEMPERATURE, ZERO_CELSIUS_K
        elif heading not in words and (own := rig_heading(heading, place)):
            name, factor, offset = own
        elif heading not in words:
            raise ArgumentError(
                f"{place}: column {heading} is no key and no measured result"
                f"{did_you_mean(heading, words)}; results are central_film_um, minimum_film_um, "
                "friction_coefficient and harmonic_ratio"
            )
        if name in known:
            raise ArgumentError(f"{place}: two columns of {name}: leave one")
        values: Any = pd.to_numeric(table[heading], errors="coerce")
        if (values.isna() & table[heading].notna()).any() or np.isinf(values).any():
            raise ArgumentError(f"{place}: column {heading} has cells that are no numbers")
        known[name] = factor * values.to_numpy(dtype=float) + offset
        if name == TEMPERATURE and (known[name] <= 0).any():
            raise ArgumentError(f"{place}: column {heading} has temperatures below absolute zero")
    return known


def _decoded(content: bytes) -> str:
    """Return the text of a file: in UTF-8 or UTF-16, else as Windows programs write it."""
    if content[:2] in (BOM_UTF16_LE, BOM_UTF16_BE):
        return content.decode("utf-16")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252", errors="replace")
