"""Two discs on parallel axes."""

from __future__ import annotations

import math

from ehlwave.contact.bodies import FLAT, Body
from ehlwave.elements.given import above, pair
from ehlwave.elements.material import both_elastic
from ehlwave.elements.test_rig import TestRig
from ehlwave.errors import SurfaceError


class TwoDisc(TestRig):
    """Two discs that are loaded against each other, a line contact, or a point with a crown.

    1/Rx = 2/d_1 + 2/d_2. Speeds are pi d n.

    Assumptions: axes are parallel; the load is even over the width; a crown is of the first disc.

    Parameters
    ----------
    diameters_m : pair of float
        Of both discs.
    width_m : float, optional
        Of the line contact; needed without a crown.
    crown_radius_m : float, optional
        Radius across of the first disc.
    material : str or pair of str
        Of both discs.
    elastic_modulus_pa, poisson_ratio : float, optional
        In place of the materials'.

    Examples
    --------
    >>> import ehlwave
    >>> from ehlwave.elements import TwoDisc
    >>> rig = TwoDisc(diameters_m=(0.08, 0.08), width_m=0.005)
    >>> oil = ehlwave.Oil(viscosity_pa_s=0.02, pressure_viscosity_per_pa=2e-8)
    >>> place = rig.contact_at(load_n=2000, mean_speed_m_per_s=4, oil=oil)
    >>> print(f"{place.hertz_pressure_pa / 1e9:.2f} GPa")
    0.85 GPa
    """

    def __init__(
        self,
        *,
        diameters_m: tuple[float, float],
        width_m: float | None = None,
        crown_radius_m: float | None = None,
        material: str | tuple[str, str] = "steel",
        elastic_modulus_pa: float | None = None,
        poisson_ratio: float | None = None,
    ) -> None:
        """Check the dimensions."""
        name = type(self).__name__
        first, second = (
            above(one, "diameters_m", name, example="0.08")
            for one in pair(diameters_m, "diameters_m", name)
        )
        own, other = both_elastic(material, elastic_modulus_pa, poisson_ratio, name)
        crown = FLAT
        if crown_radius_m is not None:
            crown = above(crown_radius_m, "crown_radius_m", name, example="0.5")
        else:
            if width_m is None:
                raise SurfaceError(f"{name}: width_m is missing: give it, or crown_radius_m")
            self.length_m = above(width_m, "width_m", name, example="0.01")
        self.diameters_m = (first, second)
        self.bodies = (Body(first / 2, crown, **own), Body(second / 2, **other))

    def speeds_m_per_s(self, speeds_rpm: tuple[float, float]) -> tuple[float, float]:
        """Return mean speed and slide-to-roll ratio of both shaft speeds.

        Parameters
        ----------
        speeds_rpm : pair of float
            Of both shafts.
        """
        given = pair(speeds_rpm, "speeds_rpm", type(self).__name__)
        first, second = (math.pi * d * n / 60 for d, n in zip(self.diameters_m, given, strict=True))
        mean = (first + second) / 2
        if mean == 0:
            raise SurfaceError(
                f"TwoDisc: speeds_rpm = {speeds_rpm} draw no oil in: their mean surface speed is 0"
            )
        return mean, (first - second) / mean
