"""Waves in warm contacts: isothermal responses with an error that covers heat."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ehlwave.laws.transfer import Transfer, Waves

if TYPE_CHECKING:
    from ehlwave.laws.asked import Asked

WARM_SHARE = 0.25
"""Largest change of Ad/Ai by heat over Ad/Ai at a slide-to-roll ratio of 1: marches with carried
temperatures (ball 12.5 mm, 60 N, 4 m/s, tau0 = 5 MPa, 0.7 a) give 0.704 where the isothermal
response is 0.833, a change of 0.155."""
ROLLING_SHARE = 0.02
"""Change in pure rolling, where the film is nearly as warm as the surfaces."""


class WarmWaves:
    """A transfer without heat, for a contact with heat: its error covers the heat of sliding."""

    has_phase = True

    def __init__(self, isothermal: Transfer, asked: Asked) -> None:
        """Take the isothermal transfer of a warm contact."""
        self.isothermal = isothermal
        self._ratio = abs(2 * (asked.conditions.slip_parameter - 1))

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401
        """Return everything else from the isothermal transfer."""
        if name == "isothermal":
            raise AttributeError(name)
        return getattr(self.isothermal, name)

    @property
    def name(self) -> str:
        """Return its description."""
        return f"{self.isothermal.name}, without the heat of the film (in the error)"

    def error(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.float64] | None:
        """Return the isothermal error and the largest change by heat."""
        own = self.isothermal.error(per_length_x, per_length_y)
        if own is None:
            return None
        size = np.abs(self.isothermal.ratio(per_length_x, per_length_y))
        share = ROLLING_SHARE + WARM_SHARE * min(self._ratio, 1.0)
        return np.asarray(own + share * size * (2 - size).clip(0.0))
