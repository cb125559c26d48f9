"""A ball on a flat disc."""

from __future__ import annotations

from ehlwave.contact.bodies import Body
from ehlwave.elements.given import above
from ehlwave.elements.material import both_elastic
from ehlwave.elements.test_rig import TestRig


class BallOnDisc(TestRig):
    """A ball that is loaded against a flat disc, both driven.

    Rx = Ry = d/2. The ball is the first body: traces are of the ball.

    Assumptions: no spin; the track is straight, as its radius is large against the contact. Some
    texts state the sum of both speeds as entrainment: here it is the mean.

    Parameters
    ----------
    ball_diameter_m : float
        Diameter of the ball.
    material : str or pair of str
        Of ball and disc.
    elastic_modulus_pa, poisson_ratio : float, optional
        In place of the materials'.

    Examples
    --------
    >>> import ehlwave
    >>> from ehlwave.elements import BallOnDisc
    >>> rig = BallOnDisc(ball_diameter_m=0.01905, material=("steel", "glass"))
    >>> oil = ehlwave.Oil.from_grade(iso_vg=100, viscosity_index=95, temperature_k=313.15)
    >>> found = rig.over_speeds(load_n=20, mean_speeds_m_per_s=[0.1, 1], oil=oil)
    >>> (found["central_film_m"].values * 1e9).round(-1).tolist()
    [90.0, 450.0]
    """

    def __init__(
        self,
        *,
        ball_diameter_m: float,
        material: str | tuple[str, str] = "steel",
        elastic_modulus_pa: float | None = None,
        poisson_ratio: float | None = None,
    ) -> None:
        """Check the dimensions."""
        diameter = above(ball_diameter_m, "ball_diameter_m", type(self).__name__, example="0.01905")
        constants = (elastic_modulus_pa, poisson_ratio)
        ball, disc = both_elastic(material, *constants, type(self).__name__)
        self.bodies = (Body.ball(diameter, **ball), Body(**disc))
