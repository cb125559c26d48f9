"""Fit the coefficients of the amplitude reduction formula, eq. (18)."""

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.formula import PAPER_C1, PAPER_C2, amplitude_ratio_formula
from ehlwave.errors import EhlwaveError
from ehlwave.extras import load

if TYPE_CHECKING:
    import lmfit

Floats = NDArray[np.float64]
Interval = tuple[float, float]

MINIMUM_POINTS = 4
NO_INTERVAL: Interval = (float("nan"), float("nan"))
_TOLERANCE = 1e-12


class FitError(EhlwaveError):
    """The points do not determine the coefficients; the message has the reason.

    Examples
    --------
    >>> import ehlwave
    >>> try:
    ...     ehlwave.fit_formula([1, 2], [0.8, 0.6])
    ... except ehlwave.FitError as error:
    ...     print(error)
    too few points (2; at least 4 needed)
    """


@dataclass(frozen=True)
class FormulaFit:
    """Coefficients of Ad/Ai = 1 / (1 + c1 x + c2 x^2), eq. (18), all dimensionless.

    Parameters
    ----------
    c1, c2 : float
        The coefficients.
    c1_interval, c2_interval : pair of float
        From the profile of the sum of squares (lmfit), which takes the errors of all points as
        independent; NaN where it is not defined.
    rms : float
        Root of the mean squared residual.

    Examples
    --------
    >>> import numpy as np
    >>> import ehlwave
    >>> x = np.array([0.5, 1, 2, 5, 10])
    >>> ratio = np.array([0.90, 0.80, 0.63, 0.33, 0.16])
    >>> fit = ehlwave.fit_formula(x, ratio)
    >>> print(f"c1 = {fit.c1:.2f}, c2 = {fit.c2:.3f}, rms = {fit.rms:.3f}")
    c1 = 0.22, c2 = 0.035, rms = 0.006
    """

    c1: float
    c2: float
    c1_interval: Interval
    c2_interval: Interval
    rms: float


def fit_formula(
    x: ArrayLike, ratio: ArrayLike, confidence: float = 0.95, weight: ArrayLike | None = None
) -> FormulaFit:
    """Fit c1 and c2 of eq. (18) by least squares.

    Parameters
    ----------
    x : array_like, shape (n,)
        f(r) V or f(r) V2.
    ratio : array_like, shape (n,)
        Ad/Ai.
    confidence : float
        Probability content of the intervals.
    weight : array_like, shape (n,), optional
        Of each residual, see :func:`point_weights`; 1 by default.

    Raises
    ------
    FitError
        With fewer than four points or three different x, or if the best curve has a pole among the
        points.

    Examples
    --------
    >>> import numpy as np
    >>> import ehlwave
    >>> x = np.array([0.5, 1, 2, 5, 10])
    >>> ratio = np.array([0.90, 0.80, 0.63, 0.33, 0.16])
    >>> fit = ehlwave.fit_formula(x, ratio)
    >>> low, high = fit.c1_interval
    >>> print(f"c1 = {fit.c1:.2f}, between {low:.2f} and {high:.2f}")
    c1 = 0.22, between 0.19 and 0.25
    """
    minimizer, result, (c1, c2) = _best(x, ratio, weight)
    intervals = _profile_intervals(minimizer, result, confidence)
    return FormulaFit(c1, c2, *intervals, rms=rms_residual(x, ratio, c1, c2))


def point_weights(x: ArrayLike, ratio: ArrayLike, error: ArrayLike) -> Floats:
    """Return weights of residuals, 1 for a point without error: s / sqrt(s^2 + error^2).

    s, the scatter of the points about a single curve, is the rms residual of the unweighted fit:
    points follow eq. (18) no better than that, however small their own errors are.

    Parameters
    ----------
    x, ratio : array_like, shape (n,)
        As for :func:`fit_formula`.
    error : array_like, shape (n,)
        Error of each ratio; NaN, not known, counts as 0.

    Raises
    ------
    FitError
        As :func:`fit_formula`.

    Examples
    --------
    >>> import numpy as np
    >>> import ehlwave
    >>> x = np.array([0.5, 1, 2, 5, 10])
    >>> ratio = np.array([0.90, 0.80, 0.63, 0.33, 0.16])
    >>> weight = ehlwave.point_weights(x, ratio, error=[0, 0, 0, 0, 0.1])
    >>> weight.round(2).tolist()
    [1.0, 1.0, 1.0, 1.0, 0.06]
    """
    errors = np.nan_to_num(np.asarray(error, dtype=float), nan=0.0)
    scatter = rms_residual(x, ratio, *_best(x, ratio)[2])
    total = np.hypot(scatter, errors)
    return np.divide(scatter, total, out=np.ones_like(errors), where=(errors > 0) & (scatter > 0))


def rms_residual(
    x: ArrayLike, ratio: ArrayLike, c1: float = PAPER_C1, c2: float = PAPER_C2
) -> float:
    """Return the root mean square of eq. (18) minus ``ratio``; NaN without points.

    Parameters
    ----------
    x, ratio : array_like, shape (n,)
        As for :func:`fit_formula`.
    c1, c2 : float
        Coefficients; the paper's by default.

    Examples
    --------
    >>> import numpy as np
    >>> import ehlwave
    >>> x = np.array([0.5, 1, 2, 5, 10])
    >>> ratio = np.array([0.90, 0.80, 0.63, 0.33, 0.16])
    >>> print(f"{ehlwave.rms_residual(x, ratio):.3f}")
    0.093
    """
    residual = amplitude_ratio_formula(x, c1, c2) - np.asarray(ratio, dtype=float)
    return float(np.sqrt(np.mean(residual**2))) if residual.size else float("nan")


def _best(
    x: ArrayLike, ratio: ArrayLike, weight: ArrayLike | None = None
) -> tuple["lmfit.Minimizer", "lmfit.minimizer.MinimizerResult", tuple[float, float]]:
    """Return the fit of :func:`fit_formula` without intervals: its problem, solution, c1 and c2."""
    abscissa, measured = np.asarray(x, dtype=float), np.asarray(ratio, dtype=float)
    weights = np.ones(abscissa.size) if weight is None else np.asarray(weight, dtype=float)
    if abscissa.size < MINIMUM_POINTS or np.unique(abscissa).size < MINIMUM_POINTS - 1:
        raise FitError(f"too few points ({abscissa.size}; at least {MINIMUM_POINTS} needed)")

    def residual(parameters: "lmfit.Parameters") -> Floats:
        values = parameters.valuesdict()
        curve = amplitude_ratio_formula(abscissa, values["c1"], values["c2"])
        return weights * (curve - measured)

    lmfit = load("lmfit")
    parameters = lmfit.create_params(c1=PAPER_C1, c2=PAPER_C2)
    minimizer = lmfit.Minimizer(residual, parameters)
    result = minimizer.leastsq(xtol=_TOLERANCE, ftol=_TOLERANCE)
    c1, c2 = (float(result.params[name].value) for name in ("c1", "c2"))
    if not (np.isfinite([c1, c2]).all() and has_no_pole(abscissa, c1, c2)):
        raise FitError("the fit did not converge to a curve without poles")
    return minimizer, result, (c1, c2)


def has_no_pole(x: Floats, c1: float, c2: float) -> bool:
    """Return whether the curve is finite and above 0 at all points."""
    return bool(np.all(1 + x * (c1 + x * c2) > 0))


def _profile_intervals(
    minimizer: "lmfit.Minimizer", result: "lmfit.minimizer.MinimizerResult", confidence: float
) -> tuple[Interval, Interval]:
    """Return lmfit's confidence intervals of c1 and c2; NaN where lmfit finds none."""
    lmfit = load("lmfit")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", module=r"uncertainties\b")  # of lmfit below 1.3.4
            found = lmfit.conf_interval(minimizer, result, sigmas=[confidence])
    except (lmfit.MinimizerException, ValueError, ArithmeticError, Warning):
        return NO_INTERVAL, NO_INTERVAL
    c1, c2 = ((found[name][0][1], found[name][-1][1]) for name in ("c1", "c2"))
    return (float(c1[0]), float(c1[1])), (float(c2[0]), float(c2[1]))
