"""Films of a smooth contact by the laws of films and of heat."""

from dataclasses import replace

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.heat_data import Heat
from ehlwave.duals import math, valued
from ehlwave.errors import RangeError
from ehlwave.laws.answers import Film, given_film
from ehlwave.laws.film_laws import ChartAt, smooth_film
from ehlwave.laws.friction_range import friction_outside, slight_slip_error
from ehlwave.laws.heat_laws import Heated
from ehlwave.laws.heated_contact import heated
from ehlwave.laws.isothermal_friction import isothermal_error_by_data
from ehlwave.laws.rolling_resistance import rolling_of
from ehlwave.laws.starved_transfer import check_starved
from ehlwave.shown import percent


def film_of(
    c: Conditions,
    chart_at: ChartAt,
    heat: Heat | None,
    eyring_stress_pa: float | None,
) -> Film:
    """Return the result of :meth:`ehlwave.Contact.film`.

    Parameters
    ----------
    c : Conditions
        Of the contact.
    chart_at : callable
        Its chart of the atlas at a slip parameter; raises RangeError outside.
    heat : Heat or None
        With it, film and friction are those with heat.
    eyring_stress_pa : float or None
        Of a Ree-Eyring oil.
    """
    if c.has_given_film:
        return given_film(c)
    if c.is_starved:
        check_starved(c)
        if heat is not None:
            raise RangeError("no law has both heat and oil_over_flooded")
    # The laws of heat were fitted to films of lines that roll, with their error by thinning.
    rolls = c.is_line and heat is not None
    slip = 1.0 if rolls else c.film_slip
    thinned = c.rolling_film_error if rolls else 0.0
    film, source = smooth_film(c, slip, chart_at)
    friction = friction_error = None
    if film.stress is not None and eyring_stress_pa is not None:
        hertz_pa = c.alphabar / c.oil.pressure_viscosity_per_pa
        friction = c.peak_over_mean * film.stress * eyring_stress_pa / hertz_pa
        by_data = isothermal_error_by_data(c, film.central_moes, eyring_stress_pa)
        own = (film.stress_error or 0.0) + slight_slip_error(c)
        modulus_pa = (c.oil.stress_modulus_pa2 or math.nan) / eyring_stress_pa
        own += friction_outside(c, film.central_moes, film.stress, modulus_pa)
        friction_error = (1 + own) * (1 + by_data) - 1
    scale, more = c.metres_per_moes, thinned + c.oil_error
    minimum_more = more
    central = film.central_moes * c.film_ratio
    by_heat: Heated | None = None
    minimum = film.minimum_moes if not c.is_starved else math.nan
    if heat is not None:
        by_heat = heated(c, heat, central * (scale or math.nan), eyring_stress_pa)
        if by_heat.isothermal_friction is not None and friction is not None:
            by_heat = replace(by_heat, isothermal_friction=friction)
        source = f"{source}, times the laws of heat"
        minimum *= math.nan if by_heat.minimum_factor is None else by_heat.minimum_factor
        more += by_heat.film_error
        minimum_more += by_heat.minimum_error
        friction = by_heat.friction
        film_error = film.central_error + thinned + by_heat.film_error
        shear = by_heat.friction_error
        friction_error = None if shear is None else shear + film_error
        central *= by_heat.film_factor
        minimum = min(minimum, central) if math.isfinite(minimum) else minimum
    if c.is_starved:
        source += f", times R = {c.film_ratio:.3g} of the law of starved contacts"
    knows_minimum = math.isfinite(minimum)
    rolling = rolling_of(c, 1.0 if by_heat is None else by_heat.inlet_factor)
    return Film(
        central_m=None if scale is None else central * scale,
        minimum_m=minimum * scale if scale and knows_minimum else None,
        central_moes=central,
        minimum_moes=minimum,
        central_error=valued(film.central_error + more + c.starvation_error),
        minimum_error=valued(film.minimum_error + minimum_more) if knows_minimum else math.nan,
        friction=friction,
        friction_error=valued(friction_error),
        source=source,
        heated=by_heat,
        rolling_resistance_coefficient=None if rolling is None else rolling.coefficient,
        rolling_resistance=None if rolling is None else rolling.force,
        rolling_resistance_error=None if rolling is None else rolling.error,
    )


def with_film(conditions: Conditions, film: Film) -> Conditions:
    """Return conditions whose central film is the answer of a law; a given film stays."""
    if conditions.has_given_film or conditions.metres_per_moes is None:
        return conditions
    return replace(
        conditions,
        central_film_m=film.central_m,
        film_source=f"{film.source}, within {percent(film.central_error)}",
        central_film_error=film.central_error,
    )
