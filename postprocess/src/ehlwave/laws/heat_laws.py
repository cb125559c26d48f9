"""Films and friction with heat: laws fitted to computed contacts, ``scripts/study heat``.

The inlet is warmed by its own shear, which thins the film; where surfaces slide, the film between
them is warmed, which makes it easier to shear. Friction follows :mod:`ehlwave.laws.sheared_film`,
times a factor near 1, whose coefficients and errors are in ``postprocess/record/heat/laws.csv``.
The warm inlet has a law of its own, :mod:`ehlwave.laws.inlet_warming`.
"""

from copy import copy
from dataclasses import dataclass, replace

from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.heat_data import Heat
from ehlwave.duals import np, to_float
from ehlwave.error_bars import bar
from ehlwave.laws import light_lines
from ehlwave.laws.friction_error import error_by_data
from ehlwave.laws.inlet_warming import inlet_factor, thermal_loading, wall_parameter
from ehlwave.laws.sheared_film import Sheared, Sliding, shear_isothermal, shear_warm
from ehlwave.laws.warm_films import film_error, smallest_factor

Floats = NDArray[np.float64]

FRICTION_COEFFICIENTS = (0.21094, 0.58558, -0.099452, 0.40403, 0.2051, 0.35686, 39.566)
"""Coefficients of :func:`friction_factor`."""
FRICTION_BAR, COLD_BAR = bar("heat.friction"), bar("heat.friction_cold")
"""Relative errors of friction with and without heat. Errors of films come from
:func:`ehlwave.laws.warm_films.film_error`."""
ELLIPSE_BAR = bar("heat.ellipses")
"""More relative error of friction in ellipses."""
SOFT_FILMS, SOFT_FRICTION = bar("heat.soft_films"), bar("heat.soft_friction")
"""More relative error of films and friction of ellipses whose Eyring stress is below the fit."""
NEWTONIAN_PA = 1e12
"""An Eyring stress that thins no oil."""
WEDGE_POWER = 0.67
"""Power of :func:`wedge` in the film: 95 % of 187 films of unlike bodies within 0.08."""
RANGES = {
    "load_parameter_m": (5.0, 1500.0),
    "lubricant_parameter_l": (2.0, 20.0),
    "hertz_pressure_pa": (3e8, 1.8e9),
    "pressure_viscosity_per_pa": (1.1e-8, 2.6e-8),
    "roelands_index": (0.4, 0.7),
    "eyring_stress_pa": (2e6, 1.5e7),
    "abs(slide_to_roll_ratio)": (0.0, 1.9),
    "film over Hertz approach": (0.0, 0.4),
    "eta0 beta u^2/k": (0.0, 4.0),
    "effusivity of a body": (1.35e3, 1.5e4),
    "Peclet number of a surface": (0.3, np.inf),
}
"""Ranges of the fit of the laws; D is 0 (lines) or 0.2 to 1. The fitted contacts have walls as fast
surfaces do: at Peclet numbers from 0.3 and slide-to-roll ratios up to 1.8 the moving source changes
central films by at most 0.4, smallest by 0.8 and friction by 0.2 times the error of the laws.
"""
LOWEST_RATIO = 0.2
THICK_BAR, THICK_FILM = bar("heat.thick_lines"), RANGES["film over Hertz approach"][1]
"""More relative error of friction of line contacts above this film over the Hertz approach."""
LIGHT_M = 2.0
"""M of lines in the fit at least; lighter ones, and thicker films, have the errors of light lines.
"""


@dataclass(frozen=True)
class Heated:
    """A contact with heat.

    Attributes
    ----------
    film_factor : float
        Central film with heat over that without.
    inlet_factor : float
        The part of it by the warm inlet. The others are by the density at the centre and by bodies
        that conduct heat differently.
    minimum_factor : float or None
        Smallest film with heat over that without; None where surfaces slide and their rise is not
        known.
    film_error, minimum_error : float
        Central and smallest film, relative: error of the laws, which grows with the loss by the
        inlet and the rise of the surfaces, and effect of the error of the conductivity.
    friction, isothermal_friction : float or None
        Friction coefficients with and without heat; None in pure rolling and of other oils than
        Ree-Eyring's.
    friction_error : float or None
        Friction, relative: error of the law, and effect of errors of viscosity, pressure-viscosity
        coefficient and conductivity. The film error is added.
    film_error_by_data, friction_error_by_data : float
        Shares of `film_error` by the conductivity, and of `friction_error` by all data of the oil.
    rise_mid_film_k, rise_surfaces_k : float
        Rises at the centre of the contact, K; None where friction is not known.
    """

    film_factor: float
    inlet_factor: float
    minimum_factor: float | None
    film_error: float
    minimum_error: float
    friction: float | None = None
    friction_error: float | None = None
    isothermal_friction: float | None = None
    rise_mid_film_k: float | None = None
    rise_surfaces_k: float | None = None
    film_error_by_data: float = 0.0
    friction_error_by_data: float = 0.0


def wedge(heat: Heat, slide_to_roll_ratio: float, rise_surfaces_k: float) -> float:
    """Return the film between bodies of different conductivity over the film between like bodies.

    Viscosity that falls evenly across the film by exp(-d), d = beta times the rise of the faster
    surface over the slower surface, lets the mean of the oil move at 1/d - 1/(e^d - 1) of the way
    from the slower to the faster speed, in place of 1/2. The film grows as that speed falls. Each
    surface receives half of the heat.

    Parameters
    ----------
    heat : Heat
        Of both bodies.
    slide_to_roll_ratio : float
        Positive where the first surface is faster.
    rise_surfaces_k : float
        Mean rise of both surfaces.

    Examples
    --------
    A steel ball that slides on a glass disc; the steel is faster, then the glass:

    >>> import ehlwave
    >>> from ehlwave.laws.heat_laws import wedge
    >>> heat = ehlwave.Heat(313.15, 0.042, 0.14, 2000, 870, body2=ehlwave.BodyHeat(1.1, 2500, 840))
    >>> [round(wedge(heat, ratio, 40), 2) for ratio in (1, -1)]
    [0.88, 1.3]
    """
    speeds = (1 + slide_to_roll_ratio / 2, 1 - slide_to_roll_ratio / 2)

    def oil_speed(effusivities: tuple[float, float]) -> float:
        rises = [1 / (e * u**0.5) for e, u in zip(effusivities, speeds, strict=True)]
        of_first = 2 * (rises[0] - rises[1]) / sum(rises)
        d = heat.viscosity_temperature_per_k * rise_surfaces_k * of_first
        share = 0.5 if abs(d) < 1e-4 else 1 / d - 1 / np.expm1(d)
        return to_float(1 + slide_to_roll_ratio * (share - 0.5))

    first, second = (body.effusivity for body in heat.bodies)
    return oil_speed((1, 1)) / oil_speed((first, second))


def friction_factor(
    film_over_approach: ArrayLike,
    is_line: ArrayLike,
    stress_over_eyring: ArrayLike,
    loading: ArrayLike,
    slide_to_roll_ratio: ArrayLike,
    coefficients: ArrayLike = FRICTION_COEFFICIENTS,
) -> Floats:
    """Return friction over the friction of an even film under Hertz pressure.

    exp(-c1 H^c2 (1 + c3 e)/(1 + c4 t) - c5 L_T^c6/(1 + c7 s)): thick films have lower pressures
    than Hertz', which stresses t below the Eyring stress feel most, and ellipses (e = 1) more than
    lines (e = 0); oil that the inlet has warmed is easier to shear, which small slip feels most.
    """
    c1, c2, c3, c4, c5, c6, c7 = np.asarray(coefficients, dtype=np.float64)
    h, t = np.asarray(film_over_approach), np.asarray(stress_over_eyring)
    e = 1 - np.asarray(is_line, dtype=np.float64)
    spread = c1 * h**c2 * (1 + c3 * e) / (1 + c4 * t)
    warmed = c5 * np.asarray(loading) ** c6 / (1 + c7 * np.abs(slide_to_roll_ratio))
    return np.asarray(np.exp(-spread - warmed))


def sliding_film(conditions: Conditions, eyring_stress_pa: float, film_m: float) -> Sliding:
    """Return the film of a contact that slides."""
    given = dict(conditions.given)
    return Sliding(
        hertz_pa=conditions.hertz_pa,
        semi_axis_a_m=conditions.semi_axis_a_m,
        film_m=film_m,
        mean_speed_m_per_s=to_float(given["mean_speed_m_per_s"]),
        slide_to_roll_ratio=conditions.slide_to_roll_ratio,
        viscosity_pa_s=to_float(given["viscosity_pa_s"]),
        pressure_viscosity_per_pa=conditions.oil.pressure_viscosity_per_pa,
        roelands_index=conditions.oil.roelands_index,
        eyring_stress_pa=eyring_stress_pa,
        is_line=conditions.is_line,
    )


def warmed(
    conditions: Conditions,
    heat: Heat,
    film_m: float,
    eyring_stress_pa: float | None,
    is_rigid: bool = False,
) -> Heated:
    """Return film and friction of a contact with heat, errors as of contacts within the ranges.

    Arguments as in :func:`ehlwave.laws.heated_contact.heated`, which refuses others; `is_rigid`:
    whether the load hardly deforms the bodies.
    """
    given, ratio = dict(conditions.given), conditions.slide_to_roll_ratio
    u, error = to_float(given["mean_speed_m_per_s"]), heat.oil_conductivity_error
    over_c = film_m / to_float(conditions.hertz_approach_c_m or np.nan)
    is_light = conditions.is_line and (over_c > light_lines.THINNEST_FILM or conditions.m < LIGHT_M)
    is_rigid |= conditions.is_line and conditions.m < light_lines.LIGHT.load_parameter_m[0]
    softest = RANGES["eyring_stress_pa"][0]
    is_soft = not conditions.is_line and (eyring_stress_pa or softest) < softest
    is_oily = light_lines.is_oily(conditions.l, ratio == 0)

    def inlet_of(heat: Heat) -> float:
        wall = wall_parameter(heat, film_m, conditions.semi_axis_a_m, u)
        warmth = loading_of(conditions, heat)
        return to_float(inlet_factor(warmth, ratio, wall, over_c, conditions.d, conditions.m))

    def smallest_of(warmth: float) -> float:
        return to_float(smallest_factor(inlet, warmth, over_c, conditions.is_line))

    def errors_of(warmth: float) -> tuple[float, float]:
        both = (to_float(film_error(inlet, warmth, of)) for of in ("central", "smallest"))
        more = light_lines.film_bar(1 - inlet, is_rigid) if is_light or is_rigid else 0.0
        more += SOFT_FILMS if is_soft else 0.0
        times = light_lines.OILY_FILMS if is_oily else 1.0
        central, smallest = (times * (one + more) + by_data for one in both)
        return central, smallest

    inlet, loading = inlet_of(heat), loading_of(conditions, heat)
    by_data = max(abs(inlet_of(_conducting(heat, 1 + e)) / inlet - 1) for e in (-error, error))
    if ratio == 0:
        cold = Heated(inlet, inlet, inlet * smallest_of(0.0), *errors_of(0.0))
        return replace(cold, rise_mid_film_k=0.0, rise_surfaces_k=0.0)
    if eyring_stress_pa is None:  # it warms no more than an oil that does not thin
        hot = shear_warm(sliding_film(conditions, NEWTONIAN_PA, film_m * inlet), heat)
        by_data += abs(wedge(heat, ratio, hot.rise_surfaces_k) ** WEDGE_POWER - 1)
        by_data += _thicker(heat, hot) - 1
        warmth = heat.viscosity_temperature_per_k * hot.rise_surfaces_k
        return Heated(inlet, inlet, None, *errors_of(warmth))
    case = sliding_film(conditions, eyring_stress_pa, film_m)

    def factor(
        found: Sheared, film: float, loading: float, inlet: float, eyring_pa: float
    ) -> float:
        stress = found.friction * conditions.hertz_pa / eyring_pa
        own = friction_factor(over_c * film, conditions.is_line, stress, loading, ratio)
        if conditions.is_line:
            rise = heat.viscosity_temperature_per_k * found.rise_mid_film_k
            own = own * light_lines.light_factor(over_c, conditions.l, inlet, rise)
        return to_float(own)

    cold = shear_isothermal(case)
    warm = shear_warm(replace(case, film_m=film_m * inlet), heat)
    dense = inlet * _thicker(heat, warm)
    film = dense * wedge(heat, ratio, warm.rise_surfaces_k) ** WEDGE_POWER
    case_warm = replace(case, film_m=film_m * film)
    warm = shear_warm(case_warm, heat)

    def friction(one: Sliding, conductivity: float) -> float:
        other = _conducting(heat, conductivity)
        its_inlet = inlet_of(other)
        one = replace(one, film_m=one.film_m * its_inlet / inlet)
        found = shear_warm(one, other)
        one_loading = loading_of(conditions, other)
        ends = (one_loading, its_inlet, one.eyring_stress_pa)
        return found.friction * factor(found, one.film_m / film_m, *ends)

    warmth = heat.viscosity_temperature_per_k * warm.rise_surfaces_k
    own_error = FRICTION_BAR + (0.0 if conditions.is_line else ELLIPSE_BAR)
    own_error += THICK_BAR if over_c > THICK_FILM else 0.0
    if is_light:
        own_error = max(own_error, light_lines.FRICTION_BAR)
    own_error += light_lines.OILY_FRICTION if is_oily else 0.0
    own_error += SOFT_FRICTION if is_soft else 0.0
    friction_by_data = error_by_data(conditions, case_warm, friction, error)
    return Heated(
        film,
        inlet,
        film * smallest_of(warmth),
        *errors_of(warmth),
        warm.friction * factor(warm, film, loading, inlet, eyring_stress_pa),
        own_error + friction_by_data,
        cold.friction * factor(cold, 1.0, 0.0, 1.0, eyring_stress_pa),
        warm.rise_mid_film_k,
        warm.rise_surfaces_k,
        by_data,
        friction_by_data,
    )


def _thicker(heat: Heat, found: Sheared) -> float:
    """Return the growth of a film as its oil expands, over the cold oil."""
    return 1 / (1 - min(heat.oil_expansion_per_k * found.rise_mean_k, 0.5))


def _conducting(heat: Heat, factor: float) -> Heat:
    """Return heat with the oil's conductivity times a factor, whether a contact has it or not."""
    other = copy(heat)
    conductivity = heat.oil_conductivity_w_per_m_k * factor
    object.__setattr__(other, "oil_conductivity_w_per_m_k", conductivity)
    return other


def loading_of(conditions: Conditions, heat: Heat) -> float:
    """Return L_T of a contact from dimensional data."""
    given = dict(conditions.given)
    u, eta = (to_float(given[key]) for key in ("mean_speed_m_per_s", "viscosity_pa_s"))
    beta, k = heat.viscosity_temperature_per_k, heat.oil_conductivity_w_per_m_k
    return to_float(thermal_loading(eta, beta, u, k))
