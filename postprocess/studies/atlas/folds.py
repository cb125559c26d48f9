"""Which contacts are left out together, and what comes of it."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

FOLDS = 8


def folds(contacts: int) -> NDArray[np.intp]:
    """Return the fold of each contact."""
    return np.random.default_rng(11).permutation(contacts) % FOLDS


def quantiles(misfit: Floats) -> dict[str, float]:
    """Return median, 95th percentile and largest of some errors."""
    return {
        name: float(f"{np.quantile(misfit, share):.3g}")
        for name, share in (("median", 0.5), ("95 %", 0.95), ("all", 1))
    }
