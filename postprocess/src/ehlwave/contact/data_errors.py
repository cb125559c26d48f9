"""Effect of errors of the oil's data on the film."""

from collections.abc import Mapping

from ehlwave.contact.scales import moes_film

DATA_ERRORS = ("viscosity_error", "pressure_viscosity_error")
"""Relative errors of the oil's data; the film includes them."""


def film_change(m: float, l: float, d: float, viscosity: float, alpha: float) -> float:  # noqa: E741
    """Return the film over that before, where viscosity and alpha become so many times as large.

    By the film formula: M goes with the viscosity as eta^(-3/4), of lines eta^(-1/2), L as
    alpha eta^(1/4), and the film in the Moes scale is in units that go as eta^(1/2).
    """
    power = -0.5 if d == 0 else -0.75
    other = moes_film(m * viscosity**power, l * alpha * viscosity**0.25, d)
    return float(other * viscosity**0.5 / moes_film(m, l, d))


def film_error_by_data(values: Mapping[str, float], m: float, l: float, d: float) -> float:  # noqa: E741
    """Return by how much the film changes, relative, as the oil's data change by their errors."""

    def change(viscosity: float, alpha: float) -> float:
        return abs(film_change(m, l, d, viscosity, alpha) - 1)

    eta, alpha = (values.get(key, 0.0) for key in DATA_ERRORS)
    return sum(
        max(change(1 + a, 1 + b), change(1 - a, 1 - b))
        for a, b in ((eta, 0.0), (0.0, alpha))
        if a + b
    )
