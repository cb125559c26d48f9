"""Film and waves of a contact with too little oil: laws fitted to computed contacts.

r is the oil offered over the flow of the flooded contact, R the central film over the flooded film.
The laws come from ``scripts/study starvation``, in pure rolling, with Roelands' viscosity and
Dowson and Higginson's density.
"""

from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.formula import (
    power_ratio,
    recommended_parameter,
    recommended_sharpness,
    wave_and_direction,
)
from ehlwave.duals import np, to_float
from ehlwave.error_bars import bar
from ehlwave.errors import RangeError

Floats = NDArray[np.float64]

FILM_COEFFICIENTS = (1.447, 0.1038, -0.0841, -0.245, -0.498)
"""ln g at r = 0 of M = 100, L = 10, D = 1, and the powers of M, L, D and 1 + r in g."""
FILM_RANGES = {"M": (20.0, 1000.0), "L": (2.0, 20.0), "D": (0.1, 1.0), "r": (0.2, 5.0)}

WAVE_COEFFICIENTS = (0.7569, 0.6734, -0.8266, 0.9517, 0.2906)
"""Powers of R: in x, in x times cos^2(theta), in n; factor of x; power of 1/R in the common error.
"""
WAVE_RANGES = {"M": (50.0, 800.0), "L": (4.0, 18.0), "D": (0.1, 1.0), "R": (0.39, 1.0)}

FILM_BAR, WAVE_BAR = bar("starvation.film"), bar("starvation.wave")
"""Errors of R and of Ad/Ai, absolute."""

TRANSVERSE, OTHERS = (0.25, 2.0), (0.35, 1.0)
"""Wavelengths over a, along the wave vector, of the responses that the law was fitted to."""
TRANSVERSE_BELOW_DEG = 22.5
"""Waves at smaller angles count as transverse: the fitted angles were 0, 45 and 90 degrees."""

OIL_OVER_FLOODED = "oil_over_flooded"
"""The key of r."""

UNDER_SLIP = (
    f"{OIL_OVER_FLOODED} needs pure rolling (slip_parameter = 1, slide_to_roll_ratio = 0): under "
    "slip the two layers of oil move apart, outside the law of starved contacts"
)
WAVES_TEXT = (
    f"wavelengths of {TRANSVERSE[0]:g} to {TRANSVERSE[1]:g} a below {TRANSVERSE_BELOW_DEG:g} "
    f"degrees, else of {OTHERS[0]:g} to {OTHERS[1]:g} a"
)


def film_over_flooded(
    oil_over_flooded: ArrayLike,
    load_m: ArrayLike,
    lubricant_l: ArrayLike,
    radius_ratio_d: ArrayLike,
) -> Floats:
    """Return R = r (1 + r^g)^(-1/g), g = 4.25 (M/100)^0.104 (L/10)^-0.084 D^-0.245 (1 + r)^-0.498.

    Fitted to 293 films of 29 contacts, r 0.2 to 5: the root mean square error of R is 0.006, held
    out by contacts 0.006, the largest 0.028. A common g for all contacts leaves 0.024.

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
    >>> from ehlwave.contact.starvation import film_over_flooded
    >>> film_over_flooded([0.3, 1, 3], 100, 12.05, 1).round(2).tolist()
    [0.3, 0.79, 0.96]
    """
    values = {"r": oil_over_flooded, "M": load_m, "L": lubricant_l, "D": radius_ratio_d}
    r, m, l, d = _checked(values, FILM_RANGES)  # noqa: E741
    return np.asarray(power_ratio(1 / r, film_sharpness(r, m, l, d)))


def film_sharpness(
    oil_over_flooded: ArrayLike, load_m: ArrayLike, lubricant_l: ArrayLike, ratio_d: ArrayLike
) -> Floats:
    """Return g of `film_over_flooded`, which has its parameters; no range is checked."""
    r, m, l, d = (  # noqa: E741
        np.asarray(value, dtype=np.float64)
        for value in (oil_over_flooded, load_m, lubricant_l, ratio_d)
    )
    start, of_m, of_l, of_d, of_r = FILM_COEFFICIENTS
    return np.asarray(
        np.exp(start) * (m / 100) ** of_m * (l / 10) ** of_l * d**of_d * (1 + r) ** of_r
    )


def starved_ratio(
    film_ratio: ArrayLike,
    load_m: ArrayLike,
    lubricant_l: ArrayLike,
    gamma: ArrayLike,
    wavelength_x: ArrayLike,
    wavelength_y: ArrayLike,
) -> Floats:
    """Return Ad/Ai of a starved contact, (1 + x^n)^(-m/n) with m = R^-0.29.

    x and n belong to the flooded contact, `ehlwave.contact.formula.recommended_parameter` and
    `recommended_sharpness`, times 0.952 R^(-0.76 - 0.67 cos^2(theta)) and R^-0.83: less oil means
    more reduction, most of long waves, described by m. Fitted to 824 linear responses of 15
    contacts: the root mean square error of Ad/Ai is 0.026, held out by contacts 0.027, the largest
    0.086; 0.029 where R is below 0.45.

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
    Half the film leaves less than half of waves of one a:

    >>> from ehlwave.contact.starvation import starved_ratio
    >>> starved_ratio([1, 0.5], 100, 12.05, 1, 1, 0).round(2).tolist()
    [0.71, 0.27]
    """
    ranges = {name: WAVE_RANGES[name] for name in ("R", "M", "L")}
    ratio, m, l = _checked({"R": film_ratio, "M": load_m, "L": lubricant_l}, ranges)  # noqa: E741
    of_x, of_direction, of_n, factor, of_all = WAVE_COEFFICIENTS
    _, along = wave_and_direction(wavelength_x, wavelength_y)
    x = recommended_parameter(m, l, gamma, wavelength_x, wavelength_y)
    parameter = factor * x * ratio ** -(of_x + of_direction * along)
    curve = power_ratio(parameter, recommended_sharpness(l) * ratio**of_n)
    return np.asarray(curve**ratio**-of_all)


def is_fitted(wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> NDArray[np.bool_]:
    """Return whether waves are among those that the law of Ad/Ai was fitted to.

    Parameters
    ----------
    wavelength_over_a, angle_deg : array_like
        Along the wave vector, and between it and the rolling direction.

    Examples
    --------
    >>> from ehlwave.contact.starvation import is_fitted
    >>> is_fitted([0.25, 0.25, 2, 2], [0, 90, 0, 90]).tolist()
    [True, False, True, False]
    """
    wave = np.asarray(wavelength_over_a, dtype=np.float64)
    is_transverse = np.abs(np.asarray(angle_deg, dtype=np.float64)) < TRANSVERSE_BELOW_DEG
    low, high = (np.where(is_transverse, *ends) for ends in zip(TRANSVERSE, OTHERS, strict=True))
    return np.asarray((wave >= low * (1 - 1e-9)) & (wave <= high * (1 + 1e-9)))


def ratio_error(
    film_ratio: float,
    load_m: float,
    lubricant_l: float,
    gamma: float,
    wavelength_x: ArrayLike,
    wavelength_y: ArrayLike,
) -> Floats:
    """Return the error of `starved_ratio`, absolute: its own, and the effect of the error of R.

    95 % of responses computed anew lie within. Parameters as of `starved_ratio`.

    Examples
    --------
    >>> from ehlwave.contact.starvation import ratio_error
    >>> ratio_error(0.5, 100, 12.05, 1, [0.5, 1], 0).round(2).tolist()
    [0.11, 0.1]
    """
    low, high = WAVE_RANGES["R"]
    ends = (max(film_ratio - FILM_BAR, low), min(film_ratio + FILM_BAR, high))
    waves = wavelength_x, wavelength_y
    small, large = (starved_ratio(end, load_m, lubricant_l, gamma, *waves) for end in ends)
    return np.asarray(WAVE_BAR + np.abs(large - small) * FILM_BAR / (ends[1] - ends[0]))


def check_waves(film_ratio: float, load_m: float, lubricant_l: float, ratio_d: float) -> None:
    """Raise `RangeError` if the law of Ad/Ai was not fitted to such contacts.

    Parameters
    ----------
    film_ratio, load_m, lubricant_l, ratio_d : float
        R, M, L and D.
    """
    values = {"R": film_ratio, "M": load_m, "L": lubricant_l, "D": ratio_d}
    _checked(values, WAVE_RANGES)


def _checked(
    values: dict[str, ArrayLike], ranges: dict[str, tuple[float, float]]
) -> tuple[Floats, ...]:
    """Return the values as arrays, all within their ranges."""
    arrays = []
    for name, value in values.items():
        array = np.asarray(value, dtype=np.float64)
        low, high = ranges[name]
        if not np.all((array >= low) & (array <= high)):
            said = f" = {to_float(array):.4g}" if array.ndim == 0 else ""
            words = "oil_over_flooded, r" if name == "r" else name
            raise RangeError(
                f"{words}{said} is outside {low:g} to {high:g}, the range of the law of starved "
                "contacts: compute the contact with ehlwave-case, &inlet oil_over_flooded"
            )
        arrays.append(array)
    return tuple(arrays)
