"""The coordinates of line contacts that slide, and references of their films and friction."""

from collections.abc import Mapping

from numpy.typing import ArrayLike

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.line_contact import line_film, moes_per_line_film
from ehlwave.contact.medium import hertz_medium
from ehlwave.contact.oils import log_viscosity
from ehlwave.duals import np, to_float
from ehlwave.laws.atlas.coordinates import Floats
from ehlwave.laws.atlas.line import line_coordinates
from ehlwave.laws.atlas.line_rolling import rolling_line_chart
from ehlwave.laws.atlas.ranges import LINE_RANGES
from ehlwave.laws.atlas.sliding import STRESS_POINTS, conditions_of, slip_coordinates

LINE_SLIDING_RANGES = LINE_RANGES | {
    "slip_parameter": (0.3, 1.7),
    "stress_modulus_pa2": (1.936e17, 9.68e18),
}
"""Smallest and largest value of each key of a line contact that slides, of a Ree-Eyring oil.

Its networks were fitted to these, independent of the ranges of ellipses.
"""


def line_conditions_of(keys: Mapping[str, ArrayLike]) -> list[Conditions]:
    """Return the conditions of line contacts given by columns named as their keys."""
    return conditions_of(keys, LINE_SLIDING_RANGES)


def thinning(contact: Conditions, slip: float) -> float:
    """Return B of the viscosity at ambient pressure, in the film of Moes' formula."""
    c = contact
    film = to_float(line_film(c.m, c.l) / moes_per_line_film(c.m))
    return hertz_medium(c.oil, c.kappa, c.alphabar, c.lambdabar, film, slip).thinning


def line_sliding_coordinates(keys: Mapping[str, ArrayLike]) -> Floats:
    """Return the coordinates of contacts, shape (c, 7), by columns named as their keys.

    Coordinates as in rolling line contacts, with ln H, and the three of slip: ``atlas/sliding.py``.
    """
    rolling = line_coordinates(keys)
    at_two = [thinning(one, 2.0) for one in line_conditions_of(keys)]
    return np.column_stack([np.log(rolling[:, 0]), rolling[:, 1:], slip_coordinates(keys, at_two)])


def mean_line_stress(contact: Conditions) -> float:
    """Return the mean of asinh(B) under the Hertz pressure, over the width of the contact."""
    oil = contact.oil
    nodes, weights = np.polynomial.legendre.leggauss(STRESS_POINTS)
    pressure = contact.hertz_pa * np.sqrt(1 - ((nodes + 1) / 2) ** 2)  # over X, 0 to 1
    viscosity = log_viscosity(oil.pressure_viscosity_per_pa, oil.roelands_index, pressure)
    own = thinning(contact, contact.slip_parameter)
    return to_float(weights @ np.arcsinh(own * np.exp(viscosity)) / 2)


def line_sliding_references(keys: Mapping[str, ArrayLike]) -> Floats:
    """Return central and smallest film in pure rolling, Moes scale, mean stress and P = 1.

    Shape (c, 4), by columns named as the keys of contacts.
    """
    rows = []
    for contact in line_conditions_of(keys):
        films = rolling_line_chart(contact).computed_films()
        rows.append((*films, mean_line_stress(contact), 1.0))
    return np.array(rows)


def line_sliding_state(
    keys: Mapping[str, ArrayLike], references: Floats, numbers: Mapping[str, Floats]
) -> Mapping[str, ArrayLike]:
    """Return the keys of contacts with H and ln P at their centres."""
    scales = moes_per_line_film(np.atleast_1d(np.asarray(keys["load_parameter_m"], dtype=float)))
    film = references[:, 0] * np.exp(numbers["film_ratio"]) / scales
    return {**keys, "central_film": film, "pressure_ratio": numbers["pressure_ratio"]}
