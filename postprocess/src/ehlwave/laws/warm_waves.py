"""Waves in warm contacts, whose temperatures move with the oil.

A warm inlet is an inlet of thinner oil: the response R1 of the isothermal contact with an equally
thin film represents it. Its change lags behind the wave, since the oil carries the heat; sliding
leaves waves nearer to the isothermal response R0:

    R = R0 + (R1 - R0) (1 + i f cos(theta)/(1 + g w))/(1 + c w),
    error = (error of R1) + e1 |R1 - R0| + min(|R1 - R0|, 0.02)/2 + e2 min(w, 3),

theta between wave vector and rolling, w = beta times the rise in the middle of the film, 0 in pure
rolling. c, f, g, e1 and e2 were fitted to marches that carry temperatures with the oil,
``scripts/study judged``, which writes
``warm_waves.json``.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files

from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.contact.heat_data import Heat
from ehlwave.duals import np, to_float
from ehlwave.error_bars import bar
from ehlwave.errors import RangeError
from ehlwave.laws.answers import Film
from ehlwave.laws.transfer import OfTwo, Transfer, Waves

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]

FILM_POWER = 0.67
"""Power of the viscosity in the film."""
MOST_NEWTONIAN = 0.3
"""Largest w of Newtonian oils under slip. Marches are within the error below; above, five of 16 are
off by 1.2 to 3.2 times the error (record ``judged``)."""
BEYOND, MORE_ERROR = bar("warm_waves.beyond"), bar("warm_waves.more")
"""Factor on the error, and further error, of contacts outside the ranges of the laws of heat."""
MOST_WARMTH = 3.0
"""From which on the error does not grow."""
SMALL_CHANGE, SMALL_SHARE = 0.02, bar("warm_waves.small_change")
"""Change |R1 - R0| up to which the error has so much more of it."""


@cache
def fitted() -> Mapping[str, Sequence[float]]:
    """Return the coefficients of the study: ``kept``, c, f and g; ``error``, e1 and e2."""
    text = (files("ehlwave.laws") / "warm_waves.json").read_text(encoding="utf-8")
    found: Mapping[str, Sequence[float]] = json.loads(text)
    return found


def thinner(conditions: Conditions, film_factor: float) -> Conditions:
    """Return isothermal conditions whose film is so many times as thick, by their viscosity."""
    given = dict(conditions.given)
    given["viscosity_pa_s"] = to_float(given["viscosity_pa_s"]) * film_factor ** (1 / FILM_POWER)
    found = conditions_from_keys(given, needs_lengths=False)
    return replace(found, slip_parameter=conditions.slip_parameter)


def warm_ratio(
    cold: ArrayLike,
    thin: ArrayLike,
    warmth: ArrayLike,
    along: ArrayLike = 0.0,
    coefficients: Sequence[float] | Floats | None = None,
) -> Complex:
    """Return R by R0, R1, w and cos(theta), which is negative for waves of negative frequency.

    Examples
    --------
    >>> from ehlwave.laws.warm_waves import warm_ratio
    >>> complex(warm_ratio(0.8, 0.7, 0.0)).real
    0.7
    """
    c, f, g = np.abs(fitted()["kept"] if coefficients is None else coefficients)
    first, last = (np.asarray(value, dtype=np.complex128) for value in (cold, thin))
    w = np.asarray(warmth)
    lag = 1 + 1j * f * np.asarray(along) / (1 + g * w)
    return np.asarray(first + (last - first) * lag / (1 + c * w))


def warm_error(
    change: ArrayLike, warmth: ArrayLike, coefficients: Sequence[float] | Floats | None = None
) -> Floats:
    """Return the error of R besides the error of R1, by the size of R1 - R0 and w."""
    e = fitted()["error"] if coefficients is None else coefficients
    size = np.abs(change)
    small = SMALL_SHARE * np.minimum(size, SMALL_CHANGE)
    return np.asarray(e[0] * size + small + e[1] * np.minimum(warmth, MOST_WARMTH))


def warmth_of(film: Film, heat: Heat, slip: float) -> float:
    """Return w of a contact with heat.

    Raises
    ------
    RangeError
        Under slip in an oil whose rise is not known.
    """
    if slip == 1 or film.heated is None:
        return 0.0
    rise = film.heated.rise_mid_film_k
    if not rise:  # computed films of other oils have it, laws do not
        raise RangeError(
            "responses under slip with heat need a Ree-Eyring oil (eyring_stress_pa), or compute "
            "the contact with ehlwave-case, &heat wave_temperatures = 'carried'"
        )
    return to_float(heat.viscosity_temperature_per_k * rise)


@dataclass(frozen=True)
class WarmTransfer(OfTwo):
    """Transfer of a warm contact from both isothermal contacts."""

    cold: Transfer
    thin: Transfer
    warmth: float
    error_factor: float = 1.0
    more_error: float = 0.0

    @property
    def name(self) -> str:
        """Return its description."""
        return f"{self.cold.name}, with the law of warm waves"

    @property
    def parts(self) -> tuple[Transfer, Transfer]:
        """Return both isothermal transfers."""
        return self.cold, self.thin

    @property
    def smooth_from(self) -> float:
        """Waves per metre from which on both are smooth."""
        return max(part.smooth_from for part in self.parts)

    def ratio(self, per_length_x: Waves, per_length_y: Waves) -> Complex:
        """Return the transfer for waves per metre along x (any sign) and y (not negative)."""
        cold, thin = (one.ratio(per_length_x, per_length_y) for one in self.parts)
        length = np.hypot(per_length_x, per_length_y)
        along = per_length_x / np.where(length > 0, length, 1.0)
        return warm_ratio(cold, thin, self.warmth, along if self.has_phase else 0.0)

    def pressure(self, per_length_x: Waves, per_length_y: Waves) -> Complex:
        """Return the pressure transfer, in units of ph/c; NaN where it is not known."""
        cold, thin = (one.pressure(per_length_x, per_length_y) for one in self.parts)
        return warm_ratio(cold, thin, self.warmth)

    def rise(self, per_length_x: Waves, per_length_y: Waves) -> Waves | None:
        """Return the rise of the mean film by waves in the contact with the thinner oil."""
        return self.thin.rise(per_length_x, per_length_y)

    def error(self, per_length_x: Waves, per_length_y: Waves) -> Waves | None:
        """Return the absolute error of the transfer; None if that is not known."""
        own = self.thin.error(per_length_x, per_length_y)
        if own is None:
            return None
        both = [one.ratio(per_length_x, per_length_y) for one in self.parts]
        waves = np.hypot(per_length_x, per_length_y) > 0  # the mean is not deformed
        warm = self.error_factor * warm_error(both[1] - both[0], self.warmth) + self.more_error
        return np.asarray(own + waves * warm)
