"""Networks of an atlas fitted to its points: by their gradients, with a quasi-Newton method."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from ehlwave.laws.atlas.committee import Committee, Layers, outputs_of

Floats = NDArray[np.float64]

Loss = Callable[[Floats], tuple[float, Floats]]
"""Function of outputs, shape (n, outputs): the loss, and its derivatives by them."""

REMEMBERED = 20
"""Steps whose curvature the quasi-Newton method keeps."""


@dataclass(frozen=True)
class Recipe:
    """How networks are fitted.

    Attributes
    ----------
    networks : int
        Of a committee.
    hidden : int
        Of either layer.
    steps : int
        Of the quasi-Newton method.
    decay : float
        Loss by the square of each weight.
    """

    networks: int
    hidden: int
    steps: int
    decay: float


def fitted(
    places: Floats, loss: Loss, scales: Floats, recipe: Recipe, seeds: Sequence[int]
) -> Committee:
    """Return networks of inputs `places`, (n, inputs), that make a loss small.

    `scales`, (outputs,), are the usual sizes of the outputs; `seeds` determine the initial weights
    of the networks.
    """
    centre, scatter = places.mean(axis=0), places.std(axis=0)
    scatter[scatter < 1e-9 * np.abs(centre) + 1e-12] = 1.0
    scaled = ((places - centre) / scatter).astype(np.float32)

    def of_scaled(outputs: Floats) -> tuple[float, Floats]:
        value, slopes = loss(outputs * scales)
        return value, slopes * scales

    sizes = [places.shape[1], recipe.hidden, recipe.hidden, scales.size]
    found = [_network(scaled, of_scaled, sizes, recipe, seed) for seed in seeds]
    *hidden, w3, b3 = _stacked(found)
    factors = scales.astype(np.float32)
    return Committee(centre, scatter, (*hidden, w3 * factors, b3 * factors))


def joined(*committees: Committee) -> Committee:
    """Return the networks of several committees of the same inputs."""
    return replace(committees[0], layers=_stacked(one.layers for one in committees))


def _stacked(layers: Iterable[Layers]) -> Layers:
    return tuple(np.concatenate(parts) for parts in zip(*layers, strict=True))


def _network(
    scaled: NDArray[np.float32], loss: Loss, sizes: list[int], recipe: Recipe, seed: int
) -> Layers:
    """Return a network, from random weights on."""
    shapes = [
        shape
        for rows, columns in pairwise(sizes)
        for shape in ((1, rows, columns), (1, 1, columns))
    ]
    ends = np.cumsum([np.prod(shape) for shape in shapes])[:-1]

    def layers_of(values: Floats) -> Layers:
        parts = np.split(values.astype(np.float32), ends)
        return tuple(part.reshape(shape) for part, shape in zip(parts, shapes, strict=True))

    def cost(values: Floats) -> tuple[float, Floats]:
        layers = layers_of(values)
        first, second, outputs = (part[0] for part in outputs_of(layers, scaled))
        value, slopes = loss(outputs.astype(float))
        back = slopes.astype(np.float32)
        gradient = [back.sum(axis=0), second.T @ back]
        for after, inputs, weights in ((second, first, layers[4]), (first, scaled, layers[2])):
            back = back @ weights[0].T * (1 - after**2)
            gradient += [back.sum(axis=0), inputs.T @ back]
        total = np.concatenate([part.ravel() for part in reversed(gradient)]).astype(float)
        return value + recipe.decay * values @ values, total + 2 * recipe.decay * values

    random = np.random.default_rng(seed)
    start = [
        random.normal(size=shape).ravel() / np.sqrt(shape[1]) * (shape[1] > 1) for shape in shapes
    ]
    options = {"maxiter": recipe.steps, "maxfun": 2 * recipe.steps, "maxcor": REMEMBERED}
    end = minimize(cost, np.concatenate(start), jac=True, method="L-BFGS-B", options=options)
    return layers_of(end.x)
