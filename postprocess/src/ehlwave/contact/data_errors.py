"""Effect of errors of a contact's data on the film."""

from collections.abc import Mapping

from ehlwave.contact.scales import moes_film
from ehlwave.duals import math, to_float

OIL_ERRORS = ("viscosity_error", "pressure_viscosity_error")
"""Relative errors of the oil's viscosity and alpha; film and friction include them."""

EYRING_ERROR = "eyring_stress_error"
"""Relative error of the Eyring stress; friction includes it."""

OF_ERRORS = {
    "viscosity_error": ("viscosity_pa_s",),
    "pressure_viscosity_error": ("pressure_viscosity_per_pa",),
    "load_error": ("load_n", "load_n_per_m", "load_parameter_m"),
    "speed_error": ("mean_speed_m_per_s",),
    "radius_x_error": ("radius_x_m",),
    "radius_y_error": ("radius_y_m",),
    "modulus_error": ("reduced_modulus_pa",),
    "roelands_error": ("roelands_index",),
    EYRING_ERROR: ("eyring_stress_pa",),
}
"""Keys that relative standard errors of a contact's data belong to: the one that is given."""

DATA_ERRORS = tuple(OF_ERRORS)
"""Relative errors of data; the film includes them."""


def film_change(m: float, l: float, d: float, viscosity: float, alpha: float) -> float:  # noqa: E741
    """Return the film over that before, where viscosity and alpha become so many times as large.

    By the film formula: M goes with the viscosity as eta^(-3/4), of lines eta^(-1/2), L as
    alpha eta^(1/4), and the film in the Moes scale is in units that go as eta^(1/2).
    """
    power = -0.5 if d == 0 else -0.75
    other = moes_film(m * viscosity**power, l * alpha * viscosity**0.25, d)
    return to_float(other * viscosity**0.5 / moes_film(m, l, d))


def film_error_by_data(values: Mapping[str, float], m: float, l: float, d: float) -> float:  # noqa: E741
    """Return by how much the film changes, relative, as the oil's data change by their errors."""

    def change(viscosity: float, alpha: float) -> float:
        return abs(film_change(m, l, d, viscosity, alpha) - 1)

    eta, alpha = (values.get(key, 0.0) for key in OIL_ERRORS)
    by_oil = sum(
        max(change(1 + a, 1 + b), change(1 - a, 1 - b))
        for a, b in ((eta, 0.0), (0.0, alpha))
        if a + b
    )
    return by_oil + sum(
        abs(_power(key, m, l, d)) * values[key] for key in _CHANGES if values.get(key)
    )


_CHANGES: dict[str, tuple[tuple[float, float, float, float], tuple[float, float, float, float]]] = {
    "load_error": ((1, 0, 0, 0), (1, 0, 0, 0)),
    "speed_error": ((-0.75, 0.25, 0, 0.5), (-0.5, 0.25, 0, 0.5)),
    "modulus_error": ((-0.25, 0.75, 0, -0.5), (-0.5, 0.75, 0, -0.5)),
    "radius_x_error": ((-1.25, -0.25, 1, 0.5), (-0.5, -0.25, 0, 0.5)),
    "radius_y_error": ((0, 0, -1, 0), (0, 0, 0, 0)),
}
"""Powers with which data change M, L, D and the metres of a film in the Moes scale; of lines."""


def _power(key: str, m: float, l: float, d: float) -> float:  # noqa: E741
    """Return d ln(film in metres)/d ln(data) by the film formula."""
    by_m, by_l, by_d, by_scale = _CHANGES[key][d == 0]
    step = -1e-4 if by_d > 0 else 1e-4  # D stays below 1

    def film(x: float) -> float:
        ratio = d * math.exp(by_d * x)
        return to_float(moes_film(m * math.exp(by_m * x), l * math.exp(by_l * x), ratio))

    return by_scale + math.log(film(step) / film(0.0)) / step
