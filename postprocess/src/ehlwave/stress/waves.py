"""Stresses below a harmonic load on an elastic half-space: exact, per wave.

Waves are exp(i (a x + b y)) with k = (a^2 + b^2)^(1/2); z points into the body. With u = a/k,
v = b/k and s = kz the stresses are the expressions below times exp(-s), per unit of load amplitude,
compression positive, theory eq. (B1) and (B2). The forms follow Tripp, Van Kuilenburg,
Morales-Espejel and Werner (2003), Tribology Transactions 46, written for exponentials.

| | pressure | traction on the body along x |
| --- | --- | --- |
| sx | u^2 (1 - s) + 2 nu v^2 | -i u (2 + 2 nu v^2 - u^2 s) |
| sy | v^2 (1 - s) + 2 nu u^2 | -i u (2 nu u^2 - v^2 s) |
| sz | 1 + s | -i u s |
| txy | u v (1 - 2 nu - s) | -i v (1 - 2 nu u^2 - u^2 s) |
| tyz | -i v s | -u v s |
| txz | -i u s | 1 - u^2 s |

Traction along y: x and y exchanged. This package counts tension positive: all with a minus.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ehlwave.choices import POISSON_RATIO

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

COMPONENTS = ("sxx", "syy", "szz", "sxy", "syz", "sxz")
"""The stresses, tension positive, in the order of datasets."""

Factor = Callable[["Directions", Any, float], Any]
"""Function of directions, s = kz and Poisson's ratio: a factor of the table above, without -i."""


@dataclass(frozen=True)
class Directions:
    """Direction cosines of waves."""

    u: Any
    v: Any
    """`u`, `v`: a/k and b/k, where factors are odd in them. They are 0 for the shortest wave of a
    grid, of which a real field has no odd part."""
    uu: Any
    vv: Any
    """`uu`, `vv`: their squares, where factors are even."""

    def exchanged(self) -> "Directions":
        """Return the stresses with x and y exchanged."""
        return Directions(self.v, self.u, self.vv, self.uu)


PRESSURE: dict[str, tuple[bool, Factor]] = {
    "sxx": (False, lambda d, s, nu: d.uu * (1 - s) + 2 * nu * d.vv),
    "syy": (False, lambda d, s, nu: d.vv * (1 - s) + 2 * nu * d.uu),
    "szz": (False, lambda d, s, nu: 1 + s),
    "sxy": (False, lambda d, s, nu: d.u * d.v * (1 - 2 * nu - s)),
    "syz": (True, lambda d, s, nu: d.v * s),
    "sxz": (True, lambda d, s, nu: d.u * s),
}
"""Factors of pressure by component: whether they are times -i, and the rest."""

TRACTION_X: dict[str, tuple[bool, Factor]] = {
    "sxx": (True, lambda d, s, nu: d.u * (2 + 2 * nu * d.vv - d.uu * s)),
    "syy": (True, lambda d, s, nu: d.u * (2 * nu * d.uu - d.vv * s)),
    "szz": (True, lambda d, s, nu: d.u * s),
    "sxy": (True, lambda d, s, nu: d.v * (1 - (2 * nu + s) * d.uu)),
    "syz": (False, lambda d, s, nu: -d.u * d.v * s),
    "sxz": (False, lambda d, s, nu: 1 - d.uu * s),
}
"""Factors of traction along x."""

_OTHER_AXIS = {"sxx": "syy", "syy": "sxx", "syz": "sxz", "sxz": "syz"}


def _exchanged(name: str) -> tuple[bool, Factor]:
    is_odd, factor = TRACTION_X[_OTHER_AXIS.get(name, name)]
    return is_odd, lambda d, s, nu: factor(d.exchanged(), s, nu)


TRACTION_Y = {name: _exchanged(name) for name in COMPONENTS}
"""Factors of traction along y."""

LOADS = {"pressure_pa": PRESSURE, "traction_x_pa": TRACTION_X, "traction_y_pa": TRACTION_Y}
"""Factors by kind of load."""


def wave_stress(
    load: str, a: ArrayLike, b: ArrayLike, depth: ArrayLike, poisson_ratio: float = POISSON_RATIO
) -> dict[str, Complex]:
    """Return the stresses below a load exp(i (a x + b y)), tension positive, per unit of load.

    Parameters
    ----------
    load : {"pressure_pa", "traction_x_pa", "traction_y_pa"}
        Load on the body.
    a, b : array_like
        Wave numbers along x and y; complex numbers for waves that decay along the surface. Not both
        0.
    depth : array_like
        z, in the unit of 1/a.
    poisson_ratio : float
        Of the body.

    Returns
    -------
    dict of ndarray
        By component, arguments broadcast: times exp(i (a x + b y)) they are the stresses.
    """
    along, across, z = np.broadcast_arrays(*(np.asarray(value) for value in (a, b, depth)))
    number = np.sqrt(along.astype(complex) ** 2 + across.astype(complex) ** 2)
    number = np.where(number.real < 0, -number, number)
    u, v, s = along / number, across / number, number * z
    directions, decay = Directions(u, v, u**2, v**2), -np.exp(-s)
    return {
        name: (-1j if is_odd else 1) * factor(directions, s, poisson_ratio) * decay
        for name, (is_odd, factor) in LOADS[load].items()
    }
