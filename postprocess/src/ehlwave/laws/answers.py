"""Answers of a contact: films of the smooth contact, responses to waves."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ehlwave.contact.equality import equal_fields
from ehlwave.shown import html_table, micrometres, within

if TYPE_CHECKING:
    from ehlwave.contact.conditions import Conditions
    from ehlwave.laws.heat_laws import Heated


@dataclass(frozen=True)
class Film:
    """Films of a smooth contact.

    Parameters
    ----------
    central_m, minimum_m : float or None
        Film at the contact centre and smallest film, m; None when M, L and D came without a radius.
        The smallest film is not known of a starved contact, beside a given central film, with heat
        under slip in an oil that is not Ree-Eyring's, and where the error of the atlas is 100 % or
        more: None, and NaN in the Moes scale.
    central_moes, minimum_moes : float
        The same in the Moes scale, (h/Rx)(2U)^(-1/2).
    central_error, minimum_error : float
        Relative: 95 % of films computed anew lie within.
    friction : float or None
        Friction coefficient without waves, its size, isothermal unless the contact has heat; None:
        not known (pure rolling, or an oil that is not Ree-Eyring's).
    friction_error : float or None
        Relative, like films.
    source : str
        Source.
    heated : Heated or None
        Of a contact with heat: by how much heat thins the film, friction with and without heat,
        rises of the temperature.
    rolling_resistance_coefficient, rolling_resistance : float or None
        Force that resists rolling at each surface: over the load, and in N (line contacts: N/m);
        the power is twice this force times the mean speed. It acts in pure rolling, too, where the
        friction coefficient is 0. None: not known.
    rolling_resistance_error : float or None
        Relative error of both.
    warnings : tuple of str
        Doubts about the numbers: large errors, a warm inlet without heat data.

    Examples
    --------
    >>> import ehlwave
    >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10, radius_ratio_d=1)
    >>> film = contact.film()
    >>> print(f"Hc = {film.central_moes:.2f}, Hmin = {film.minimum_moes:.2f}")
    Hc = 3.87, Hmin = 2.08
    """

    central_m: float | None
    minimum_m: float | None
    central_moes: float
    minimum_moes: float
    central_error: float
    minimum_error: float
    friction: float | None
    friction_error: float | None
    source: str
    heated: Heated | None = None
    rolling_resistance_coefficient: float | None = None
    rolling_resistance: float | None = None
    rolling_resistance_error: float | None = None
    warnings: tuple[str, ...] = ()
    __eq__ = equal_fields

    def _repr_html_(self) -> str:
        rows = {}
        if math.isfinite(self.central_moes):
            rows["Hc, Moes"] = within(self.central_moes, self.central_error)
        if math.isfinite(self.minimum_moes):
            rows["Hmin, Moes"] = within(self.minimum_moes, self.minimum_error)
        rows["central film"] = micrometres(self.central_m)
        rows["smallest film"] = micrometres(self.minimum_m)
        if self.friction is not None:
            rows["friction"] = within(self.friction, self.friction_error)
        if self.rolling_resistance_coefficient is not None:
            known = self.rolling_resistance_coefficient, self.rolling_resistance_error
            rows["rolling resistance over load"] = within(*known)
        if self.heated is not None:
            rows["film by heat"] = f"{self.heated.film_factor:.3f} of that without"
        return html_table("Film", rows | {"source": self.source})


def given_film(conditions: Conditions) -> Film:
    """Return the central film that a contact was given; its smallest film is not known."""
    central, scale = conditions.central_film_m, conditions.metres_per_moes
    return Film(
        central_m=central,
        minimum_m=None,
        central_moes=central / scale if central and scale else math.nan,
        minimum_moes=math.nan,
        central_error=conditions.central_film_error or 0.0,
        minimum_error=math.nan,
        friction=None,
        friction_error=None,
        source=conditions.film_source,
    )


@dataclass(frozen=True)
class Response:
    """Response of film and pressure at the contact centre to small waves of the rough surface.

    The surface is A exp(i(kx X - w T)), positive where it widens the gap.

    Parameters
    ----------
    film : complex
        Film over Ai; a positive imaginary part means that it lags behind the surface.
    pressure : complex
        Amplitude of P over Ai, in units of ph/c, c the Hertz approach.
    error : float
        Of ``film``, absolute, in units of Ai: 95 % of responses computed anew lie within.
    source : str
        Source.
    has_phase : bool
        Whether the lag is known. The law of starved contacts has amplitudes alone: `film` is real
        then, and `error` applies to its amplitude.

    Examples
    --------
    >>> import ehlwave
    >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10, radius_ratio_d=1)
    >>> response = contact.response(wavelength_over_a=0.5)
    >>> print(f"{abs(response.film):.2f} within {response.error:.2f}")
    0.92 within 0.01
    """

    film: complex
    pressure: complex
    error: float
    source: str
    has_phase: bool = True

    def _repr_html_(self) -> str:
        rows = {"film over Ai": f"{abs(self.film):.4g} within {self.error:.2g}"}
        lag = f"{math.degrees(cmath.phase(self.film)):.3g} degrees"
        rows["lag"] = lag if self.has_phase else "not known"
        rows["pressure over Ai, ph/c"] = f"{abs(self.pressure):.4g}"
        return html_table("Response", rows | {"source": self.source})
