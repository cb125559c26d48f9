"""Central and smallest films of warm contacts over those without heat, and their errors.

The shear of the inlet warms its oil, which thins both films. It thins the constriction less, so
that the smallest film comes near the central film. The heat of sliding reaches the outlet alone,
where it thins the smallest film. Coefficients and errors come from ``scripts/study heat``, which
writes ``warm_films.json``.
"""

import json
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files

from numpy.typing import ArrayLike, NDArray

from ehlwave.duals import np

Floats = NDArray[np.float64]


@cache
def fitted() -> Mapping[str, Sequence[float]]:
    """Return the coefficients of the study: ``smallest`` and the errors."""
    text = (files("ehlwave.laws") / "warm_films.json").read_text(encoding="utf-8")
    found: Mapping[str, Sequence[float]] = json.loads(text)
    return found


def smallest_factor(
    inlet: ArrayLike,
    warmth: ArrayLike,
    film_over_approach: ArrayLike,
    is_line: ArrayLike,
    coefficients: Sequence[float] | Floats | None = None,
) -> Floats:
    """Return the ratio of the smallest to the central film, over this ratio without heat.

    exp[c1 (1 + c2 e) (1 - f)^c3 H^c4] / [1 + c5 (1 + c6 e) w^c7], f the factor of the
    inlet, :func:`ehlwave.laws.inlet_warming.inlet_factor`. Films thicker than the Hertz approach
    lose their constriction: where H is above 1, the first exponent is over 1 + (H - 1)^2.

    Parameters
    ----------
    inlet : array_like
        f.
    warmth : array_like
        w = beta times the rise of the surfaces by sliding; 0 in pure rolling.
    film_over_approach : array_like
        H, the central film without heat over the Hertz approach.
    is_line : array_like
        Whether the contact is a line.
    coefficients : sequence of float, optional
        Coefficients; the study's by default.

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
    nearer = nearer / (1 + np.maximum(h - 1, 0) ** 2)
    return np.asarray(np.exp(nearer) / (1 + c[4] * (1 + c[5] * e) * w ** c[6]))


def film_error(inlet: ArrayLike, warmth: ArrayLike, of: str = "central") -> Floats:
    """Return the relative error of the ``central`` or ``smallest`` film by heat.

    e0 + e1 (1/f - 1) + e2 w; arguments as of `smallest_factor`. Films of 95 % of
    the contacts of the record are within.
    """
    e = fitted()[f"{of}_error"]
    loss = 1 / np.asarray(inlet, dtype=np.float64) - 1
    return np.asarray(e[0] + e[1] * loss + e[2] * np.asarray(warmth, dtype=np.float64))
