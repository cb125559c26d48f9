"""Spur gear pairs: from catalogue data to the contacts along the path."""

from __future__ import annotations

from ehlwave.elements.gear_pair import GearPair


class SpurGearPair(GearPair):
    """A pair of external spur gears.

    Geometry and load sharing: :mod:`ehlwave.elements.involute`. Radii at the distance s from the
    base tangent point of the pinion are s and N - s, speeds omega_1 s and omega_2 (N - s).

    Assumptions: unmodified flanks without errors; the load is even over the width; each place is
    steady, as if load and speeds had always been so (squeeze is left out).

    Parameters
    ----------
    module_m : float
        Module.
    teeth : pair of int
        Of pinion and wheel.
    face_width_m : float
        Width that bears load.
    pressure_angle_deg : float
        Of the basic rack.
    profile_shift : pair of float
        Profile shift coefficients of pinion and wheel.
    centre_distance_m : float, optional
        Without it the flanks mesh without backlash.
    addendum : float
        Of the basic rack, over the module; tips are shortened by the profile shift.
    material : str or pair of str
        Of pinion and wheel.
    elastic_modulus_pa, poisson_ratio : float, optional
        In place of the material's.

    Examples
    --------
    The FZG pair of type C:

    >>> import ehlwave
    >>> from ehlwave.elements import SpurGearPair
    >>> gears = SpurGearPair(module_m=0.0045, teeth=(16, 24), face_width_m=0.014,
    ...     profile_shift=(0.1817, 0.1715), centre_distance_m=0.0915)
    >>> print(f"contact ratio {gears.geometry.contact_ratio:.3f}")
    contact ratio 1.438
    >>> oil = ehlwave.Oil.from_grade(iso_vg=100, viscosity_index=95, temperature_k=363.15,
    ...     eyring_stress_pa=5e6)
    >>> found = gears.along_path(pinion_torque_n_m=70, pinion_speed_rpm=2250, oil=oil, points=3)
    >>> (found["slide_to_roll_ratio"].values + 0.0).round(2).tolist()
    [-1.28, 0.01, 1.03]
    >>> (found["hertz_pressure_pa"].values * 1e-9).round(2).tolist()
    [0.67, 0.8, 0.48]
    """

    def __init__(
        self,
        *,
        module_m: float,
        teeth: tuple[int, int],
        face_width_m: float,
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
        self._take(given, 0.0)
