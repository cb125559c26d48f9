"""Hertz contacts in closed form: pressure, and the stresses below it, tension positive."""

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ellipeinc, ellipkinc

from ehlwave.choices import POISSON_RATIO
from ehlwave.errors import StressError

Floats = NDArray[np.float64]
Stresses = dict[str, Floats]

NEARLY_CIRCULAR = 1e-4
"""Limit of 1 - b/a: closer to a circle the forms of the ellipse lose their digits."""


def hertz_pressure(
    x_m: ArrayLike, y_m: ArrayLike, a_m: float, b_m: float = np.inf, hertz_pa: float = 1.0
) -> Floats:
    """Return ph (1 - (x/a)^2 - (y/b)^2)^(1/2), 0 outside, at places broadcast against each other.

    Parameters
    ----------
    x_m, y_m : array_like
        Places.
    a_m, b_m : float
        Semi-axes along x and y; b infinite: line contact.
    hertz_pa : float
        Largest pressure ph.
    """
    inside = 1 - np.square(np.asarray(x_m) / a_m) - np.square(np.asarray(y_m) / b_m)
    return np.asarray(hertz_pa * np.sqrt(np.maximum(inside, 0)))


def hertz_line_stress(
    x_m: ArrayLike,
    z_m: ArrayLike,
    a_m: float,
    hertz_pa: float = 1.0,
    friction: float = 0.0,
    poisson_ratio: float = POISSON_RATIO,
) -> Stresses:
    """Return the stresses below a line contact, plane strain, with a traction of friction times p.

    McEwen (1949); Johnson, *Contact Mechanics* (1985), equations 4.49 and 7.8. The traction on the
    body points along +x where friction is above 0.

    Parameters
    ----------
    x_m, z_m : array_like
        Places, broadcast; z from the surface into the body.
    a_m : float
        Half width.
    hertz_pa, friction, poisson_ratio : float
        Largest pressure, traction over pressure, and Poisson's ratio.
    """
    x, z = np.broadcast_arrays(np.asarray(x_m, float) / a_m, np.asarray(z_m, float) / a_m)
    part = 1 - x**2 + z**2
    root = np.hypot(part, 2 * x * z)
    m = np.sqrt(np.maximum(root + part, 0) / 2)
    n = np.copysign(np.sqrt(np.maximum(root - part, 0) / 2), x)
    square = m**2 + n**2
    with np.errstate(divide="ignore", invalid="ignore"):
        # At the ends of the contact all of this is 0.
        share = np.where(square > 0, (z**2 + n**2) / square, 0.0)
        shear = np.where(square > 0, (m**2 - z**2) / square, 0.0)
    along = -(m * (1 + share) - 2 * z)
    normal = -m * (1 - share)
    crossed = -n * shear
    pull = n * (1 + shear) + n - 2 * x
    sxx = hertz_pa * (along + friction * pull)
    szz = hertz_pa * (normal + friction * crossed)
    sxz = hertz_pa * (crossed + friction * along)
    none = np.zeros(x.shape)
    return _stresses(sxx, poisson_ratio * (sxx + szz), szz, none, none, sxz)


def hertz_circle_stress(
    x_m: ArrayLike,
    y_m: ArrayLike,
    z_m: ArrayLike,
    a_m: float,
    hertz_pa: float = 1.0,
    poisson_ratio: float = POISSON_RATIO,
) -> Stresses:
    """Return the stresses below a circular contact at any place.

    Huber (1904); Johnson, *Contact Mechanics* (1985), section 3.4; Sneddon's forms.

    Parameters
    ----------
    x_m, y_m, z_m : array_like
        Places, broadcast; z from the surface into the body.
    a_m : float
        Radius of the contact.
    hertz_pa, poisson_ratio : float
        Largest pressure, Poisson's ratio.
    """
    nu = poisson_ratio
    x, y, z = np.broadcast_arrays(*(np.asarray(place, float) / a_m for place in (x_m, y_m, z_m)))
    r = np.hypot(x, y)
    part = r**2 + z**2 - 1
    root = np.hypot(part, 2 * z)
    # u solves r^2/(1 + u) + z^2/u = 1; t = z u^(-1/2) is 1 - r^2 at the surface inside.
    u = np.where(part > 0, (part + root) / 2, 2 * z**2 / np.maximum(root - part, 1e-300))
    t = np.sqrt(np.maximum(1 - r**2 / (1 + u), 0))
    w = np.sqrt(u)
    angle = w * np.arctan2(1.0, w)
    far = r > 1e-6
    hoop = (1 - 2 * nu) / 3 * np.where(far, (1 - t**3) / np.where(far, r, 1) ** 2, 1.5 / (1 + u))
    denominator = np.maximum(u**2 + z**2, 1e-300)
    normal = np.where(z > 0, t**3 * u / denominator, t)
    radial = hoop + normal + t * ((1 - nu) * u / (1 + u) + (1 + nu) * angle - 2)
    around = -(hoop + t * (2 * nu + (1 - nu) * u / (1 + u) - (1 + nu) * angle))
    shear = -r * z**2 / denominator * w / (1 + u)
    cos = np.where(r > 0, x / np.where(r > 0, r, 1), 1.0)
    sin = np.where(r > 0, y / np.where(r > 0, r, 1), 0.0)
    sxx, syy = (radial * one**2 + around * other**2 for one, other in ((cos, sin), (sin, cos)))
    sxy = (radial - around) * cos * sin
    parts = (sxx, syy, -normal, sxy, shear * sin, shear * cos)
    return _stresses(*(hertz_pa * stress for stress in parts))


def hertz_axis_stress(
    z_m: ArrayLike,
    a_m: float,
    b_m: float,
    hertz_pa: float = 1.0,
    poisson_ratio: float = POISSON_RATIO,
) -> Stresses:
    """Return the stresses on the z axis below an elliptical contact.

    Thomas and Hoersch (1930); Johnson, *Contact Mechanics* (1985), equation 3.69.

    Parameters
    ----------
    z_m : array_like
        Depths.
    a_m, b_m : float
        Semi-axes along x and y, either the longer.
    hertz_pa, poisson_ratio : float
        Largest pressure, Poisson's ratio.

    Raises
    ------
    StressError
        If a semi-axis is not above 0 and finite.
    """
    if not (0 < a_m < np.inf and 0 < b_m < np.inf):
        raise StressError(f"semi-axes of {a_m} and {b_m} m: give two lengths above 0")
    z = np.asarray(z_m, dtype=float)
    long, short = max(a_m, b_m), min(a_m, b_m)
    if 1 - short / long < NEARLY_CIRCULAR:
        return hertz_circle_stress(0.0, 0.0, z, (a_m * b_m) ** 0.5, hertz_pa, poisson_ratio)
    ratio, zeta, nu = short / long, z / long, poisson_ratio
    square = 1 - ratio**2
    t = np.sqrt((ratio**2 + zeta**2) / (1 + zeta**2))
    phi = np.arctan2(1.0, zeta)
    f, e = ellipkinc(phi, square), ellipeinc(phi, square)
    first, second = zeta * (f - e), zeta * (e / ratio**2 - f)
    along = -(1 - t) / 2 + first + nu * (1 - t / ratio**2 + second)
    across = 0.5 + 0.5 / t - t / ratio**2 + second + nu * (-1 + t + first)
    scale = hertz_pa * ratio / square
    none = np.zeros(z.shape)
    both = 2 * scale * along, 2 * scale * across
    sxx, syy = both if a_m >= b_m else both[::-1]
    return _stresses(sxx, syy, -scale * (1 - t**2) / t, none, none, none)


def _stresses(*parts: Floats) -> Stresses:
    return dict(zip(("sxx", "syy", "szz", "sxy", "syz", "sxz"), parts, strict=True))
