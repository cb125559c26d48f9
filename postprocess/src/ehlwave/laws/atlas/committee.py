"""Several small networks for the same numbers: an atlas answers with their mean.

Each has two hidden layers, y = B3 + W3 tanh(B2 + W2 tanh(B1 + W1 x)), of inputs x in units of
their scatter; they differ in the initial weights of their fits. Goodfellow, Bengio and Courville,
*Deep Learning* (2016), 6.1 and 7.11.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from numpy.typing import NDArray

from ehlwave.duals import np

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]

LAYERS = ("w1", "b1", "w2", "b2", "w3", "b3")
"""Weights of some networks; the first axis of each is theirs."""

Layers = tuple[Singles, ...]
"""As LAYERS."""


@dataclass(frozen=True, repr=False)
class Committee:
    """Networks of the same inputs and outputs.

    Attributes
    ----------
    centre, scatter : ndarray, shape (inputs,)
        Of the inputs where the networks were fitted.
    layers : tuple of ndarray
        Shapes (networks, inputs, hidden), (networks, 1, hidden), (networks, hidden, hidden),
        (networks, 1, hidden), (networks, hidden, outputs), (networks, 1, outputs).
    """

    centre: Floats
    scatter: Floats
    layers: Layers
    precision: type[np.floating] = np.float32
    """`precision`: of the values of layers; double: smooth enough for small differences."""

    def __repr__(self) -> str:
        """Return how many networks there are, and their size."""
        networks, inputs, hidden = self.layers[0].shape
        return f"<Committee of {networks} networks, {inputs} inputs, layers of {hidden}>"

    def __call__(self, places: Floats) -> Floats:
        """Return the outputs at places, shape (n, inputs): shape (n, outputs)."""
        return np.asarray(self._members(places).mean(axis=0), dtype=float)

    def deviation(self, places: Floats) -> Floats:
        """Return the standard deviation of one more network from their mean, (n, outputs)."""
        found = self._members(places)
        more = (1 + 1 / len(found)) ** 0.5
        return np.asarray(more * found.std(axis=0, ddof=1), dtype=float)

    def _members(self, places: Floats) -> Singles:
        """Return the outputs of each network: shape (networks, n, outputs)."""
        scaled = ((places - self.centre) / self.scatter).astype(self.precision)
        return outputs_of(self.layers, scaled)[-1]


def outputs_of(layers: Layers, scaled: Singles) -> Sequence[Singles]:
    """Return the values of both hidden layers and the outputs, of inputs in units of scatter."""
    w1, b1, w2, b2, w3, b3 = layers
    first = np.tanh(scaled @ w1 + b1)
    second = np.tanh(first @ w2 + b2)
    return first, second, second @ w3 + b3
