"""Line contacts with heat whose films are thicker than their Hertz approach.

Pressures spread beyond the Hertz contact and stay below the Hertz pressure: friction of thin oils
(small L) rises over the friction of an even film, friction of others falls. The warm inlet makes
the whole film easier to shear. Fitted to the contacts of ``scripts/study heat-ends``, whose
coefficients and errors, contacts held out, are in ``postprocess/record/heat/ends_law.csv``.
"""

from typing import NamedTuple

from numpy.typing import ArrayLike, NDArray

from ehlwave.duals import np
from ehlwave.error_bars import bar

Floats = NDArray[np.float64]

THINNEST_FILM = 1.0
"""Film over the Hertz approach from which the factor of friction counts."""
COEFFICIENTS = (0.17908, 1.0444, 8.6437, 2.4808, 2.3216)
FRICTION_BAR = bar("light_lines.friction")
FILM_BAR, FILM_BAR_BY_LOSS = bar("light_lines.film"), bar("light_lines.film_by_loss")
"""Relative error of films in addition to the error of the laws of heat: constant, and by the loss
at the inlet."""
RIGID_BAR_BY_LOSS = bar("light_lines.rigid_by_loss")
"""As the last, of rolling contacts whose load hardly deforms the bodies."""


FITTED_L, FITTED_ROLLING_L = 20.0, 25.0
"""L of sliding and of rolling contacts up to which the laws of heat are fitted."""
OILY_FILMS, OILY_FRICTION = bar("light_lines.oily_films"), bar("light_lines.oily_friction")
"""Factor of film errors beyond, and more error of friction."""


class LightRange(NamedTuple):
    """Ranges of the computed contacts that slide, beyond those of the other laws of heat."""

    load_parameter_m: tuple[float, float] = (0.6, 5.0)
    film_over_approach: tuple[float, float] = (0.0, 7.5)
    hertz_pressure_pa: tuple[float, float] = (5e7, 1.8e9)


LIGHT = LightRange()


def film_bar(loss: float, is_rigid: bool) -> float:
    """Return the error of films of light contacts beside the error of the laws of heat.

    Parameters
    ----------
    loss : float
        Of film by the warm inlet.
    is_rigid : bool
        Whether the load hardly deforms the bodies.
    """
    return FILM_BAR + (RIGID_BAR_BY_LOSS if is_rigid else FILM_BAR_BY_LOSS) * loss


def is_oily(lubricant_parameter_l: float, rolls: bool) -> bool:
    """Return whether L of a contact is above the contacts of the fit.

    Parameters
    ----------
    lubricant_parameter_l, rolls : float, bool
        L, and whether the contact is in pure rolling.
    """
    return lubricant_parameter_l > (FITTED_ROLLING_L if rolls else FITTED_L)


def light_factor(
    film_over_approach: ArrayLike,
    lubricant_parameter_l: ArrayLike,
    inlet: ArrayLike,
    warmth: ArrayLike,
    coefficients: ArrayLike = COEFFICIENTS,
) -> Floats:
    """Return friction of a light line contact over the friction of the other laws.

    exp(-c1 x^c2 ln(L/c3) + c4 ln(f) x/((1 + x)(1 + c5 w))), x = H - 1; 1 where H is below 1.

    Parameters
    ----------
    film_over_approach : array_like
        H, the central film over the Hertz approach.
    lubricant_parameter_l : array_like
        L.
    inlet : array_like
        f, the film with the warm inlet over the film without; 1 without heat.
    warmth : array_like
        w, beta times the rise at mid film by sliding.
    coefficients : array_like, optional
        c1 to c5.

    Examples
    --------
    >>> from ehlwave.laws.light_lines import light_factor
    >>> float(light_factor(0.9, 10, 0.9, 0.0))
    1.0
    >>> print(f"{float(light_factor(3.0, 4, 1.0, 0.0)):.2f}")
    1.33
    """
    c1, c2, c3, c4, c5 = np.asarray(coefficients, dtype=np.float64)
    x = np.maximum(np.asarray(film_over_approach, dtype=np.float64) - THINNEST_FILM, 0)
    spread = c1 * x**c2 * np.log(np.asarray(lubricant_parameter_l) / c3)
    warmed = c4 * np.log(inlet) * x / ((1 + x) * (1 + c5 * np.asarray(warmth)))
    return np.asarray(np.exp(warmed - spread))
