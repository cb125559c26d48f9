"""Transfer of starved contacts: Ad/Ai of each harmonic component by the law of starved contacts."""

from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.starvation import (
    OIL_OVER_FLOODED,
    UNDER_SLIP,
    WAVES_TEXT,
    check_waves,
    film_over_flooded,
    is_fitted,
    ratio_error,
    starved_ratio,
)
from ehlwave.duals import np
from ehlwave.errors import RangeError
from ehlwave.laws.transfer import EXTRAPOLATED, Transfer, Waves


def check_starved(conditions: Conditions) -> None:
    """Raise RangeError where the law of starved contacts has no film."""
    c = conditions
    if not c.rolls:
        raise RangeError(UNDER_SLIP)
    if c.is_line:
        raise RangeError(
            f"{OIL_OVER_FLOODED} of a line contact: the law of starved contacts was fitted to "
            "elliptical ones, D of 0.1 to 1"
        )
    if c.oil_over_flooded is not None:
        film_over_flooded(c.oil_over_flooded, c.m, c.l, c.d)


@dataclass(frozen=True)
class StarvedTransfer(Transfer):
    """Ad/Ai of :func:`ehlwave.contact.starvation.starved_ratio`: real, no phase, pure rolling.

    Waves that the law was not fitted to are continued by its form. Their error is as large as the
    continuation: the loss of shorter waves, the rest of longer waves.

    Raises RangeError (a ValueError) if R, M, L or D lies outside the range of the law, the contact
    slides, or the oil has other laws of viscosity or density than the contacts of the fit.
    """

    conditions: Conditions
    has_phase = False

    def __post_init__(self) -> None:
        """Refuse contacts that the law was not fitted to."""
        c = self.conditions
        check_starved(c)
        if c.oil.other_laws:
            laws = ", ".join(c.oil.other_laws)
            raise RangeError(f"{laws}: the law of starved contacts was fitted with Roelands' oil")
        check_waves(c.film_ratio, c.m, c.l, c.d)

    @property
    def name(self) -> str:
        """Return its description."""
        return f"law of starved contacts, R = {self.conditions.film_ratio:.3g}"

    @property
    def outside_reason(self) -> str:
        """Why components are not covered."""
        return f"outside the law of starved contacts ({WAVES_TEXT}){EXTRAPOLATED}"

    def ratio(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[Any]:
        """Return Ad/Ai for waves per metre along x and y; 0 for the mean."""
        c = self.conditions
        found = starved_ratio(
            c.film_ratio, c.m, c.l, c.gamma, *self._waves(*self._both(per_length_x, per_length_y))
        )
        return np.where(self._is_mean(per_length_x, per_length_y), 0.0, found)

    def error(self, per_length_x: Waves, per_length_y: Waves) -> Waves:
        """Return the error of Ad/Ai, absolute: error of the law, and the continuation."""
        c = self.conditions
        both = self._both(per_length_x, per_length_y)
        error = ratio_error(c.film_ratio, c.m, c.l, c.gamma, *self._waves(*both))
        ratio = self.ratio(*both)
        is_short = np.hypot(*both) * c.semi_axis_a_m > 1
        continued = np.where(is_short, np.abs(1 - ratio), np.abs(ratio))
        error = np.where(self.is_covered(*both), error, error + continued)
        return np.where(self._is_mean(*both), 0.0, error)

    def is_covered(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.bool_]:
        """Return whether the fit covers a wave."""
        along, across = self._both(per_length_x, per_length_y)
        with np.errstate(divide="ignore"):
            wave = 1 / (np.hypot(along, across) * self.conditions.semi_axis_a_m)
        return is_fitted(wave, np.degrees(np.arctan2(across, along)))

    @staticmethod
    def _both(per_length_x: Waves, per_length_y: Waves) -> tuple[Waves, Waves]:
        along, across = np.broadcast_arrays(np.abs(per_length_x), np.abs(per_length_y))
        return along, across

    def _waves(self, along: Waves, across: Waves) -> list[Waves]:
        """Return wavelengths over a; zero for infinite wavelengths."""
        a_m = self.conditions.semi_axis_a_m
        with np.errstate(divide="ignore"):
            return [np.where(q > 0, 1 / (q * a_m), 0.0) for q in (along, across)]

    @staticmethod
    def _is_mean(per_length_x: Waves, per_length_y: Waves) -> NDArray[np.bool_]:
        return np.asarray((np.abs(per_length_x) == 0) & (np.abs(per_length_y) == 0))
