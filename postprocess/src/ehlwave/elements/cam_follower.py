"""Cam and follower, flat or with a roller: over one turn of the cam."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.bodies import FLAT, Body
from ehlwave.contact.data_sheet import Oil
from ehlwave.elements.answers import Questions
from ehlwave.elements.cam_motion import CamMotion, periodic
from ehlwave.elements.given import above, at_least, count
from ehlwave.elements.material import both_elastic
from ehlwave.elements.place import ElementContact
from ehlwave.elements.rolling_resistance import LINE_ERROR
from ehlwave.elements.table import sliding_error, table_of, unanswered, worst_places
from ehlwave.errors import SurfaceError

Floats = NDArray[np.float64]


class CamFollower(CamMotion):
    """A cam on a flat follower, or on a roller that rolls without slip.

    Flat follower, lift l over the angle of the cam, derivatives by the angle: radius of curvature
    rho = r_b + l + l'', speeds past the contact omega rho of the cam and omega l'' of the follower,
    so that the entrainment is (omega/2)(r_b + l + 2 l''). Roller: with r = r_b + r_f + l the pitch
    curve has the radius (r^2 + r'^2)^(3/2)/(r^2 + 2 r'^2 - r r''), the cam r_f less; both surfaces
    pass the contact with rho omega (r^2 + 2 r'^2 - r r'')/(r^2 + r'^2). Norton, *Cam Design and
    Manufacturing Handbook* (2009), from memory; tests derive both from the motion of the surfaces.

    Load: spring preload, spring rate times lift and mass times acceleration, over the cosine of the
    pressure angle of a roller.

    Assumptions: a centred follower, rigid train, no friction in the load, no squeeze: each angle is
    steady. Where the surfaces of cam and flat follower move in opposite directions past the
    contact, or the entrainment is 0, there is no answer, and the table names the angles.

    Parameters
    ----------
    angle_deg, lift_m : array_like
        Lift over one turn of the cam, at even or uneven angles; the last angle need not repeat the
        first. A periodic cubic spline goes through them.
    base_radius_m : float
        Of the base circle, r_b.
    width_m : float
        Width of the contact.
    roller_radius_m : float, optional
        r_f; without, the follower is flat.
    preload_n, spring_rate_n_per_m, mass_kg : float
        Of spring and train.
    material : str or pair of str
        Of cam and follower.
    elastic_modulus_pa, poisson_ratio : float, optional
        In place of the materials'.

    Examples
    --------
    An eccentric circle, whose radius of curvature is its own:

    >>> import numpy as np
    >>> from ehlwave.elements import CamFollower
    >>> angle = np.arange(0, 360, 1.0)
    >>> lift = 0.004 * (1 - np.cos(np.radians(angle)))
    >>> cam = CamFollower(angle_deg=angle, lift_m=lift, base_radius_m=0.013, width_m=0.01,
    ...     preload_n=200)
    >>> print(f"{float(cam.curvature_radius_m(60)) * 1e3:.3f} mm")
    17.000 mm
    """

    def __init__(
        self,
        *,
        angle_deg: ArrayLike,
        lift_m: ArrayLike,
        base_radius_m: float,
        width_m: float,
        roller_radius_m: float | None = None,
        preload_n: float = 0.0,
        spring_rate_n_per_m: float = 0.0,
        mass_kg: float = 0.0,
        material: str | tuple[str, str] = "steel",
        elastic_modulus_pa: float | None = None,
        poisson_ratio: float | None = None,
    ) -> None:
        """Check the dimensions and fit the lift."""
        name = type(self).__name__
        self._lift = periodic(angle_deg, lift_m, name)
        self.base_radius_m = above(base_radius_m, "base_radius_m", name, example="0.015")
        self.width_m = above(width_m, "width_m", name, example="0.01")
        self.roller_radius_m = (
            None
            if roller_radius_m is None
            else above(roller_radius_m, "roller_radius_m", name, example="0.009")
        )
        self.preload_n = at_least(preload_n, "preload_n", name)
        self.spring_rate_n_per_m = at_least(spring_rate_n_per_m, "spring_rate_n_per_m", name)
        self.mass_kg = at_least(mass_kg, "mass_kg", name)
        self.elastic = both_elastic(material, elastic_modulus_pa, poisson_ratio, name)

    def load_n(self, angle_deg: ArrayLike, cam_speed_rpm: float) -> Floats:
        """Return the load; 0 where the follower lifts off.

        Parameters
        ----------
        angle_deg, cam_speed_rpm
            As of :meth:`surface_speeds_m_per_s`.
        """
        lift, first, second = self._state(angle_deg)
        turn = 2 * math.pi / 60 * cam_speed_rpm
        load = self.preload_n + self.spring_rate_n_per_m * lift + self.mass_kg * turn**2 * second
        if self.roller_radius_m is not None:
            r = self.base_radius_m + self.roller_radius_m + lift
            load = load * np.hypot(1, first / r)
        return np.asarray(np.maximum(load, 0))

    def contact_at(
        self,
        angle_deg: float,
        *,
        cam_speed_rpm: float,
        oil: Oil,
        options: Mapping[str, Any] | None = None,
    ) -> ElementContact:
        """Return the contact at an angle of the cam.

        Parameters
        ----------
        angle_deg, cam_speed_rpm, oil
            Angle and speed of the cam, and the oil.
        options : mapping, optional
            Options of :class:`ehlwave.Contact`.

        Raises
        ------
        SurfaceError
            If the follower lifts off, or the cam is sharper than its follower allows.
        """
        name = type(self).__name__
        speed = above(cam_speed_rpm, "cam_speed_rpm", name, example="1000")
        load = float(self.load_n(angle_deg, speed))
        radius = float(self.curvature_radius_m(angle_deg))
        if load == 0:
            raise SurfaceError(
                f"{name}: the follower lifts off at {angle_deg:g} degrees: raise preload_n or "
                "spring_rate_n_per_m, or lower cam_speed_rpm"
            )
        if self.roller_radius_m is None and radius <= 0:
            raise SurfaceError(
                f"{name}: the cam is hollow or pointed at {angle_deg:g} degrees, where a flat "
                "follower does not touch it: raise base_radius_m"
            )
        if self.roller_radius_m is not None and -self.roller_radius_m < radius <= 0:
            raise SurfaceError(
                f"{name}: the roller cuts the cam's flank off at {angle_deg:g} degrees: its path "
                f"has a radius of {radius + self.roller_radius_m:.3g} m there: lower "
                "roller_radius_m or raise base_radius_m"
            )
        first, second = self.surface_speeds_m_per_s(angle_deg, speed)
        follower = FLAT if self.roller_radius_m is None else self.roller_radius_m
        return ElementContact(
            bodies=(
                Body(radius_x_m=radius, **self.elastic[0]),
                Body(radius_x_m=follower, **self.elastic[1]),
            ),
            oil=oil,
            speeds_m_per_s=(float(first), float(second)),
            load_n=load,
            length_m=self.width_m,
            angle_deg=float(angle_deg),
            options=options or {},
        )

    def places(self, *, points: int = 36, **given: Any) -> list[ElementContact]:  # noqa: ANN401
        """Return the contacts over one turn.

        Parameters
        ----------
        points : int
            Angles, evenly spread.
        **given
            As of :meth:`contact_at`.
        """
        number_of = count(points, "points", type(self).__name__, 4)
        return [self.contact_at(360.0 * k / number_of, **given) for k in range(number_of)]

    def over_cycle(
        self,
        *,
        cam_speed_rpm: float,
        oil: Oil,
        points: int = 36,
        **asked: Any,  # noqa: ANN401
    ) -> xr.Dataset:
        """Return films, roughness, friction and stresses over one turn of the cam.

        Parameters
        ----------
        cam_speed_rpm, oil
            As of :meth:`contact_at`.
        points : int
            Angles, evenly spread.
        **asked
            ``trace``, ``second``, ``heat``, ``stress``, ``reading`` of
            :class:`ehlwave.elements.answers.Questions`. The trace is of the cam.

        Returns
        -------
        xarray.Dataset
            Over ``angle_deg``. Attributes have mean powers, ``reversals_deg`` and the angles at
            which the surfaces move in opposite directions.
        """
        questions = Questions.of(asked, type(self).__name__)
        places = self.places(
            cam_speed_rpm=cam_speed_rpm, oil=oil, points=points, options=questions.options
        )
        angles = [place.angle_deg for place in places]
        found = table_of(places, questions, "angle_deg", {"angle_deg": angles})
        found["angle_deg"].attrs |= {"units": "degree", "long_name": "angle of the cam"}
        opposite = [place.angle_deg for place in places if place.is_opposite]
        reversals = self.reversals_deg()
        found.attrs |= {
            "element": type(self).__name__,
            "cam_speed_rpm": cam_speed_rpm,
            "oil": str(oil),
            "reversals_deg": ", ".join(f"{one:.2f}" for one in reversals) or "none",
            "opposite_speeds_deg": ", ".join(f"{one:g}" for one in opposite) or "none",
            "sliding_power_w": _mean(found, "sliding_power_w"),
            "sliding_power_error": sliding_error(found),
            "rolling_power_w": _mean(found, "rolling_power_w"),
            "rolling_power_error": LINE_ERROR,
            "unanswered_places": unanswered(found),
            "worst": "; ".join(worst_places(found).values()),
        }
        return found


def _mean(found: xr.Dataset, name: str) -> float:
    """Return the mean over a turn; NaN where a place is not known."""
    return float(found[name].mean(skipna=False)) if name in found else math.nan
