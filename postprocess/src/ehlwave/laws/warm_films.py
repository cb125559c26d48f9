"""Central and smallest films of warm contacts over those without heat, and their errors.

The shear of the inlet warms its oil, which thins both films. It thins the constriction less, so
that the smallest film comes near the central one. The heat of sliding reaches the outlet alone,
where it thins the smallest film. Coefficients and errors are those of
``scripts/study heat``, which writes ``warm_films.json``.
"""

import json
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


@cache
def fitted() -> Mapping[str, Sequence[float]]:
    """Return the coefficients of the study: ``inlet``, ``smallest`` and their errors."""
    text = (files("ehlwave.laws") / "warm_films.json").read_text(encoding="utf-8")
    found: Mapping[str, Sequence[float]] = json.loads(text)
    return found


def inlet_factor(
    loading: ArrayLike,
    slide_to_roll_ratio: ArrayLike,
    wall: ArrayLike,
    film_over_approach: ArrayLike,
    lubricant_l: ArrayLike,
    alphabar: ArrayLike,
    is_line: ArrayLike,
    coefficients: Sequence[float] | Floats | None = None,
) -> Floats:
    """Return by what the shear of the inlet thins the central film.

    [1 + c1 (1 + c3 s^c4) L_T^c2 (1 + c5 B^c6 H^c7) H^c8 (L/10)^c9 (A/15)^c12 (1 + c10 e)]^(-c11),
    e = 1 of an ellipse and 0 of a line: the form of Gupta and others with warm surfaces.

    Parameters
    ----------
    loading : array_like
        L_T, as from :func:`ehlwave.laws.heat_laws.thermal_loading`.
    slide_to_roll_ratio : array_like
        s, either sign.
    wall : array_like
        B, as from :func:`ehlwave.laws.heat_laws.wall_parameter`.
    film_over_approach : array_like
        H, the central film without heat over the Hertz approach.
    lubricant_l, alphabar : array_like
        L, and A = alpha ph.
    is_line : array_like
        Whether the contact is a line.
    coefficients : sequence of float, optional
        Those of the study by default.

    Examples
    --------
    >>> from ehlwave.laws.warm_films import inlet_factor
    >>> inlet_factor([0.0, 0.4], 0.0, 1.0, 0.1, 10.0, 15.0, False).round(1).tolist()
    [1.0, 0.7]
    """
    c = fitted()["inlet"] if coefficients is None else coefficients
    given = (loading, slide_to_roll_ratio, wall, film_over_approach, lubricant_l, alphabar)
    x, s, b, h, oil, stiff = (np.asarray(value, dtype=np.float64) for value in given)
    e = 1 - np.asarray(is_line, dtype=np.float64)
    slides = 1 + c[2] * np.abs(s) ** c[3]
    walls = 1 + c[4] * b ** c[5] * h ** c[6]
    shape = h ** c[7] * (oil / 10) ** c[8] * (stiff / 15) ** c[11] * (1 + c[9] * e)
    return np.asarray((1 + c[0] * slides * x ** c[1] * walls * shape) ** -c[10])


def smallest_factor(
    inlet: ArrayLike,
    warmth: ArrayLike,
    film_over_approach: ArrayLike,
    is_line: ArrayLike,
    coefficients: Sequence[float] | Floats | None = None,
) -> Floats:
    """Return the ratio of the smallest to the central film, over this ratio without heat.

    exp[c1 (1 + c2 e) (1 - f)^c3 H^c4] / [1 + c5 (1 + c6 e) w^c7], f the factor of the inlet.

    Parameters
    ----------
    inlet : array_like
        f, as from `inlet_factor`.
    warmth : array_like
        w = beta times the rise of the surfaces by sliding; 0 in pure rolling.
    film_over_approach, is_line, coefficients
        As of `inlet_factor`.

    Examples
    --------
    >>> from ehlwave.laws.warm_films import smallest_factor
    >>> float(smallest_factor(1.0, 0.0, 0.1, True))
    1.0
    """
    c = fitted()["smallest"] if coefficients is None else coefficients
    f, w, h = (np.asarray(value, dtype=np.float64) for value in (inlet, warmth, film_over_approach))
    e = 1 - np.asarray(is_line, dtype=np.float64)
    nearer = c[0] * (1 + c[1] * e) * np.maximum(1 - f, 0) ** c[2] * h ** c[3]
    return np.asarray(np.exp(nearer) / (1 + c[4] * (1 + c[5] * e) * w ** c[6]))


def film_error(inlet: ArrayLike, warmth: ArrayLike, of: str = "central") -> Floats:
    """Return the relative error of the ``central`` or ``smallest`` film by heat.

    e0 + e1 (1/f - 1) + e2 w; arguments as of `smallest_factor`. At 95 % of the contacts held out of
    the fit films are within.
    """
    e = fitted()[f"{of}_error"]
    loss = 1 / np.asarray(inlet, dtype=np.float64) - 1
    return np.asarray(e[0] + e[1] * loss + e[2] * np.asarray(warmth, dtype=np.float64))
