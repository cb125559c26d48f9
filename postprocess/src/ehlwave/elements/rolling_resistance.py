"""Rolling resistance and power of the contacts of an element."""

from collections.abc import Iterable

from ehlwave.elements.hertz import reduced_modulus
from ehlwave.elements.place import ElementContact
from ehlwave.laws.rolling_resistance import LINE_ERROR, error_of, rolling_force

__all__ = ["LINE_ERROR", "error_of", "force_of", "rolling_force", "rolling_power_w"]


def rolling_power_w(places: Iterable[ElementContact]) -> float:
    """Return the power of rolling of both surfaces of contacts, 2 F u, without heat.

    Parameters
    ----------
    places : iterable of ElementContact
        The contacts.
    """
    return sum(2 * force_of(place) * abs(place.mean_speed_m_per_s) for place in places)


def force_of(place: ElementContact) -> float:
    """Return the rolling resistance of a contact at each surface, N.

    Parameters
    ----------
    place : ElementContact
        The contact.
    """
    return rolling_force(
        place.load_n,
        place.radius_x_m,
        place.radius_y_m,
        reduced_modulus(*place.bodies),
        place.oil.viscosity_pa_s,
        place.mean_speed_m_per_s,
        place.length_m,
    )
