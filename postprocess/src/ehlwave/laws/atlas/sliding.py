"""The coordinates of contacts that slide, and the references of their films and friction."""

from collections.abc import Iterable, Mapping
from functools import lru_cache

from numpy.typing import ArrayLike

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.contact.medium import INLET_VISCOSITY
from ehlwave.contact.oils import log_viscosity
from ehlwave.contact.scales import moes_per_film
from ehlwave.duals import np, to_float
from ehlwave.laws.atlas.coordinates import Floats, columns, contact_coordinates
from ehlwave.laws.atlas.kind import Kind
from ehlwave.laws.atlas.ranges import MOST_THINNING, SLIDING_RANGES
from ehlwave.laws.atlas.rolling import ROLLING, rolling_chart

STRESS_POINTS = 24
"""Points of the quadrature over the Hertz contact."""

MODULUS_PA = 2.2e11
"""Modulus of steel bodies. Only the product of E' and the Eyring stress matters."""


def sliding_coordinates(keys: Mapping[str, ArrayLike]) -> Floats:
    """Return the coordinates of contacts, shape (c, 8), by columns named as their keys.

    Coordinates of rolling contacts; ln of the Newtonian stress in the inlet over the Eyring stress
    at S = 2; and two coordinates that are equal for S and 2 - S, like films: (S - 1)^2 and, for the
    actual slip, ln(1 + (that stress ratio)^2)/2.
    """
    thinning = [one.medium(2.0).thinning for one in conditions_of(keys)]
    return np.column_stack([contact_coordinates(keys), slip_coordinates(keys, thinning)])


def slip_coordinates(keys: Mapping[str, ArrayLike], thinning: ArrayLike) -> Floats:
    """Return those by slip, shape (c, 3), from B of contacts at S = 2 and ambient pressure."""
    slip = np.atleast_1d(np.asarray(keys["slip_parameter"], dtype=float))
    stress = INLET_VISCOSITY * np.asarray(thinning)
    own = np.log1p((stress * (slip - 1)) ** 2) / 2
    return np.column_stack([np.log(stress), own, (slip - 1) ** 2])


def conditions_of(
    keys: Mapping[str, ArrayLike], ranges: Iterable[str] = SLIDING_RANGES
) -> list[Conditions]:
    """Return the conditions of contacts given by columns named as the keys of their ranges.

    Without a ratio of radii they are line contacts.
    """
    names = tuple(ranges)
    table = map(np.atleast_1d, columns(keys, names))
    return [_conditions(names, *map(to_float, row)) for row in zip(*table, strict=True)]


@lru_cache(maxsize=8192)
def _conditions(names: tuple[str, ...], *values: float) -> Conditions:
    keys = {"radius_ratio_d": 0.0} | dict(zip(names, values, strict=True))
    stress = {
        "reduced_modulus_pa": MODULUS_PA,
        "eyring_stress_pa": keys.pop("stress_modulus_pa2") / MODULUS_PA,
    }
    return conditions_from_keys(keys | stress, "atlas", needs_lengths=False)


def mean_stress(contact: Conditions) -> float:
    """Return the mean of asinh(B) under the Hertz pressure: shear over Eyring stress, for its slip.

    Without pressure gradients, with the film of the centre everywhere.
    """
    oil = contact.oil
    hertz_pa = contact.alphabar / oil.pressure_viscosity_per_pa
    nodes, weights = np.polynomial.legendre.leggauss(STRESS_POINTS)
    pressure = hertz_pa * np.sqrt((1 - nodes) / 2)  # over squares of the distance from the centre
    viscosity = log_viscosity(oil.pressure_viscosity_per_pa, oil.roelands_index, pressure)
    thinning = contact.medium(contact.slip_parameter).thinning
    return to_float(weights @ np.arcsinh(thinning * np.exp(viscosity)) / 2)


def sliding_references(keys: Mapping[str, ArrayLike], rolling: Kind = ROLLING) -> Floats:
    """Return central and smallest film in pure rolling, Moes scale, mean stress and P = 1.

    Shape (c, 4), by columns named as the keys of contacts; films by the atlas of a kind.
    """
    return np.array([_references(contact, rolling) for contact in conditions_of(keys)])


def _references(contact: Conditions, rolling: Kind) -> tuple[float, float, float, float]:
    return (*rolling_chart(contact, rolling).computed_films(), mean_stress(contact), 1.0)


def sliding_state(
    keys: Mapping[str, ArrayLike], references: Floats, numbers: Mapping[str, Floats]
) -> Mapping[str, ArrayLike]:
    """Return the keys of contacts with H and ln P at their centres."""
    scales = np.array([moes_per_film(one.m, one.kappa) for one in conditions_of(keys)])
    film = references[:, 0] * np.exp(numbers["film_ratio"]) / scales
    return {**keys, "central_film": film, "pressure_ratio": numbers["pressure_ratio"]}


def thinning_of(contact: Conditions) -> float:
    """Return the Newtonian shear stress in the inlet over the Eyring stress, of its slip."""
    return INLET_VISCOSITY * contact.medium(contact.slip_parameter).thinning


def beyond_thinning(keys: Mapping[str, float]) -> str:
    """Return the excess of the stress in the inlet over the stresses of the atlas; '' if none."""
    stress = thinning_of(conditions_of(keys)[0])
    if stress <= MOST_THINNING * (1 + 1e-9):
        return ""
    return (
        f"a Newtonian shear stress in the inlet of {stress:.3g} Eyring stresses (of at most "
        f"{MOST_THINNING:g}: oils that thin more have inlets too steep)"
    )
