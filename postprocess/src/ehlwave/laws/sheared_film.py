"""Shear stress, friction and temperatures of a sliding film, place by place under Hertz pressure.

The film has a uniform thickness. Without convection and pressure gradients, a film whose viscosity
falls as exp(-beta theta) has a closed form, (T8) of the theory; surfaces are warmed by the
heat that passed before, (T16). Friction is the integral of the stress over the load.
"""

from dataclasses import dataclass
from functools import cache

from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from ehlwave.contact.heat_data import Heat
from ehlwave.contact.oils import ROELANDS_PA, log_viscosity
from ehlwave.duals import np, to_float

Floats = NDArray[np.float64]

PLACES, STRIPS = 41, 7
"""Along a strip, and strips from the middle of an ellipse to its side."""
ROUNDS, STEPS, CONVERGED = 25, 60, 1e-10
"""Rounds of the surfaces' rise, and steps for ln A until one is this small: the next is below
round-off."""
LOG_A = (-30.0, 5.0)
"""Interval of ln A."""
MEAN_BAND = 0.752
"""Mean rise of a surface under an even band source, in q (2 b/u)^(1/2)/effusivity."""
ROELANDS_K = 138.0


@dataclass(frozen=True)
class Sliding:
    """A film between two surfaces that slide."""

    hertz_pa: float
    semi_axis_a_m: float
    film_m: float
    """`hertz_pa`, `semi_axis_a_m`, `film_m`: largest pressure, half width along rolling, film."""
    mean_speed_m_per_s: float
    slide_to_roll_ratio: float
    """`mean_speed_m_per_s`, `slide_to_roll_ratio`: mean speed and ratio, not 0."""
    viscosity_pa_s: float
    pressure_viscosity_per_pa: float
    roelands_index: float
    eyring_stress_pa: float
    """`viscosity_pa_s`, `pressure_viscosity_per_pa`, `roelands_index`, `eyring_stress_pa`: of a
    Ree-Eyring oil with Roelands' viscosity."""
    is_line: bool
    """Whether it has no ends across."""

    @property
    def speeds(self) -> tuple[float, float]:
        """Return the speeds of both surfaces."""
        u, half = self.mean_speed_m_per_s, self.slide_to_roll_ratio / 2
        return u * (1 + half), u * (1 - half)

    @property
    def sliding_m_per_s(self) -> float:
        """Return the difference of the speeds."""
        return abs(self.slide_to_roll_ratio) * self.mean_speed_m_per_s


@dataclass(frozen=True)
class Sheared:
    """Friction coefficient, and the rises of the film at the centre, K."""

    friction: float
    rise_mid_film_k: float = 0.0
    rise_surfaces_k: float = 0.0

    @property
    def rise_mean_k(self) -> float:
        """Return the rise of the mean across the film, as of a parabola."""
        return self.rise_surfaces_k + 2 / 3 * (self.rise_mid_film_k - self.rise_surfaces_k)


def shear_isothermal(case: Sliding) -> Sheared:
    """Return the friction of a film all of which is at T0."""
    pressure, weight = _pressures(case)
    log_eta, _ = _log_viscosity(case, None, pressure, np.zeros_like(pressure))
    log_b = np.log(case.sliding_m_per_s / case.film_m / case.eyring_stress_pa) + log_eta
    return Sheared(_friction(case, case.eyring_stress_pa * _asinh_exp(log_b), weight))


def shear_warm(case: Sliding, heat: Heat) -> Sheared:
    """Return friction and rises of a film that its shear warms."""
    pressure, weight = _pressures(case)
    at_walls = np.zeros_like(pressure)
    spread = _wall_factor(case, heat)
    log_a = np.zeros_like(pressure)
    for _ in range(ROUNDS):
        stress, rise, log_a = _local(case, heat, pressure, at_walls, log_a)
        lengths = np.sqrt(case.semi_axis_a_m * np.sqrt(_strips(case)[0]))[:, None]
        warmed = spread * lengths * (stress * case.sliding_m_per_s @ _half_order().T)
        at_walls = at_walls + 0.5 * (warmed - at_walls)
    friction = _friction(case, stress, weight)
    middle = PLACES // 2
    walls = to_float(at_walls[0, middle])
    return Sheared(friction, walls + to_float(rise[0, middle]), walls)


def _strips(case: Sliding) -> tuple[Floats, Floats]:
    """Return (half length of strips over a)^2 and their weights."""
    if case.is_line:
        return np.ones(1), np.ones(1)
    nodes, weights = leggauss(2 * STRIPS - 1)
    return 1 - nodes[STRIPS - 1 :] ** 2, weights[STRIPS - 1 :] * np.where(
        nodes[STRIPS - 1 :] == 0, 0.5, 1
    )


@cache
def _places() -> Floats:
    step = 2 / PLACES
    return -1 + step * (np.arange(PLACES) + 0.5)


def _pressures(case: Sliding) -> tuple[Floats, Floats]:
    """Return pressures, Pa, strip by strip, and the share of the area that each has."""
    squares, weights = _strips(case)
    pressure = case.hertz_pa * np.sqrt(np.outer(squares, 1 - _places() ** 2))
    return pressure, np.outer(weights * np.sqrt(squares), np.ones(PLACES))


def _friction(case: Sliding, stress: Floats, weight: Floats) -> float:
    """Return the integral of the stress over the load."""
    load = {True: np.pi / 2, False: 2 * np.pi / 3}[case.is_line] * case.hertz_pa
    area = 2.0 if case.is_line else np.pi
    return to_float(np.sum(stress * weight) / np.sum(weight) * area / load)


@cache
def _half_order() -> Floats:
    """Return the integral of q (x - x')^(-1/2) for values of q in cells."""
    x, half = _places(), 1 / PLACES
    far, near = (np.clip(x[:, None] - (x[None, :] + s * half), 0, None) for s in (-1, 1))
    return np.asarray(2 * (np.sqrt(far) - np.sqrt(near)))


def _wall_factor(case: Sliding, heat: Heat) -> float:
    """Return the mean rise of both surfaces for the integral of the earlier heat.

    Half of the heat goes to each surface, plus the flow through the film to the colder surface.
    """
    a, k = case.semi_axis_a_m, heat.oil_conductivity_w_per_m_k
    one, two = (
        1 / (body.effusivity * u**0.5) for body, u in zip(heat.bodies, case.speeds, strict=True)
    )
    through = k / case.film_m * MEAN_BAND * (2 * a) ** 0.5
    share = (0.5 + through * two) / (1 + through * (one + two))
    return to_float((share * one + (1 - share) * two) / 2 / np.pi**0.5)


def _log_viscosity(
    case: Sliding, heat: Heat | None, pressure: Floats, rise: Floats
) -> tuple[Floats, Floats]:
    """Return ln eta and its fall with temperature, 1/K, by Roelands."""
    alpha, z = case.pressure_viscosity_per_pa, case.roelands_index
    start = to_float(np.log(case.viscosity_pa_s))
    if heat is None:
        return start + log_viscosity(alpha, z, pressure), np.zeros_like(pressure)
    scale, above = alpha * ROELANDS_PA / z, heat.temperature_k - ROELANDS_K
    s0 = heat.viscosity_temperature_per_k * above / scale
    raised = (1 + pressure / ROELANDS_PA) ** z * (1 + rise / above) ** -s0
    return start + scale * (raised - 1), scale * raised * s0 / (above + rise)


def _asinh_exp(log_b: Floats) -> Floats:
    """Return asinh(exp(log_b)), where exp may be too large."""
    small = np.arcsinh(np.exp(np.minimum(log_b, 30)))
    return np.where(log_b < 30, small, np.log(2) + log_b)


def _local(
    case: Sliding, heat: Heat, pressure: Floats, at_walls: Floats, log_a: Floats
) -> tuple[Floats, Floats, Floats]:
    """Return stress, rise of mid film over the surfaces, (T8), and ln A, by Newton's method.

    The unknown ln A starts at `log_a` and stays within an interval that contains the solution. The
    equation compares the logarithm of tau/tau0 by the rise and by the flow law.
    """
    log_eta, beta = _log_viscosity(case, heat, pressure, at_walls)
    tau0, h, sliding = case.eyring_stress_pa, case.film_m, case.sliding_m_per_s
    factor = 8 * heat.oil_conductivity_w_per_m_k / (beta * sliding * h)
    target = np.log(sliding / (h * tau0)) + log_eta
    low, high = (np.full_like(pressure, end) for end in LOG_A)
    for _ in range(STEPS):
        a = np.exp(log_a)
        log_rate = target + log_a - _log_sinh(a) - np.log(np.cosh(a))
        stress = _asinh_exp(log_rate)
        excess = np.log(factor * a * np.tanh(a) / tau0) - np.log(stress)
        low, high = np.where(excess < 0, log_a, low), np.where(excess < 0, high, log_a)
        by_flow = (1 - 2 * a / np.tanh(2 * a)) / (stress * np.sqrt(1 + np.exp(-2 * log_rate)))
        step = excess / (1 + 2 * a / np.sinh(2 * a) - by_flow)
        new = log_a - step
        log_a = np.where((new >= low) & (new <= high), new, (low + high) / 2)
        if np.abs(step).max() < CONVERGED:
            break
    a = np.exp(log_a)
    return factor * a * np.tanh(a), 2 / beta * np.log(np.cosh(a)), log_a


def _log_sinh(x: Floats) -> Floats:
    """Return ln sinh, also where sinh is too large or nearly 0."""
    return np.where(x < 1e-6, np.log(x), x - np.log(2) + np.log(-np.expm1(-2 * x)))
