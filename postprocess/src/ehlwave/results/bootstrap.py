"""Intervals of the coefficients of eq. (18), by fits to drawn operating conditions."""

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.formula import PAPER_C1, PAPER_C2, amplitude_ratio_formula
from ehlwave.results.fit import MINIMUM_POINTS, NO_INTERVAL, FitError, Interval, has_no_pole

Floats = NDArray[np.float64]

MINIMUM_CONDITIONS = 3


def bootstrap_coefficients(
    x: ArrayLike,
    ratio: ArrayLike,
    condition: ArrayLike,
    replicates: int,
    seed: int,
    weight: ArrayLike | None = None,
) -> Floats:
    """Refit samples of whole operating conditions, drawn with replacement.

    Points at an operating condition share its errors (grid, film thickness), so samples are drawn
    from conditions, not from points.

    Parameters
    ----------
    x, ratio : array_like, shape (n,)
        As for :func:`ehlwave.fit_formula`.
    condition : array_like of int, shape (n,)
        Number of the operating condition of each point.
    replicates : int
        Number of samples.
    seed : int
        Seed of the random numbers: equal seeds give equal answers.
    weight : array_like, shape (n,), optional
        As for :func:`ehlwave.fit_formula`.

    Returns
    -------
    ndarray, shape (m, 2)
        c1 and c2 of the m <= replicates samples that determine them.

    Raises
    ------
    FitError
        With fewer than three operating conditions.

    Examples
    --------
    >>> import numpy as np
    >>> import ehlwave
    >>> x = np.array([0.5, 1, 2, 5, 10])
    >>> ratio = np.array([0.90, 0.80, 0.63, 0.33, 0.16])
    >>> found = ehlwave.bootstrap_coefficients(np.tile(x, 3), np.tile(ratio, 3),
    ...     condition=np.repeat([0, 1, 2], 5), replicates=20, seed=1)
    >>> found.shape
    (20, 2)
    """
    abscissa, measured = np.asarray(x, dtype=float), np.asarray(ratio, dtype=float)
    weights = np.ones(abscissa.size) if weight is None else np.asarray(weight, dtype=float)
    members = [np.flatnonzero(condition == label) for label in np.unique(condition)]
    if len(members) < MINIMUM_CONDITIONS:
        raise FitError(
            f"no bootstrap ({len(members)} operating condition(s); {MINIMUM_CONDITIONS} needed)"
        )
    random = np.random.default_rng(seed)
    coefficients = []
    for _ in range(replicates):
        labels = random.integers(len(members), size=len(members))
        drawn = np.concatenate([members[label] for label in labels])
        solution = _solve(abscissa[drawn], measured[drawn], weights[drawn])
        if solution is not None:
            coefficients.append(solution)
    return np.array(coefficients, dtype=float).reshape(-1, 2)


def percentile_intervals(coefficients: Floats, confidence: float = 0.95) -> tuple[Interval, ...]:
    """Return the central interval of each column of bootstrap coefficients; NaN without rows.

    Parameters
    ----------
    coefficients : ndarray, shape (m, k)
        From :func:`bootstrap_coefficients`.
    confidence : float
        Probability content of the intervals.

    Examples
    --------
    >>> import numpy as np
    >>> import ehlwave
    >>> coefficients = np.column_stack([np.linspace(0.1, 0.2, 101), np.linspace(0.01, 0.02, 101)])
    >>> for low, high in ehlwave.percentile_intervals(coefficients, confidence=0.9):
    ...     print(f"{low:.4f} {high:.4f}")
    0.1050 0.1950
    0.0105 0.0195
    """
    if not len(coefficients):
        return (NO_INTERVAL,) * coefficients.shape[1]
    tail = (1 - confidence) / 2
    low, high = np.quantile(coefficients, [tail, 1 - tail], axis=0)
    return tuple((float(a), float(b)) for a, b in zip(low, high, strict=True))


def _solve(x: Floats, ratio: Floats, weight: Floats) -> Floats | None:
    """Return the least-squares c1 and c2, or None where the points do not determine them."""
    if np.unique(x).size < MINIMUM_POINTS - 1:
        return None

    def residual(c: Floats) -> Floats:
        return weight * (amplitude_ratio_formula(x, c[0], c[1]) - ratio)

    def jacobian(c: Floats) -> Floats:
        slope = -weight * amplitude_ratio_formula(x, c[0], c[1]) ** 2
        return np.stack([slope * x, slope * x**2])

    solution, ierr = scipy.optimize.leastsq(
        residual, (PAPER_C1, PAPER_C2), Dfun=jacobian, col_deriv=True
    )
    good = ierr in (1, 2, 3, 4) and np.isfinite(solution).all() and has_no_pole(x, *solution)
    return solution if good else None
