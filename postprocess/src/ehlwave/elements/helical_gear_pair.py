"""Helical gear pairs: normal section and overlap."""

from __future__ import annotations

from ehlwave.elements.gear_pair import GearPair


class HelicalGearPair(GearPair):
    """A pair of external helical gears.

    Radii belong to the section normal to the contact lines, s/cos(beta_b) and (N - s)/cos(beta_b).
    Speeds belong to the transverse section: the direction of sliding and rolling, normal to the
    plane of action, is normal to the contact lines, too. With an overlap ratio of 1 or more the
    load per length is the mean one, F_t/(b eps_alpha); below, it is weighted with the load of spur
    gears (:mod:`ehlwave.elements.involute`).

    Assumptions: as :class:`SpurGearPair`; the load is even along the contact lines, whose total
    length counts as constant.

    Parameters
    ----------
    module_m : float
        Normal module.
    teeth : pair of int
        Of pinion and wheel.
    face_width_m : float
        Width that bears load.
    helix_angle_deg : float
        At the reference circle.
    pressure_angle_deg : float
        Normal pressure angle of the basic rack.
    profile_shift : pair of float
        Profile shift coefficients, of the normal module.
    centre_distance_m, addendum, material, elastic_modulus_pa, poisson_ratio
        As of :class:`SpurGearPair`.

    Examples
    --------
    >>> from ehlwave.elements import HelicalGearPair
    >>> gears = HelicalGearPair(module_m=0.003, teeth=(20, 40), face_width_m=0.03,
    ...     helix_angle_deg=20)
    >>> print(f"contact ratio {gears.geometry.contact_ratio:.2f}")
    contact ratio 1.50
    """

    def __init__(
        self,
        *,
        module_m: float,
        teeth: tuple[int, int],
        face_width_m: float,
        helix_angle_deg: float,
        pressure_angle_deg: float = 20.0,
        profile_shift: tuple[float, float] = (0.0, 0.0),
        centre_distance_m: float | None = None,
        addendum: float = 1.0,
        material: str | tuple[str, str] = "steel",
        elastic_modulus_pa: float | None = None,
        poisson_ratio: float | None = None,
    ) -> None:
        """Check the dimensions."""
        given = {key: value for key, value in locals().items() if key not in ("self", "__class__")}
        self._take(given, helix_angle_deg)
