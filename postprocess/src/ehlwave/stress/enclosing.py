"""Smallest balls about many sets of points at once.

Fischer, Gaertner and Kutz (2003), *Fast smallest-enclosing-ball computation in high dimensions*:
the ball shrinks towards the flat through its support until another point stops it, which joins the
support; where the centre is reached, a point on the wrong side leaves it. It holds all points at
every step.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

MOST_STEPS = 80
"""Points on one sphere can be exchanged for ever; the ball is right then."""

ROUNDING = 1e-10
"""Rounding of the radius, of the size of a step, and of the weight of a point."""


class Ball(NamedTuple):
    """Centres, shape (sets, dimensions), and radii, shape (sets,)."""

    centre: Floats
    radius: Floats


def enclosing_balls(points: Floats) -> Ball:
    """Return the smallest ball about each set of points, shape (sets, points, dimensions)."""
    sets, count, dimensions = points.shape
    centre = points.mean(axis=1)
    far = np.argmax(_squares(points - centre[:, None]), axis=1)
    radius = np.sqrt(_squares(points[np.arange(sets), far] - centre))
    support = np.full((sets, dimensions + 1), -1)
    support[:, 0] = far
    active = np.arange(sets) if count > 1 else np.arange(0)
    for _ in range(MOST_STEPS):
        if active.size == 0:
            break
        moved, now, chosen, done = _step(points[active], centre[active], support[active])
        centre[active], radius[active], support[active] = moved, now, chosen
        active = active[~done]
    return Ball(centre, radius)


def _step(
    points: Floats, centre: Floats, support: NDArray[np.intp]
) -> tuple[Floats, Floats, NDArray[np.intp], NDArray[np.bool_]]:
    """Return centres, radii and supports after a step, and which balls are smallest."""
    rows = np.arange(points.shape[0])
    first = points[rows, support[:, 0]]
    used = support[:, 1:] >= 0
    edges = np.where(used[..., None], points[rows[:, None], support[:, 1:]] - first[:, None], 0.0)
    weights = _weights(edges, used, centre - first)
    way = first + np.einsum("sk,skd->sd", weights, edges) - centre
    # A support as large as can be has no flat but the whole space: the centre is there.
    way[np.all(used, axis=1)] = 0
    share, hit = _way_to_next(points, centre, support, way)
    centre = centre + share[:, None] * way
    radius = np.sqrt(_squares(first - centre))
    every = np.concatenate([1 - weights.sum(axis=1, keepdims=True), weights], axis=1)
    every[:, 1:][~used] = np.inf
    worst = np.argmin(every, axis=1)
    arrived = share >= 1
    done = arrived & (every[rows, worst] >= -ROUNDING)
    support = support.copy()
    joins = ~arrived
    support[joins, 1 + np.argmin(used, axis=1)[joins]] = hit[joins]
    leaves = np.flatnonzero(arrived & ~done)
    support[leaves, worst[leaves]] = -1
    # The first place is never empty.
    swapped = leaves[worst[leaves] == 0]
    other = 1 + np.argmax(support[swapped, 1:] >= 0, axis=1)
    support[swapped, 0] = support[swapped, other]
    support[swapped, other] = -1
    return centre, radius, support, done


def _weights(edges: Floats, used: NDArray[np.bool_], offset: Floats) -> Floats:
    """Return the foot of the centre on the flat of the support, in edges of the support."""
    gram = np.einsum("sid,sjd->sij", edges, edges)
    size = gram.shape[1]
    scale = np.maximum(np.trace(gram, axis1=1, axis2=2), np.finfo(float).tiny ** 0.5)
    diagonal = np.arange(size)
    gram[:, diagonal, diagonal] += scale[:, None] * np.where(used, 1e-13, 1.0)
    return np.linalg.solve(gram, np.einsum("sid,sd->si", edges, offset)[..., None])[..., 0]


def _way_to_next(
    points: Floats, centre: Floats, support: NDArray[np.intp], way: Floats
) -> tuple[Floats, NDArray[np.intp]]:
    """Return which share of the way the centre goes, 1: all, and the point that stops it."""
    rows = np.arange(points.shape[0])
    first = points[rows, support[:, 0]]
    square = _squares(first - centre)
    room = square[:, None] - _squares(points - centre[:, None])
    closing = np.einsum("sd,snd->sn", way, first[:, None] - points)
    length = np.sqrt(_squares(way))
    nears = closing > ROUNDING * (length * np.sqrt(square))[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = np.where(nears, np.maximum(room, 0) / (2 * closing), np.inf)
    # By rounding a point of the support could stop the ball that it is on.
    at, place = np.nonzero(support >= 0)
    shares[at, support[at, place]] = np.inf
    hit = np.argmin(shares, axis=1)
    share = shares[rows, hit]
    at_foot = length <= ROUNDING * np.sqrt(square)
    return np.where(at_foot, 1.0, np.minimum(share, 1.0)), hit


def _squares(vectors: Floats) -> Floats:
    return np.einsum("...d,...d->...", vectors, vectors)
