"""Result of a fit: parameters with intervals, and what the data do not determine."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlwave.identify.measurements import Measurements
from ehlwave.identify.model import Model
from ehlwave.inputs.key_table import KEYS

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


def result_of(
    data: Measurements,
    names: list[str],
    reference: float | None,
    found: Any,  # noqa: ANN401
    fitted: NDArray[np.float64],
    weights: NDArray[np.float64],
    error: float | None,
    model: Model,
) -> Identified:
    """Return parameters, intervals and notes of a least-squares solution."""
    from scipy.stats import norm, t

    free = len(data) - len(names)
    is_given = error is not None or bool(np.isfinite(data.error).any())
    chi = float(np.sum(found.fun**2))
    noise = 1.0 if is_given else np.sqrt(chi / free) if free else np.nan
    _, sizes, directions = np.linalg.svd(found.jac, full_matrices=False)
    weak = ~(sizes > SINGULAR * sizes[0])  # all, if nothing depends on the parameters
    spread = np.where(weak, 1e6, 1 / np.where(weak, 1.0, sizes))
    covariance = (directions.T * spread**2) @ directions
    correlation = covariance / np.sqrt(np.outer(np.diag(covariance), np.diag(covariance)))
    errors = noise * np.sqrt(np.diag(covariance))
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
