"""Least squares: the parameters of an oil that measured values imply, with their uncertainty."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ehlwave.errors import ArgumentError, RangeError
from ehlwave.identify.measurements import TEMPERATURE, Measurements, read_measurements
from ehlwave.identify.model import DECAY, VISCOSITY, Model, check_parameter
from ehlwave.inputs.key_table import KEYS
from ehlwave.inputs.slip import merged
from ehlwave.traction.given import read_keys

if TYPE_CHECKING:
    import pandas as pd

PARAMETERS = {
    "alpha": "pressure_viscosity_per_pa",
    "viscosity": VISCOSITY,
    "eyring_stress": "eyring_stress_pa",
    "carreau_modulus": "carreau_modulus_pa",
    "viscosity_temperature": DECAY,
    "roelands": "roelands_index",
    "modulus": "reduced_modulus_pa",
}
"""Short names of parameters."""

FIRST = {
    "pressure_viscosity_per_pa": 2e-8,
    "eyring_stress_pa": 5e6,
    "roelands_index": 0.68,
    DECAY: 0.04,
}
"""Values from which a fit begins where the conditions have none."""

CONFIDENCE = 0.95
LOOSE = 0.5
"""Standard error of ln(parameter) above which data do not determine it."""
ALIKE = 0.995
"""Correlation of two parameters above which the data determine only one combination of them."""
POOR = 0.1
"""Standard error of ln(parameter) up to which correlated parameters are determined all the same."""
SINGULAR = 1e-6
"""Smallest singular value over the largest."""


@dataclass(frozen=True)
class Parameter:
    """A fitted parameter.

    Attributes
    ----------
    name, unit : str
        Key and unit.
    value, low, high : float
        Best value, and the ends of its 95 % interval.
    error : float
        Relative standard error, of the logarithm.
    is_identified : bool
        Whether the data determine it.
    """

    name: str
    unit: str
    value: float
    error: float
    low: float
    high: float
    is_identified: bool


@dataclass(frozen=True)
class Identified:
    """Result of a fit.

    Attributes
    ----------
    parameters : list of Parameter
        Fitted parameters.
    correlation : ndarray
        Of their logarithms.
    fitted : ndarray
        Results with the fitted parameters.
    residual : ndarray
        Measured over fitted values, less 1.
    rms : float
        Root mean square of the residuals.
    noise : float
        Relative standard error of the measurements: given, or by the residuals.
    notes : list of str
        What the data do not determine.
    sources : list of str
        Where results are from: laws, the program.
    """

    measurements: Measurements
    parameters: list[Parameter]
    correlation: NDArray[np.float64]
    fitted: NDArray[np.float64]
    residual: NDArray[np.float64]
    rms: float
    noise: float
    reference_k: float | None = None
    notes: list[str] = field(default_factory=list)
    sources: list[str] = field(default_factory=list)


def identify(
    measurements: "Measurements | str | Path | pd.DataFrame",
    conditions: "dict[str, Any] | str | Path",
    fit: Sequence[str],
    error: float | None = None,
    by: str | None = None,
) -> Identified:
    """Fit parameters of a contact to measured films, frictions or amplitude ratios.

    Least squares of ln(measured/computed) over the standard errors, with derivatives from the laws
    or from ``ehlwave-case``.

    Parameters
    ----------
    measurements : Measurements, path or DataFrame
        See :func:`read_measurements`.
    conditions : dict or path
        Keys of the contact, or an input file of ``ehlwave-case``; the fit begins there.
    fit : sequence of str
        ``"alpha"``, ``"viscosity"``, ``"eyring_stress"``, ``"viscosity_temperature"`` or other
        keys with a number. Where temperatures vary, the viscosity is that at ``temperature_k`` of
        the conditions, and falls as exp(-viscosity_temperature (T - T0)).
    error : float, optional
        Relative standard error of values without a column of their own; absent: by the residuals.
    by : {"laws", "computed"}, optional
        As of :meth:`ehlwave.Contact.film`.

    Raises
    ------
    ArgumentError
        If something is missing, or there are fewer values than parameters.

    Examples
    --------
    >>> import pandas as pd
    >>> from ehlwave.identify import identify
    >>> rig = pd.DataFrame({"mean_speed_m_per_s": [0.5, 1, 2],
    ...     "central_film_um": [0.213, 0.338, 0.535]})
    >>> ball = {"radius_x_m": 0.0127, "radius_y_m": 0.0127, "reduced_modulus_pa": 2.26e11,
    ...     "load_n": 40, "viscosity_pa_s": 0.05}
    >>> found = identify(rig, ball, ["alpha"], by="laws")
    >>> [parameter.name for parameter in found.parameters]
    ['pressure_viscosity_per_pa']
    """
    from scipy.optimize import least_squares

    data = measurements
    if not isinstance(data, Measurements):
        data = read_measurements(data)
    keys = dict(conditions) if isinstance(conditions, dict) else read_keys(conditions)
    names = [check_parameter(word, PARAMETERS) for word in fit]
    _check(data, names)
    start, reference = _start(keys, names, data)
    rows = [merged({**keys, **start}, row) for row in data.conditions]
    if clash := [name for name in names if any(name in row for row in data.conditions)]:
        raise ArgumentError(f"--fit {clash[0]}: the measurements have a column of it")
    model = Model(rows, data.result, names, reference, by)
    weights = 1 / _errors(data, error)
    measured = np.log(data.value)
    known: dict[bytes, Any] = {}

    def at(values: NDArray[np.float64]) -> Any:  # noqa: ANN401
        if values.tobytes() not in known:
            known[values.tobytes()] = model(values)
        return known[values.tobytes()]

    first = np.log([start[name] for name in names])
    try:
        found = least_squares(
            lambda x: weights * (at(x)[0] - measured),
            first,
            jac=lambda x: weights[:, None] * at(x)[1],
            bounds=_bounds(names, first),
            x_scale=1.0,
            xtol=1e-8,
            ftol=1e-10,
            gtol=1e-10,
        )
    except RangeError as problem:
        raise ArgumentError(f"no law holds for all measurements: {problem}") from problem
    return _result(data, names, reference, found, at(found.x)[0], weights, error, model)


def _check(data: Measurements, names: list[str]) -> None:
    if len(set(names)) < len(names):
        raise ArgumentError(f"--fit {' '.join(names)}: a parameter is named twice")
    if len(data) < len(names):
        raise ArgumentError(
            f"{len(data)} measured values do not determine {len(names)} parameters: fit fewer"
        )


def _start(
    keys: dict[str, Any], names: list[str], data: Measurements
) -> tuple[dict[str, float], float | None]:
    """Return first values of the parameters, and the temperature of the viscosity."""
    start = {}
    for name in names:
        value = keys.get(name, FIRST.get(name))
        if value is None:
            raise ArgumentError(
                f"--fit {name}: the conditions have no {name}: give a value near it, where the fit "
                "begins"
            )
        start[name] = float(value)
    varying = [row[TEMPERATURE] for row in data.conditions if TEMPERATURE in row]
    if not varying:
        return start, None
    if DECAY not in names and DECAY not in keys and max(varying) > min(varying):
        raise ArgumentError(
            "the measurements have several temperatures: add viscosity_temperature to --fit, or "
            f"give {DECAY} in the conditions"
        )
    return start, float(keys.get(TEMPERATURE, np.mean(varying)))


def _errors(data: Measurements, error: float | None) -> NDArray[np.float64]:
    if error is not None and not 0 < error < 1:
        raise ArgumentError(f"error = {error:g}: give a relative standard error between 0 and 1")
    given = np.where(np.isfinite(data.error), data.error, 1.0 if error is None else error)
    if not (given > 0).all():
        raise ArgumentError("a column of errors has values that are not above 0")
    if np.isfinite(data.error).any() and not np.isfinite(data.error).all() and error is None:
        raise ArgumentError("some values have no error: give error, or fill the column")
    return given


def _bounds(names: list[str], first: NDArray[np.float64]) -> tuple[list[float], list[float]]:
    """Return the bounds of the keys, and at most a factor of 30 from the first value."""
    low, high = [], []
    for name, value in zip(names, first, strict=True):
        key = KEYS[name]
        least = max(getattr(key, "minimum", None) or 0.0, getattr(key, "above", None) or 0.0)
        most = getattr(key, "maximum", None) or np.inf
        low.append(max(np.log(least) if least > 0 else -np.inf, value - np.log(30)))
        high.append(min(np.log(most), value + np.log(30)))
    return low, high


def _result(
    data: Measurements,
    names: list[str],
    reference: float | None,
    found: Any,  # noqa: ANN401
    fitted: NDArray[np.float64],
    weights: NDArray[np.float64],
    error: float | None,
    model: Model,
) -> Identified:
    from scipy.stats import norm, t

    free = len(data) - len(names)
    is_given = error is not None or bool(np.isfinite(data.error).any())
    chi = float(np.sum(found.fun**2))
    noise = 1.0 if is_given else np.sqrt(chi / free) if free else np.nan
    _, sizes, directions = np.linalg.svd(found.jac, full_matrices=False)
    weak = sizes < SINGULAR * sizes[0]
    spread = np.where(weak, 1e6, 1 / np.where(weak, 1.0, sizes))
    covariance = (directions.T * spread**2) @ directions * noise**2
    errors = np.sqrt(np.diag(covariance))
    correlation = covariance / np.outer(errors, errors)
    quantile = 0.5 + CONFIDENCE / 2
    times = norm.ppf(quantile) if is_given else t.ppf(quantile, free) if free else np.nan
    hits = np.array(found.active_mask) != 0
    notes, alike = _notes(names, errors, correlation, hits)
    if not free and not is_given:
        notes.append(
            "as many values as parameters: give error, without which intervals are unknown"
        )
    parameters = [
        Parameter(
            name=name,
            unit=KEYS[name].unit or "1",
            value=float(np.exp(x)),
            error=float(one),
            low=float(np.exp(x - times * one)) if one < 50 else 0.0,
            high=float(np.exp(x + times * one)) if one < 50 else float("inf"),
            is_identified=bool(one <= LOOSE and not hit and name not in alike),
        )
        for name, x, one, hit in zip(names, found.x, errors, hits, strict=True)
    ]
    residual = data.value / np.exp(fitted) - 1
    return Identified(
        data,
        parameters,
        correlation,
        np.exp(fitted),
        residual,
        float(np.sqrt(np.mean(residual**2))),
        float(1 / np.mean(weights)) if is_given else float(noise),
        reference,
        notes,
        sorted(model.sources),
    )


def _notes(
    names: list[str],
    errors: NDArray[np.float64],
    correlation: NDArray[np.float64],
    hits: NDArray[np.bool_],
) -> tuple[list[str], set[str]]:
    """Return what the data do not determine, and parameters that they cannot tell apart."""
    notes, alike = [], set()
    for i, name in enumerate(names):
        if hits[i]:
            notes.append(f"{name} ended at a bound: the data do not determine it")
        elif errors[i] > LOOSE:
            notes.append(f"{name} is not identified: its standard error is {_percent(errors[i])}")
        for j in range(i):
            if abs(correlation[i, j]) > ALIKE and max(errors[i], errors[j]) > POOR:
                alike |= {name, names[j]}
    if alike:
        chosen = [i for i, name in enumerate(names) if name in alike]
        part = np.ix_(chosen, chosen)
        loose = np.linalg.eigh(correlation[part] * np.outer(errors, errors)[part])[1][:, -1]
        loose /= loose[np.abs(loose).argmax()]
        along = ", ".join(f"{names[i]}^{power:.2g}" for i, power in zip(chosen, loose, strict=True))
        notes.append(
            f"{' and '.join(names[i] for i in chosen)} cannot be told apart: these data hardly "
            f"change as the parameters change as {along}; measure one of them, or other results "
            "(friction, other loads)"
        )
    return notes, alike


def _percent(error: float) -> str:
    return f"{100 * error:.0f} %" if error < 10 else "unbounded"
