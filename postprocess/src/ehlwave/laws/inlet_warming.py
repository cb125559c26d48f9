"""By how much the shear of its own inlet thins a film: a law fitted to computed contacts.

``scripts/study inlet`` computes the contacts, fits the law and writes its coefficients for this
module and for ``ehlwave-case``, which warns by the same numbers.
"""

from dataclasses import dataclass

from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.heat_data import Heat
from ehlwave.duals import np, to_float
from ehlwave.errors import SurfaceError
from ehlwave.laws import inlet_coefficients as table

Floats = NDArray[np.float64]

FILM_EXPONENT = 0.67
"""Exponent of viscosity in the film thickness (Hamrock and Dowson 1977)."""
LEAST_FACTOR = 0.05
"""Keeps the rough estimate positive far beyond its range."""


@dataclass(frozen=True)
class InletWarming:
    """Loss of an isothermal film by a warm inlet.

    Attributes
    ----------
    loss : float
        Share of the isothermal central film.
    error : float or None
        Error of that share; None where the fit has no contact like it.
    rise_k : float
        Temperature rise of the oil in the inlet that thins a film by as much, K.
    """

    loss: float
    error: float | None
    rise_k: float

    @property
    def is_upper_estimate(self) -> bool:
        """Return whether the law does not hold: the loss is then a rough upper estimate.

        Examples
        --------
        >>> from ehlwave.laws.inlet_warming import InletWarming
        >>> InletWarming(loss=0.03, error=0.008, rise_k=1.1).is_upper_estimate
        False
        """
        return self.error is None


def thermal_loading(
    viscosity_pa_s: ArrayLike, beta_per_k: ArrayLike, speed_m_per_s: ArrayLike, k: ArrayLike
) -> Floats:
    """Return L_t = eta0 beta u^2/k: about the rise of a film by rolling, times beta.

    Parameters
    ----------
    viscosity_pa_s, beta_per_k, speed_m_per_s, k : array_like
        Viscosity, its decay with temperature, mean speed and conductivity of the oil.

    Examples
    --------
    >>> from ehlwave.laws.inlet_warming import thermal_loading
    >>> print(f"{thermal_loading(0.05, 0.045, 5.0, 0.14):.2f}")
    0.40
    """
    given = (viscosity_pa_s, beta_per_k, speed_m_per_s, k)
    eta, beta, u, k = (np.asarray(value, dtype=np.float64) for value in given)
    return np.asarray(eta * beta * u**2 / k)


def wall_parameter(heat: Heat, film_m: float, semi_axis_a_m: float, speed_m_per_s: float) -> float:
    """Return B = (k/h)(a/u)^(1/2) times the mean of the reciprocal effusivities.

    The rise of the surfaces over the rise of the film, for a common flow of heat.

    Parameters
    ----------
    heat : Heat
        Of oil and bodies.
    film_m, semi_axis_a_m : float
        Central film and Hertz semi-axis along rolling, m.
    speed_m_per_s : float
        Mean speed.

    Examples
    --------
    >>> import ehlwave
    >>> from ehlwave.laws.inlet_warming import wall_parameter
    >>> heat = ehlwave.Heat(313.15, 0.045, 0.14, 2000, 870)
    >>> print(f"{wall_parameter(heat, 8e-7, 1.5e-4, 4.0):.3f}")
    0.082
    """
    slow = sum(0.5 / body.effusivity for body in heat.bodies)
    return _wall(heat.oil_conductivity_w_per_m_k, slow, film_m, semi_axis_a_m, speed_m_per_s)


def _wall(
    k: float, slow: float, film_m: float, semi_axis_a_m: float, speed_m_per_s: float
) -> float:
    return to_float(k / film_m * (semi_axis_a_m / speed_m_per_s) ** 0.5 * slow)


def inlet_factor(
    loading: ArrayLike,
    slide_to_roll_ratio: ArrayLike,
    wall: ArrayLike,
    film_over_approach: ArrayLike,
    radius_ratio_d: ArrayLike,
    load_parameter_m: ArrayLike,
    coefficients: ArrayLike = table.COEFFICIENTS,
) -> Floats:
    """Return the share by which the shear of the inlet thins a film, eq. (T15).

    1/(1 + y) with y = c1 L_t^c2 (1 + c3 s^c4) (1 + c5 B^c6) G^(c7 + c8 D) exp(c9 D)
    (M/100)^c11 and G = H/(1 + c10 H^(3/2)).

    Parameters
    ----------
    loading : array_like
        L_t, as from `thermal_loading`.
    slide_to_roll_ratio : array_like
        s, either sign.
    wall : array_like
        B, as from `wall_parameter`: how hard it is for heat to go on into the bodies.
    film_over_approach : array_like
        H, central film without heat over the Hertz approach.
    radius_ratio_d : array_like
        D; 0 of a line contact.
    load_parameter_m : array_like
        M.
    coefficients : array_like
        Coefficients of the record.

    Examples
    --------
    >>> from ehlwave.laws.inlet_warming import inlet_factor
    >>> inlet_factor([0.0, 0.4], 0.0, 0.5, 0.1, 0.0, 100.0).round(1).tolist()
    [1.0, 0.8]
    """
    c1, c2, c3, c4, c5, c6, c7, c8, c9, c10, c11 = np.asarray(coefficients, dtype=np.float64)
    given = (loading, slide_to_roll_ratio, wall, film_over_approach, radius_ratio_d)
    m = np.asarray(load_parameter_m, dtype=np.float64) / 100
    x, s, b, h, d = (np.asarray(value, dtype=np.float64) for value in given)
    shear = c1 * x**c2 * (1 + c3 * np.abs(s) ** c4) * (1 + c5 * b**c6)
    gap = h / (1 + c10 * h**1.5)
    return np.asarray(1 / (1 + shear * gap ** (c7 + c8 * d) * np.exp(c9 * d) * m**c11))


def loss_error(loss: float, slide_to_roll_ratio: float) -> float:
    """Return the error of a share of the film: 95 % of the computed contacts are within.

    Parameters
    ----------
    loss : float
        The share.
    slide_to_roll_ratio : float
        Either sign; films that slide are known less.

    Examples
    --------
    >>> from ehlwave.laws.inlet_warming import loss_error
    >>> loss_error(0.03, 0.0) < 0.015 < loss_error(0.03, 1.5)
    True
    """
    k = sum(abs(slide_to_roll_ratio) > slip for slip in table.ERROR_SLIP)
    return table.ERROR_SHARE[k] * (loss + table.KNOWN_LOSS)


def inlet_warming(
    conditions: Conditions, film_m: float | None = None, heat: Heat | None = None
) -> InletWarming:
    """Return the loss of the isothermal film of a contact by a warm inlet.

    Parameters
    ----------
    conditions : Conditions
        From dimensional data.
    film_m : float, optional
        Central film without heat, m; by default the film of the conditions.
    heat : Heat, optional
        Of oil and bodies; by default a usual mineral oil between bodies of steel.

    Raises
    ------
    SurfaceError
        If the conditions have no dimensional data.

    Examples
    --------
    >>> from ehlwave.contact import conditions_from_keys
    >>> from ehlwave.laws.inlet_warming import inlet_warming
    >>> c = conditions_from_keys({"radius_x_m": 0.0127, "radius_y_m": 0.0127, "load_n": 40,
    ...     "reduced_modulus_pa": 2.26e11, "mean_speed_m_per_s": 4, "viscosity_pa_s": 0.05})
    >>> found = inlet_warming(c)
    >>> print(f"{found.loss:.2f}", found.error < 0.02)
    0.04 True
    """
    given, film = dict(conditions.given), film_m or conditions.central_film_m
    if "viscosity_pa_s" not in given or film is None or conditions.hertz_approach_c_m is None:
        raise SurfaceError(
            "inlet_warming: needs dimensional conditions (viscosity_pa_s, ...), not M, L and D"
        )
    u, eta = (to_float(given[key]) for key in ("mean_speed_m_per_s", "viscosity_pa_s"))
    if heat is None:
        beta, k, slow = table.USUAL_BETA, table.USUAL_CONDUCTIVITY, 1 / table.USUAL_EFFUSIVITY
    else:
        beta, k = heat.viscosity_temperature_per_k, heat.oil_conductivity_w_per_m_k
        slow = sum(0.5 / body.effusivity for body in heat.bodies)
    ratio, thick = conditions.slide_to_roll_ratio, film / conditions.hertz_approach_c_m
    loading = to_float(thermal_loading(eta, beta, u, k))
    wall = _wall(k, slow, film, conditions.semi_axis_a_m, u)
    factor = to_float(inlet_factor(loading, ratio, wall, thick, conditions.d, conditions.m))
    error: float | None = loss_error(1 - factor, ratio)
    if not _is_within(conditions, loading, thick, ratio):
        over_modulus = conditions.hertz_pa / to_float(given["reduced_modulus_pa"])
        factor, error = min(factor, _gupta(loading, ratio, over_modulus)), None
    return InletWarming(1 - factor, error, -to_float(np.log(factor)) / (FILM_EXPONENT * beta))


def _is_within(conditions: Conditions, loading: float, thick: float, ratio: float) -> bool:
    """Return whether the fit covers contacts like it."""
    ranges = (
        (conditions.m, table.M_RANGE),
        (conditions.l, table.L_RANGE),
        (thick, table.FILM_RANGE),
        (loading, table.LOADING_RANGE),
    )
    is_shaped = conditions.d >= table.LOWEST_D or conditions.d == 0
    is_slow = abs(ratio) <= table.LARGEST_SLIDE_ROLL
    return is_shaped and is_slow and all(low <= value <= high for value, (low, high) in ranges)


def _gupta(loading: float, ratio: float, hertz_over_modulus: float) -> float:
    """Return the factor of Gupta and others, eq. (T3)."""
    pressure = 1 - 13.2 * hertz_over_modulus * loading**0.42
    return max(LEAST_FACTOR, pressure) / (
        1 + 0.213 * (1 + 2.23 * abs(ratio) ** 0.83) * loading**0.64
    )
