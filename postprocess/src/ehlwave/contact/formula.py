"""The amplitude reduction formula of Venner, Kaneta and Lubrecht (2000).

All quantities are dimensionless and all functions work element by element on arrays of any
(broadcastable) shape. NaN in gives NaN out. Equation numbers refer to ``src/theory.md``; the
paper's own numbers differ:

========================  =======  ==========
relation                  here     paper
========================  =======  ==========
f(r)                      (15)     (13)
V2                        (16)     (14)
V                         (17)     (16), (18)
Ad/Ai                     (18)     (12)
========================  =======  ==========
"""

from numpy.typing import ArrayLike, NDArray

from ehlwave.duals import np
from ehlwave.errors import ArgumentError

Floats = NDArray[np.float64]

PAPER_C1 = 0.15
PAPER_C2 = 0.015

RECOMMENDED_SCALE = 0.263
RECOMMENDED_L_EXPONENT = 1 / 3
RECOMMENDED_SHARPNESS = (1.5, 10.0)
RECOMMENDED_RANGES = {"M": (50.0, 2000.0), "L": (2.5, 20.0), "D": (0.04, 1.0)}
"""Operating conditions that the recommended formula was fitted to, smallest and largest."""


def wavelength_ratio(wavelength_x: ArrayLike, wavelength_y: ArrayLike) -> Floats:
    """Return r = lambda_x / lambda_y, as used in eq. (15).

    Parameters
    ----------
    wavelength_x, wavelength_y : array_like
        Wavelengths in units of a. Zero means that the pattern does not vary in that direction (an
        infinite wavelength), as in the results files.

    Returns
    -------
    ndarray
        0 for transverse, 1 for isotropic, inf for longitudinal waviness; NaN where both wavelengths
        are zero (smooth).

    Raises
    ------
    ValueError
        If a wavelength is negative.

    Examples
    --------
    Transverse, isotropic and longitudinal waves:

    >>> import ehlwave
    >>> ehlwave.wavelength_ratio([1, 1, 0], [0, 1, 1]).tolist()
    [0.0, 1.0, inf]
    """
    along, across = _wave_numbers(wavelength_x, wavelength_y)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(across / along)


def f_of_r(r: ArrayLike) -> Floats:
    """Return the orientation factor f(r), eq. (15): exp(1 - 1/r) if r > 1, else 1.

    Parameters
    ----------
    r : array_like
        lambda_x / lambda_y; inf (longitudinal) gives e.

    Raises
    ------
    ValueError
        If r is negative.

    Examples
    --------
    >>> import ehlwave
    >>> ehlwave.f_of_r([0, 1, 2, float("inf")]).round(3).tolist()
    [1.0, 1.0, 1.649, 2.718]
    """
    ratio = _not_negative("r", r)
    return np.exp(1 - 1 / np.maximum(ratio, 1.0))


def v2(wavelength_over_a: ArrayLike, load_m: ArrayLike, lubricant_l: ArrayLike) -> Floats:
    """Return V2 = (lambda/a) (M/L)^(1/2), eq. (16).

    Parameters
    ----------
    wavelength_over_a : array_like
        The smaller of the two wavelengths, in units of a.
    load_m, lubricant_l : array_like
        Moes load and lubricant parameters M and L.

    Raises
    ------
    ValueError
        If an argument is negative, or L is zero.

    Examples
    --------
    >>> import ehlwave
    >>> ehlwave.v2([0.5, 1.0], load_m=100, lubricant_l=4).tolist()
    [2.5, 5.0]
    """
    return v(wavelength_over_a, load_m, lubricant_l, 1.0)


def v(
    wavelength_over_a: ArrayLike, load_m: ArrayLike, lubricant_l: ArrayLike, gamma: ArrayLike
) -> Floats:
    """Return V = (lambda/a) (gamma M/L)^(1/2), eq. (17).

    Parameters
    ----------
    wavelength_over_a : array_like
        The smaller of the two wavelengths, in units of a.
    load_m, lubricant_l : array_like
        Moes load and lubricant parameters M and L.
    gamma : array_like
        Ellipticity factor of the load, 1 for a circular contact, eq. (3).

    Raises
    ------
    ValueError
        If an argument is negative, or L is zero.

    Examples
    --------
    >>> import ehlwave
    >>> print(f"{ehlwave.v(0.5, load_m=100, lubricant_l=12.05, gamma=1):.3f}")
    1.440
    """
    wave = _not_negative("wavelength_over_a", wavelength_over_a)
    load = _not_negative("load_m", load_m) * _not_negative("gamma", gamma)
    lubricant = _positive("lubricant_l", lubricant_l)
    return np.asarray(wave * np.sqrt(load / lubricant))


def amplitude_ratio_formula(x: ArrayLike, c1: float = PAPER_C1, c2: float = PAPER_C2) -> Floats:
    """Return Ad/Ai = 1 / (1 + c1 x + c2 x^2), eq. (18).

    Parameters
    ----------
    x : array_like
        f(r) V, or f(r) V2 for the former formula of circular contacts.
    c1, c2 : float
        Coefficients; the paper's by default.

    Raises
    ------
    ValueError
        If x is negative.

    Examples
    --------
    >>> import ehlwave
    >>> ehlwave.amplitude_ratio_formula([0, 1, 10]).round(3).tolist()
    [1.0, 0.858, 0.25]
    """
    values = _not_negative("x", x)
    return np.asarray(1 / (1 + values * (c1 + values * c2)))


def recommended_parameter(
    load_m: ArrayLike,
    lubricant_l: ArrayLike,
    gamma: ArrayLike,
    wavelength_x: ArrayLike,
    wavelength_y: ArrayLike,
) -> Floats:
    """Return x = 0.263 (lambda_n/a) (gamma M)^(1/2) L^(-cos^2(theta)/3).

    lambda_n is the wavelength along the wave vector, 1/lambda_n^2 = 1/lambda_x^2 + 1/lambda_y^2,
    and theta the angle between wave vector and rolling direction, cos(theta) = lambda_n/lambda_x:
    transverse waves have x ~ L^(-1/3), longitudinal waves do not depend on L.

    Parameters
    ----------
    load_m, lubricant_l : array_like
        Moes load and lubricant parameters M and L.
    gamma : array_like
        Ellipticity factor of the load, 1 for a circular contact, eq. (3).
    wavelength_x, wavelength_y : array_like
        In units of a; zero means infinite, both zero (smooth) gives NaN.

    Raises
    ------
    ValueError
        If an argument is negative, or L is zero.
    """
    load = _not_negative("load_m", load_m) * _not_negative("gamma", gamma)
    lubricant = _positive("lubricant_l", lubricant_l)
    wave, along = wave_and_direction(wavelength_x, wavelength_y)
    power = -RECOMMENDED_L_EXPONENT * along
    return np.asarray(RECOMMENDED_SCALE * wave * np.sqrt(load) * lubricant**power)


def recommended_ratio(
    load_m: ArrayLike,
    lubricant_l: ArrayLike,
    gamma: ArrayLike,
    wavelength_x: ArrayLike,
    wavelength_y: ArrayLike,
) -> Floats:
    """Return Ad/Ai = (1 + x^n)^(-1/n), n = 1.5 + 10/L, x of :func:`recommended_parameter`.

    Fitted to linear responses in pure rolling with 50 <= M <= 2000, 2.5 <= L <= 20,
    0.04 <= D <= 1, waves in any direction, 0.09 <= lambda_n/a <= 4 (the shorter of lambda_x and
    lambda_y 0.12 a to 4 a): the root mean square error of Ad/Ai is 0.03 there, the largest 0.16;
    formula (18) has 0.14 and 0.55. The products of cosines of the model and plane waves of the same
    lambda_x, lambda_y have the same ratio at the contact centre. The formula never exceeds 1;
    computed ratios reach 1.1 at small L. For x > 5 it tends to be too large in proportion.

    Parameters and errors as for :func:`recommended_parameter`.
    """
    x = recommended_parameter(load_m, lubricant_l, gamma, wavelength_x, wavelength_y)
    return power_ratio(x, recommended_sharpness(lubricant_l))


def recommended_sharpness(lubricant_l: ArrayLike) -> Floats:
    """Return n = 1.5 + 10/L."""
    base, slope = RECOMMENDED_SHARPNESS
    return np.asarray(base + slope / np.asarray(lubricant_l, dtype=np.float64))


def power_ratio(x: ArrayLike, sharpness: ArrayLike) -> Floats:
    """Return (1 + x^n)^(-1/n): 1 - x^n/n for small x, 1/x for large; no overflow for large x^n."""
    n = np.asarray(sharpness, dtype=np.float64)
    # x = 0 gives 1; NaN, as for a smooth surface, stays NaN.
    with np.errstate(divide="ignore", invalid="ignore"):
        log_x = np.log(np.asarray(x, dtype=np.float64))
        return np.asarray(np.exp(-np.logaddexp(0.0, n * log_x) / n))


def wave_and_direction(wavelength_x: ArrayLike, wavelength_y: ArrayLike) -> tuple[Floats, Floats]:
    """Return lambda_n, 1/lambda_n^2 = 1/lambda_x^2 + 1/lambda_y^2, and cos^2(theta).

    theta is the angle between wave vector and rolling direction: cos^2(theta) = 1/(1 + r^2) is 1
    for transverse, 1/2 for isotropic, 0 for longitudinal waviness. A wavelength of zero means
    infinite; where both are, the answers are NaN.

    Raises ValueError if a wavelength is negative.
    """
    along, across = _wave_numbers(wavelength_x, wavelength_y)
    squared = along**2 + across**2
    with np.errstate(divide="ignore", invalid="ignore"):
        wave = np.where(squared > 0, 1 / np.sqrt(squared), np.nan)
        return wave, np.asarray(along**2 / squared)


def _wave_numbers(wavelength_x: ArrayLike, wavelength_y: ArrayLike) -> tuple[Floats, Floats]:
    """Return 1/lambda_x and 1/lambda_y, for which "no variation" is an ordinary zero."""
    waves = (
        _not_negative("wavelength_x", wavelength_x),
        _not_negative("wavelength_y", wavelength_y),
    )
    with np.errstate(divide="ignore"):
        along, across = (np.where(wave == 0, 0.0, 1 / wave) for wave in waves)
    return along, across


def _not_negative(name: str, values: ArrayLike) -> Floats:
    array = np.asarray(values, dtype=np.float64)
    if np.any(array < 0):
        raise ArgumentError(f"{name} is negative")
    return array


def _positive(name: str, values: ArrayLike) -> Floats:
    array = _not_negative(name, values)
    if np.any(array == 0):
        raise ArgumentError(f"{name} is zero")
    return array
