"""The amplitude reduction formula of Venner, Kaneta and Lubrecht (2000).

All quantities are dimensionless and all functions work element by element on arrays of any
(broadcastable) shape. NaN in gives NaN out. The equation numbers are those of the project's model
description; the paper's own numbers differ:

========================  =======  ==========
relation                  here     paper
========================  =======  ==========
f(r)                      (15)     (13)
V2                        (16)     (14)
V                         (17)     (16), (18)
Ad/Ai                     (18)     (12)
========================  =======  ==========
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

PAPER_C1 = 0.15
PAPER_C2 = 0.015


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
    """
    wave_x = _not_negative("wavelength_x", wavelength_x)
    wave_y = _not_negative("wavelength_y", wavelength_y)
    with np.errstate(divide="ignore", invalid="ignore"):
        # 1/lambda is the wave number, for which "no variation" is an ordinary zero.
        ratio = np.where(wave_y == 0, 0.0, 1 / wave_y) / np.where(wave_x == 0, 0.0, 1 / wave_x)
    return np.asarray(ratio)


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
    """
    wave = _not_negative("wavelength_over_a", wavelength_over_a)
    load = _not_negative("load_m", load_m) * _not_negative("gamma", gamma)
    lubricant = _not_negative("lubricant_l", lubricant_l)
    if np.any(lubricant == 0):
        raise ValueError("lubricant_l is zero")
    return np.asarray(wave * np.sqrt(load / lubricant))


def amplitude_ratio_formula(x: ArrayLike, c1: float = PAPER_C1, c2: float = PAPER_C2) -> Floats:
    """Return Ad/Ai = 1 / (1 + c1 x + c2 x^2), eq. (18).

    Parameters
    ----------
    x : array_like
        f(r) V, or f(r) V2 for the formula as it stood for circular contacts.
    c1, c2 : float
        Coefficients; the paper's by default.
    """
    values = np.asarray(x, dtype=np.float64)
    return np.asarray(1 / (1 + values * (c1 + values * c2)))


def _not_negative(name: str, values: ArrayLike) -> Floats:
    array = np.asarray(values, dtype=np.float64)
    if np.any(array < 0):
        raise ValueError(f"{name} is negative")
    return array
