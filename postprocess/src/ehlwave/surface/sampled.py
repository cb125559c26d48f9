"""Transfer of the waves of large maps: polynomials where it is smooth, as for short waves."""

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial.chebyshev import chebpts1, chebvander
from numpy.typing import NDArray

from ehlwave.laws.transfer import Transfer, Waves

NODES = 16
"""Chebyshev points of each octave: heights change by less than single precision rounds them."""


class Sampled(Transfer):
    """A transfer that is evaluated at Chebyshev points of each octave of waves along y.

    Octaves begin at `Transfer.smooth_from`. Longer waves are evaluated one by one.
    """

    def __init__(self, transfer: Transfer, across: Waves) -> None:
        """Take all waves per metre along y, ascending from 0 beyond `Transfer.smooth_from`."""
        self._of, self._from = transfer, transfer.smooth_from
        octaves = int(np.ceil(np.log2(across[-1] / self._from)))
        inner = np.searchsorted(across, self._from * 2.0 ** np.arange(octaves))
        edges = np.unique([0, *inner, across.size])
        self._octaves = [slice(*ends) for ends in pairwise(edges.tolist())]
        pairs = [_polynomials(across[one]) for one in self._octaves]
        self._weights = [weights for _, weights in pairs]
        points = [nodes for nodes, _ in pairs]
        self._smooth = np.concatenate(points)[None, :]
        self._mixed = np.concatenate([across[self._octaves[0]], *points[1:]])[None, :]

    @property
    def name(self) -> str:
        """Return its description."""
        return self._of.name

    @property
    def covers_all(self) -> bool:
        """Whether every component shorter than the contact is covered."""
        return self._of.covers_all

    @property
    def outside_reason(self) -> str:
        """Why a component shorter than the contact is not covered."""
        return self._of.outside_reason

    def ratio(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[Any]:
        """Return the transfer of rows of waves along x."""
        found = self._of.ratio(per_length_x, self._asked(per_length_x))
        if not np.iscomplexobj(found):
            return self._spread(found)
        ratio = np.empty((found.shape[0], per_length_y.size), found.dtype)
        ratio.real, ratio.imag = self._spread(found.real), self._spread(found.imag)
        return ratio

    def error(self, per_length_x: Waves, per_length_y: Waves) -> Waves | None:
        """Return the absolute error of the transfer; None if that is not known."""
        found = self._of.error(per_length_x, self._asked(per_length_x))
        return None if found is None else self._spread(found)

    def rise(self, per_length_x: Waves, per_length_y: Waves) -> Waves | None:
        """Return the rise of the mean film by waves, to second order; None if unknown."""
        found = self._of.rise(per_length_x, self._asked(per_length_x))
        return None if found is None else self._spread(found)

    def is_covered(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.bool_]:
        """Return whether the transfer is known there rather than continued."""
        return self._spread(self._of.is_covered(per_length_x, self._asked(per_length_x)))

    def _asked(self, along: Waves) -> Waves:
        """Return the waves along y that are evaluated in rows."""
        return self._mixed if np.abs(along).min() < self._from else self._smooth

    def _spread(self, found: NDArray[Any]) -> NDArray[Any]:
        """Return values of all waves from evaluated ones; coverage is equal in an octave."""
        values, end = np.empty((len(found), self._octaves[-1].stop), found.dtype), found.shape[1]
        for octave, weights in zip(self._octaves[::-1], self._weights[::-1], strict=True):
            start = end - len(weights) if octave.start else 0
            own, end = found[:, start:end], start
            if own.shape[1] == octave.stop - octave.start:
                values[:, octave] = own
            elif found.dtype == bool:
                values[:, octave] = own[:, :1]
            else:
                np.matmul(own, weights, out=values[:, octave])
        return values


def _polynomials(q: Waves) -> tuple[Waves, Waves]:
    """Return Chebyshev points of an octave, and weights of their values at its waves."""
    if q.size <= NODES:
        return q, np.eye(q.size)
    middle, half = (q[0] + q[-1]) / 2, (q[-1] - q[0]) / 2
    points = chebpts1(NODES)
    at_points, at_waves = (chebvander(x, NODES - 1) for x in (points, (q - middle) / half))
    at_points[:, 1:] *= 2
    return middle + half * points, at_points @ at_waves.T / NODES
