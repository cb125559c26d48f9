"""Deep groove ball bearings: from inner dimensions or boundary dimensions to contacts."""

from __future__ import annotations

from ehlwave.elements.ball_bearing import BallBearing
from ehlwave.elements.boundary import ball_inside
from ehlwave.elements.given import clearance_of


class DeepGrooveBallBearing(BallBearing):
    """A single-row deep groove ball bearing.

    Radii: Rx = (D_w/2)(1 -+ gamma), gamma = D_w/d_m, 1/Ry = 2/D_w - 1/(f D_w). Loads: the
    equilibrium of the inner ring, K (d cos - s/2)^(3/2), ISO 16281:2008. Speeds: no slip.

    ISO 16281 leaves out the centrifugal force; ``has_centrifugal_load=True`` adds it.

    Assumptions: rings keep their form; a ball lies in the direction of the load; both surfaces of a
    contact have the same speed, so that friction by the curvature of the groove and by spin is left
    out; gyroscopic moments are left out.

    Parameters
    ----------
    ball_diameter_m, pitch_diameter_m : float
        D_w and d_m.
    balls : int
        Number of balls.
    conformity : pair of float
        Groove radius over ball diameter, inner and outer ring.
    clearance_m : float
        Radial internal clearance, of the diameter; negative: preload.
    material : str
        Of rings and balls.
    elastic_modulus_pa, poisson_ratio : float, optional
        In place of the material's.

    Examples
    --------
    The bearing of ISO 16281 that public programs use as an example:

    >>> import ehlwave
    >>> from ehlwave.elements import DeepGrooveBallBearing
    >>> bearing = DeepGrooveBallBearing(ball_diameter_m=0.0115, pitch_diameter_m=0.0435, balls=7,
    ...     elastic_modulus_pa=2.1e11)
    >>> print(f"{bearing.load_zone(radial_load_n=1000).radial_m * 1e6:.4f} um")
    15.1102 um

    Films over the load zone of both rings:

    >>> oil = ehlwave.Oil.from_grade(iso_vg=68, viscosity_index=95, temperature_k=343.15)
    >>> found = bearing.over_load_zone(radial_load_n=1000, inner_speed_rpm=3000, oil=oil, points=3)
    >>> found["central_film_m"].sel(ring="inner").values.round(8).tolist()
    [2.8e-07, 2e-07, 2.8e-07]
    """

    def __init__(
        self,
        *,
        ball_diameter_m: float,
        pitch_diameter_m: float,
        balls: int,
        conformity: tuple[float, float] = (0.52, 0.53),
        clearance_m: float = 0.0,
        material: str = "steel",
        elastic_modulus_pa: float | None = None,
        poisson_ratio: float | None = None,
    ) -> None:
        """Check the dimensions."""
        elastic = (material, elastic_modulus_pa, poisson_ratio)
        self._take(ball_diameter_m, pitch_diameter_m, balls, conformity, elastic)
        self.clearance_m = clearance_of(clearance_m, self.element_diameter_m, type(self).__name__)

    @classmethod
    def from_boundary(
        cls,
        *,
        bore_m: float,
        outside_m: float,
        width_m: float,
        conformity: tuple[float, float] = (0.52, 0.53),
        clearance_m: float = 0.0,
        material: str = "steel",
    ) -> DeepGrooveBallBearing:
        """Return the bearing of boundary dimensions, as of a catalogue.

        Inner dimensions are estimated by :func:`ehlwave.elements.boundary.ball_inside`. Errors of
        films have a part by them, ``inside_error``.

        Parameters
        ----------
        bore_m, outside_m, width_m : float
            d, D and B of the catalogue.
        conformity, clearance_m, material
            As of the class.

        Examples
        --------
        A 6208:

        >>> from ehlwave.elements import DeepGrooveBallBearing
        >>> bearing = DeepGrooveBallBearing.from_boundary(bore_m=0.04, outside_m=0.08,
        ...     width_m=0.018)
        >>> print(f"{bearing.elements} balls of {bearing.element_diameter_m * 1e3:.1f} mm")
        9 balls of 12.0 mm
        """
        inside = ball_inside(bore_m, outside_m, width_m, cls.__name__)
        others = {"conformity": conformity, "clearance_m": clearance_m, "material": material}
        bearing = cls(**inside.arguments(), **others)  # type: ignore[arg-type]
        bearing.inside_errors = inside.errors
        bearing.variants = tuple(
            cls(**changed | {key: value for key, value in others.items() if key not in changed})  # type: ignore[arg-type]
            for changed in inside.varied(conformity)
        )
        return bearing
