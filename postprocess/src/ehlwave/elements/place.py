"""A contact of a machine element: place, bodies, load and speeds."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from ehlwave.contact.bodies import Body
from ehlwave.contact.data_sheet import Oil
from ehlwave.contact.equality import equal_fields
from ehlwave.elements.hertz import hertz_line, hertz_point, reduced_modulus, reduced_radius
from ehlwave.error_bars import bar
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.operating_point import Contact
from ehlwave.shown import percent

ROUND_OFF = 1e-12
"""Difference of the speeds over their mean below which both are equal."""
ASSUMED_EYRING_PA, ASSUMED_EYRING_ERROR = 5e6, bar("oil.eyring")
"""Eyring stress of oils without a flow law under slip and heat, with its relative error: mineral
oils and PAO have 3 to 6 MPa (page of oils)."""
ASSUMED = (
    "friction, temperatures and stress take an assumed Eyring stress of "
    f"{ASSUMED_EYRING_PA * 1e-6:g} MPa within {percent(ASSUMED_EYRING_ERROR)}, since the oil has "
    "no flow law: give the oil its own eyring_stress_pa"
)
STATIC_PA, MOST_PA = 4e9, 2e10
"""Hertz pressures that hard steel bears without lasting dents (ISO 76: rollers 4, balls 4.2 GPa),
and that no material bears: a wrong unit."""
STILL = 1e-4
"""Speed of a surface over the speed of the other below which its direction does not count."""


@dataclass(frozen=True)
class ElementContact:
    """A contact of an element.

    Attributes
    ----------
    bodies : pair of Body
        The rough body first: the race, the pinion, the cam.
    oil : Oil
        At the temperature of the inlet.
    speeds_m_per_s : pair of float
        Speeds of both surfaces relative to the contact.
    load_n : float
        Load of the contact.
    length_m : float or None
        Length of a line contact; None: a point contact.
    angle_deg : float
        Angle of the place in the element; NaN where a place is not known by an angle.
    name : str
        Name of the place.
    others : mapping
        Other numbers of the place, by the names of columns.
    options : mapping
        Options of :class:`ehlwave.Contact`, such as ``heat``.

    Examples
    --------
    >>> import ehlwave
    >>> from ehlwave.elements import BallOnDisc
    >>> oil = ehlwave.Oil(viscosity_pa_s=0.05, pressure_viscosity_per_pa=2e-8)
    >>> place = BallOnDisc(ball_diameter_m=0.01905).contact_at(load_n=20,
    ...     mean_speed_m_per_s=1, oil=oil)
    >>> print(f"{place.hertz_pressure_pa / 1e9:.2f} GPa")
    0.82 GPa
    """

    bodies: tuple[Body, Body]
    oil: Oil
    speeds_m_per_s: tuple[float, float]
    load_n: float
    length_m: float | None = None
    angle_deg: float = math.nan
    name: str = ""
    others: Mapping[str, float] = field(default_factory=dict)
    options: Mapping[str, Any] = field(default_factory=dict)
    __eq__ = equal_fields

    @property
    def radius_x_m(self) -> float:
        """Return the reduced radius along rolling."""
        return reduced_radius(self.bodies[0].radius_x_m, self.bodies[1].radius_x_m)

    @property
    def radius_y_m(self) -> float:
        """Return the reduced radius across; infinite of a line."""
        return reduced_radius(self.bodies[0].radius_y_m, self.bodies[1].radius_y_m)

    @property
    def load_n_per_m(self) -> float:
        """Return the load per length of a line; NaN of a point."""
        return math.nan if self.length_m is None else self.load_n / self.length_m

    @property
    def assumes_eyring(self) -> bool:
        """Return whether the surfaces slide in an oil without a flow law."""
        return self.slide_to_roll_ratio != 0 and self.oil.eyring_stress_pa is None

    @property
    def flow_oil(self) -> Oil:
        """Return the oil, under slip with an Eyring stress: its own, or the assumed one.

        Contacts with heat take it: without a limit of the shear stress, friction and temperatures
        at pressures of 1 GPa are not known.
        """
        if not self.assumes_eyring:
            return self.oil
        return replace(
            self.oil, eyring_stress_pa=ASSUMED_EYRING_PA, eyring_stress_error=ASSUMED_EYRING_ERROR
        )

    @property
    def mean_speed_m_per_s(self) -> float:
        """Return the mean of both speeds, which draws the oil in; below 0 where it is reversed."""
        return sum(self.speeds_m_per_s) / 2

    @property
    def slide_to_roll_ratio(self) -> float:
        """Return (u1 - u2) over the mean speed; infinite where no oil is drawn in.

        Speeds that differ by round-off are equal: 0.
        """
        first, second = self.speeds_m_per_s
        mean = self.mean_speed_m_per_s
        if mean == 0:
            return math.inf
        ratio = (first - second) / mean
        return ratio if abs(ratio) > ROUND_OFF else 0.0

    @property
    def is_opposite(self) -> bool:
        """Return whether the surfaces move in opposite directions past the contact.

        A speed below :data:`STILL` of the other counts as 0: lift tables leave such speeds in
        dwells.
        """
        slow, fast = sorted(self.speeds_m_per_s, key=abs)
        return slow * fast < 0 and abs(slow) > STILL * abs(fast)

    @cached_property
    def _hertz(self) -> tuple[float, float]:
        modulus = reduced_modulus(*self.bodies)
        if self.length_m is not None:
            return hertz_line(self.load_n_per_m, self.radius_x_m, modulus)
        found = hertz_point(self.load_n, self.radius_x_m, self.radius_y_m, modulus)
        return found.semi_axis_x_m, found.pressure_pa

    @property
    def semi_axis_a_m(self) -> float:
        """Return the Hertz semi-axis along rolling."""
        return self._hertz[0]

    @property
    def hertz_pressure_pa(self) -> float:
        """Return the largest Hertz pressure."""
        return self._hertz[1]

    @cached_property
    def contact(self) -> Contact:
        """Return the contact, which answers for film, friction, roughness and stress.

        Raises
        ------
        RangeError
            A ValueError: the surfaces move in opposite directions, or the contact lies outside the
            ranges of its options.
        """
        return self.contact_with(self.options)

    def contact_with(self, options: Mapping[str, Any]) -> Contact:
        """Return the contact with other options of :class:`ehlwave.Contact`.

        Parameters
        ----------
        options : mapping
            In place of its own.
        """
        if not isinstance(self.oil, Oil):
            raise SurfaceError(f"oil = {self.oil!r:.60} is no ehlwave.Oil")
        first, second = self.speeds_m_per_s
        if first == second == 0:
            raise RangeError("both surfaces stand still past the contact, which draws no oil in")
        if self.is_opposite or first + second == 0:
            raise RangeError(
                f"surface speeds of {first:.4g} and {second:.4g} m/s: the surfaces move in "
                "opposite directions past the contact, which no law and no case covers "
                "(slide_to_roll_ratio of -2 to 2)"
            )
        if self.hertz_pressure_pa > MOST_PA:
            raise SurfaceError(
                f"a load of {self.load_n:.4g} N makes a Hertz pressure of "
                f"{self.hertz_pressure_pa * 1e-9:.3g} GPa in a contact, where hard steel bears "
                "4 GPa (ISO 76): check loads, dimensions and their units"
            )
        if self.slide_to_roll_ratio == 0:
            first = second = self.mean_speed_m_per_s
        sign = math.copysign(1.0, first + second)
        given: dict[str, Any] = {"load_n": self.load_n}
        if self.length_m is not None:
            given["length_m"] = self.length_m
        given |= {key: value for key, value in options.items() if value is not None}
        return Contact.from_bodies(
            *self.bodies,
            oil=self.flow_oil if options.get("heat") else self.oil,
            speeds_m_per_s=(max(first * sign, 0.0), max(second * sign, 0.0)),
            **given,
        )
