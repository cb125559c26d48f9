"""Common parts of roller bearings: lines, and stiffness by ISO 16281."""

from __future__ import annotations

from typing import Any

from ehlwave.elements.bearing import RollingBearing
from ehlwave.elements.given import above, elements_of
from ehlwave.elements.hertz import reduced_modulus
from ehlwave.elements.load_zone import ROLLER_POWER
from ehlwave.elements.material import elastic_of

ISO_STIFFNESS = 35948.0
"""c_L of steel over L^(8/9), N and mm: both contacts of a roller in series, ISO 16281:2008."""
ISO_MODULUS_PA = 2.1e11 / (1 - 0.3**2)


class RollerBearing(RollingBearing):
    """A single-row roller bearing; subclasses define the cone angles."""

    roller_length_m: float
    """Effective length."""
    power = ROLLER_POWER

    def _take(self, given: dict[str, Any]) -> None:
        """Check and keep the arguments of all roller bearings."""
        name = type(self).__name__
        size = (given["roller_diameter_m"], given["pitch_diameter_m"], given["rollers"])
        found = elements_of("roller", *size, name)
        self.element_diameter_m, self.pitch_diameter_m, self.elements = found
        self.roller_length_m = above(
            given["roller_length_m"], "roller_length_m", name, example="0.012"
        )
        self.elastic = elastic_of(
            given["material"], given["elastic_modulus_pa"], given["poisson_ratio"]
        )

    def length_m(self) -> float:
        """Return the length of the contacts."""
        return self.roller_length_m

    @property
    def stiffnesses(self) -> tuple[float, float]:
        """Return the stiffness of both contacts, N/m^(10/9), which share the approach evenly.

        Both in series have c_L in proportion to E'.
        """
        modulus = reduced_modulus(*self.bodies("inner", 0.0))
        iso = ISO_STIFFNESS * (1e3 * self.roller_length_m) ** (8 / 9) * 1e3**ROLLER_POWER
        own = float(iso * modulus / ISO_MODULUS_PA * 2**ROLLER_POWER)
        return own, own
