"""Film and waves of a contact with too little oil: laws fitted to computed contacts.

r is the oil offered over the oil that the flooded contact passes, R the central film over that of
the flooded contact. The laws are those of ``scripts/study starvation``, in pure rolling, with
Roelands' viscosity and Dowson and Higginson's density.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ehlwave.errors import RangeError
from ehlwave.formula import (
    power_ratio,
    recommended_parameter,
    recommended_sharpness,
    wave_and_direction,
)

Floats = NDArray[np.float64]

FILM_COEFFICIENTS = (1.367, 0.0865, -0.1175, -0.2737, -0.474)
"""ln g at r = 0 of M = 100, L = 10, D = 1, and the powers of M, L, D and 1 + r in g."""
FILM_ERROR = 0.007
"""Root mean square of the law for R, held out by contacts."""
FILM_RANGES = {"M": (20.0, 1000.0), "L": (2.0, 20.0), "D": (0.1, 1.0), "r": (0.2, 5.0)}

WAVE_COEFFICIENTS = (1.131, 0.446, -1.458, 0.924)
"""Powers of R: in x, in x times cos^2(theta), in n; factor of x."""
WAVE_ERROR = 0.04
"""Root mean square of the law for Ad/Ai, held out by contacts: 0.039."""
WAVE_RANGES = {"M": (50.0, 800.0), "L": (4.0, 18.0), "D": (0.1, 1.0), "R": (0.35, 1.0)}


def film_over_flooded(
    oil_over_flooded: ArrayLike,
    load_m: ArrayLike,
    lubricant_l: ArrayLike,
    radius_ratio_d: ArrayLike,
) -> Floats:
    """Return R = r (1 + r^g)^(-1/g), g = 3.92 (M/100)^0.087 (L/10)^-0.118 D^-0.274 (1 + r)^-0.474.

    Fitted to 264 contacts, r 0.2 to 5: the root mean square error of R is 0.006, held out by
    contacts 0.007, the largest 0.026. One g for all contacts leaves 0.025.

    Parameters
    ----------
    oil_over_flooded : array_like
        r, 0.2 to 5.
    load_m, lubricant_l, radius_ratio_d : array_like
        Moes parameters M and L, and D.

    Raises
    ------
    RangeError
        If an argument is outside the range of the fit.

    Examples
    --------
    >>> from ehlwave.starvation import film_over_flooded
    >>> film_over_flooded([0.3, 1, 3], 100, 12.05, 1).round(2).tolist()
    [0.3, 0.78, 0.95]
    """
    values = {"r": oil_over_flooded, "M": load_m, "L": lubricant_l, "D": radius_ratio_d}
    r, m, l, d = _checked(values, FILM_RANGES)  # noqa: E741
    start, of_m, of_l, of_d, of_r = FILM_COEFFICIENTS
    g = np.exp(start) * (m / 100) ** of_m * (l / 10) ** of_l * d**of_d * (1 + r) ** of_r
    return np.asarray(power_ratio(1 / r, g))


def starved_ratio(
    film_ratio: ArrayLike,
    load_m: ArrayLike,
    lubricant_l: ArrayLike,
    gamma: ArrayLike,
    wavelength_x: ArrayLike,
    wavelength_y: ArrayLike,
) -> Floats:
    """Return Ad/Ai of a starved contact, (1 + x^n)^(-1/n).

    x and n are those of the flooded contact, `ehlwave.formula.recommended_parameter` and
    `recommended_sharpness`, times 0.924 R^(-1.13 - 0.45 cos^2(theta)) and R^-1.46: less oil means
    more reduction. Fitted to 655 linear responses of 16 contacts: the root mean square error of
    Ad/Ai is 0.038, held out by contacts 0.039, the largest 0.12.

    Parameters
    ----------
    film_ratio : array_like
        R, as from `film_over_flooded`.
    load_m, lubricant_l, gamma : array_like
        Moes parameters M and L, and the ellipticity factor of the load.
    wavelength_x, wavelength_y : array_like
        In units of a; zero means infinite.

    Raises
    ------
    RangeError
        If R, M or L is outside the range of the fit.

    Examples
    --------
    Half the film reduces waves of one a twice as much:

    >>> from ehlwave.starvation import starved_ratio
    >>> starved_ratio([1, 0.5], 100, 12.05, 1, 1, 0).round(2).tolist()
    [0.72, 0.32]
    """
    ranges = {name: WAVE_RANGES[name] for name in ("R", "M", "L")}
    ratio, m, l = _checked({"R": film_ratio, "M": load_m, "L": lubricant_l}, ranges)  # noqa: E741
    of_x, of_direction, of_n, factor = WAVE_COEFFICIENTS
    _, along = wave_and_direction(wavelength_x, wavelength_y)
    x = recommended_parameter(m, l, gamma, wavelength_x, wavelength_y)
    return power_ratio(
        factor * x * ratio ** -(of_x + of_direction * along),
        recommended_sharpness(l) * ratio**of_n,
    )


def _checked(
    values: dict[str, ArrayLike], ranges: dict[str, tuple[float, float]]
) -> tuple[Floats, ...]:
    """Return the values as arrays, all within their ranges."""
    arrays = []
    for name, value in values.items():
        array = np.asarray(value, dtype=np.float64)
        low, high = ranges[name]
        if not np.all((array >= low) & (array <= high)):
            raise RangeError(
                f"{name} is outside {low:g} to {high:g}, the range of the law of starved contacts: "
                "compute the contact with &inlet oil_over_flooded"
            )
        arrays.append(array)
    return tuple(arrays)
