"""Parts of points that are left out of a fit in turn, whole operating conditions at a time."""

import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]

FOLDS = 12
SEED = 20000


def grouped_folds(condition: NDArray[np.intp], count: int = FOLDS, seed: int = SEED) -> list[Mask]:
    """Return the test sets of ``count`` folds; a condition is in one of them with all its points.

    Raises
    ------
    ValueError
        If there are fewer conditions than folds.
    """
    labels = np.unique(condition)
    if labels.size < count:
        raise ValueError(f"{labels.size} operating conditions for {count} folds")
    shuffled = np.random.default_rng(seed).permutation(labels)
    return [np.isin(condition, shuffled[first::count]) for first in range(count)]
