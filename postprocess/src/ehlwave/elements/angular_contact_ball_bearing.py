"""Angular contact ball bearings: thrust, or thrust with a radial load."""

from __future__ import annotations

from ehlwave.elements.ball_bearing import BallBearing
from ehlwave.elements.given import RADIANS, above
from ehlwave.errors import SurfaceError


class AngularContactBallBearing(BallBearing):
    """A single-row angular contact ball bearing.

    Under thrust alone F = Z K sin(alpha) [A (cos(alpha_0)/cos(alpha) - 1)]^(3/2) with
    A = (f_i + f_o - 1) D_w (Harris and Kotzalas, *Essential Concepts of Bearing Technology*,
    chapter 7); with a radial load the equilibrium of ISO 16281:2008. Radii: gamma has the contact
    angle under load. K belongs to the angle without load.

    Assumptions: as :class:`DeepGrooveBallBearing`; each ball rolls at its own contact angle; films
    and powers leave spin out (:meth:`spin_to_roll_ratio`).

    Parameters
    ----------
    ball_diameter_m, pitch_diameter_m : float
        D_w and d_m.
    balls : int
        Number of balls.
    contact_angle_deg : float
        Without load, such as 15, 25 or 40.
    conformity : pair of float
        Groove radius over ball diameter, inner and outer ring.
    material : str
        Of rings and balls.
    elastic_modulus_pa, poisson_ratio : float, optional
        In place of the material's.

    Examples
    --------
    The 218 of Harris under 17.8 kN:

    >>> from ehlwave.elements import AngularContactBallBearing
    >>> bearing = AngularContactBallBearing(ball_diameter_m=0.02223, pitch_diameter_m=0.12526,
    ...     balls=16, contact_angle_deg=40, conformity=0.5232)
    >>> loads, angles = bearing.load_zone(axial_load_n=17800).loads_at(0)
    >>> print(f"{float(angles):.1f} degrees")
    41.5 degrees
    """

    def __init__(
        self,
        *,
        ball_diameter_m: float,
        pitch_diameter_m: float,
        balls: int,
        contact_angle_deg: float,
        conformity: tuple[float, float] | float = (0.52, 0.53),
        material: str = "steel",
        elastic_modulus_pa: float | None = None,
        poisson_ratio: float | None = None,
    ) -> None:
        """Check the dimensions."""
        name = type(self).__name__
        elastic = (material, elastic_modulus_pa, poisson_ratio)
        self._take(ball_diameter_m, pitch_diameter_m, balls, conformity, elastic)
        self.free_angle_deg = above(contact_angle_deg, "contact_angle_deg", name, RADIANS, "25")
        if not self.free_angle_deg < 75:
            raise SurfaceError(
                f"{name}: contact_angle_deg = {self.free_angle_deg:g} must be below 75"
            )
