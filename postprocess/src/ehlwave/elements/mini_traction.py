"""The mini traction machine: a ball of 3/4 inch on a disc of 46 mm."""

from __future__ import annotations

import math

from ehlwave.elements.ball_on_disc import BallOnDisc
from ehlwave.elements.given import above

BALL_M, TRACK_M = 0.01905, 0.042
"""Diameters of the ball and of the track on the disc (from memory of the maker's data sheet)."""


class MiniTraction(BallOnDisc):
    """A mini traction machine with steel specimens.

    The maker's data sheet states 1.25 GPa at 75 N (from memory); Hertz with E = 207 GPa and
    nu = 0.29 gives 1.27 GPa.

    Assumptions: as of :class:`BallOnDisc`.

    Parameters
    ----------
    ball_diameter_m, track_diameter_m : float
        Of ball and track.
    material : str or pair of str
        Of ball and disc.
    elastic_modulus_pa, poisson_ratio : float
        Of both.

    Examples
    --------
    >>> import ehlwave
    >>> from ehlwave.elements import MiniTraction
    >>> oil = ehlwave.Oil(viscosity_pa_s=0.02, pressure_viscosity_per_pa=2e-8)
    >>> place = MiniTraction().contact_at(load_n=75, mean_speed_m_per_s=2, oil=oil)
    >>> print(f"{place.hertz_pressure_pa / 1e9:.2f} GPa")
    1.27 GPa
    """

    def __init__(
        self,
        *,
        ball_diameter_m: float = BALL_M,
        track_diameter_m: float = TRACK_M,
        material: str | tuple[str, str] = "steel",
        elastic_modulus_pa: float | None = 2.07e11,
        poisson_ratio: float | None = 0.29,
    ) -> None:
        """Check the dimensions."""
        super().__init__(
            ball_diameter_m=ball_diameter_m,
            material=material,
            elastic_modulus_pa=elastic_modulus_pa,
            poisson_ratio=poisson_ratio,
        )
        place = type(self).__name__
        self.track_diameter_m = above(track_diameter_m, "track_diameter_m", place, example="0.042")

    def disc_speed_rpm(self, mean_speed_m_per_s: float, slide_to_roll_ratio: float = 0.0) -> float:
        """Return the speed of the disc.

        Parameters
        ----------
        mean_speed_m_per_s, slide_to_roll_ratio : float
            As of :meth:`contact_at`.
        """
        speed = mean_speed_m_per_s * (1 - slide_to_roll_ratio / 2)
        return 60 * speed / (math.pi * self.track_diameter_m)
