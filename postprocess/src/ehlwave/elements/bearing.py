"""Common parts of rolling bearings: kinematics, contacts, load zone, power."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave.choices import chosen
from ehlwave.contact.data_sheet import Oil
from ehlwave.elements.answers import Questions
from ehlwave.elements.bearing_motion import BearingMotion
from ehlwave.elements.given import check_names, count, loads_of
from ehlwave.elements.inside_error import inside_error, widen
from ehlwave.elements.load_zone import RINGS, LoadZone
from ehlwave.elements.place import ElementContact
from ehlwave.elements.practice import viscosity_ratio
from ehlwave.elements.races import Races
from ehlwave.elements.rolling_resistance import error_of, rolling_power_w
from ehlwave.elements.table import table_of, unanswered, worst_places
from ehlwave.errors import ExtrapolationWarning, SurfaceError
from ehlwave.shown import percent

Floats = NDArray[np.float64]

LARGEST_LEFT_OUT = 0.05
"""Centrifugal force over the largest load above which loads without it are warned of."""
LEAST_LOAD = 1e-9
"""Load over the largest below which an element counts as unloaded: round-off at the zone's end."""


class RollingBearing(BearingMotion):
    """A bearing of balls or rollers; subclasses define bodies and loads."""

    elastic: Mapping[str, Any]
    """Material of all parts, as arguments of :class:`ehlwave.Body`."""
    load_zone: Callable[..., LoadZone]
    """Method that returns the loads around the bearing; the kinds of bearings have it."""
    variants: tuple[RollingBearing, ...] = ()
    """Bearings with other inner dimensions, where they are estimated."""
    inside_errors: Mapping[str, float] = {}
    """Errors of estimated inner dimensions, relative; of counts absolute."""
    power: float
    """Power of the approach of a race in its load."""
    free_angle_deg: float = 0.0
    """Contact angle without load."""

    @property
    def stiffnesses(self) -> tuple[float, float]:
        """Return load per approach to the power, N/m^power, of the inner and the outer race."""
        raise NotImplementedError

    @property
    def stiffness(self) -> float:
        """Return the stiffness of both contacts in series, N/m^power."""
        return self.races().stiffness

    def races(self, inner_speed_rpm: float = 0.0, outer_speed_rpm: float = 0.0) -> Races:
        """Return both contacts of an element with its centrifugal force.

        Parameters
        ----------
        inner_speed_rpm, outer_speed_rpm : float
            Speeds of the rings.
        """
        force = self.centrifugal_load_n(inner_speed_rpm, outer_speed_rpm, self.free_angle_deg)
        return Races(self.stiffnesses, self.power, force * self.outward_share)

    @property
    def outward_share(self) -> float:
        """Return the load of the outer race over the centrifugal force that causes it."""
        return 1.0

    def _place(
        self,
        ring: str,
        angle_deg: float,
        load_n: float,
        contact_angle_deg: float,
        speeds_rpm: tuple[float, float],
        oil: Oil,
        options: Mapping[str, Any],
    ) -> ElementContact:
        speed = self.surface_speed_m_per_s(*speeds_rpm, contact_angle_deg)
        others = {"contact_angle_deg": contact_angle_deg} if contact_angle_deg else {}
        return ElementContact(
            bodies=self.bodies(ring, contact_angle_deg),
            oil=oil,
            speeds_m_per_s=(speed, speed),
            load_n=load_n,
            length_m=self.length_m(),
            angle_deg=angle_deg,
            name=f"{ring} ring",
            others=others,
            options=options,
        )

    def contacts(
        self,
        *,
        inner_speed_rpm: float,
        oil: Oil,
        outer_speed_rpm: float = 0.0,
        ring: str = "inner",
        options: Mapping[str, Any] | None = None,
        has_centrifugal_load: bool = False,
        **loads: float,
    ) -> list[ElementContact]:
        """Return the contacts of all elements between both rings that bear load with one of them.

        Elements outside the load zone are left out. Centrifugal force presses them on the outer
        ring.

        Parameters
        ----------
        inner_speed_rpm, outer_speed_rpm : float
            Speeds of the rings.
        oil : Oil
            At the temperature of the bearing.
        ring : {"inner", "outer"}
            The ring.
        options : mapping, optional
            Options of :class:`ehlwave.Contact`, such as ``heat``.
        has_centrifugal_load : bool
            Whether the outer ring bears the centrifugal force of the elements as well, which ISO
            16281 leaves out.
        **loads
            ``radial_load_n``, and ``axial_load_n`` of balls.

        Returns
        -------
        list of ElementContact
            With ``angle_deg`` from the direction of the load, above -180 to 180, ``load_n`` and
            ``contact``.
        """
        chosen(ring, "ring", RINGS, type(self).__name__)
        speeds = self._speeds_rpm(inner_speed_rpm, outer_speed_rpm)
        zone = self._zone(loads, speeds if has_centrifugal_load else (0.0, 0.0))
        angles = self._angles(zone)
        return [
            self._place(ring, angle, float(load), float(alpha), speeds, oil, options or {})
            for angle, load, alpha in zip(
                angles.tolist(), *zone.loads_at(angles, ring), strict=True
            )
        ]

    def _zone(self, loads: Mapping[str, Any], speeds_rpm: tuple[float, float]) -> LoadZone:
        check_names(loads, loads_of(self.load_zone), type(self).__name__)
        return self.load_zone(**loads, inner_speed_rpm=speeds_rpm[0], outer_speed_rpm=speeds_rpm[1])

    def _angles(self, zone: LoadZone) -> Floats:
        """Return the angles of the elements that bear load, above -180 to 180 degrees."""
        angles = 360 * np.arange(self.elements) / self.elements
        angles = np.where(angles > 180, angles - 360, angles)
        loads = zone.loads_at(angles)[0]
        return np.asarray(angles[loads > LEAST_LOAD * loads.max()])

    def places(
        self,
        *,
        points: int = 0,
        rings: tuple[str, ...] = RINGS,
        **given: Any,  # noqa: ANN401
    ) -> list[ElementContact]:
        """Return the contacts of all loaded elements with both rings.

        Parameters
        ----------
        points : int
            Not used: the elements define the places.
        rings : tuple of str
            The rings.
        **given
            As of :meth:`contacts`.
        """
        return [place for ring in rings for place in self.contacts(ring=ring, **given)]

    def over_load_zone(
        self,
        *,
        inner_speed_rpm: float,
        oil: Oil,
        outer_speed_rpm: float = 0.0,
        points: int = 9,
        rings: tuple[str, ...] = RINGS,
        has_centrifugal_load: bool = False,
        **asked: Any,  # noqa: ANN401
    ) -> xr.Dataset:
        """Return films, roughness and stresses over the load zone of both rings.

        Parameters
        ----------
        inner_speed_rpm, outer_speed_rpm, oil
            As of :meth:`contacts`.
        points : int
            Angles, evenly spread over 95 % of the loaded part; the most loaded place is among them.
        rings : tuple of str
            Rings that are answered.
        has_centrifugal_load : bool
            As of :meth:`contacts`. A warning appears without it where it matters.
        **asked
            ``radial_load_n``, ``axial_load_n``; ``trace``, ``second``, ``heat``, ``stress``,
            ``oil_over_flooded``, ``reading`` of :class:`ehlwave.elements.answers.Questions`. The
            trace is of the race, the second of the element.

        Returns
        -------
        xarray.Dataset
            Over ``ring`` and ``angle_deg``; columns as in
            :data:`ehlwave.elements.columns.COLUMNS`. Attributes have the power of rolling and
            sliding, kappa of ISO 281 and the worst places.
        """
        takes = loads_of(self.load_zone)
        loads = {name: asked.pop(name) for name in takes if name in asked}
        name, speeds = type(self).__name__, self._speeds_rpm(inner_speed_rpm, outer_speed_rpm)
        questions = Questions.of(asked, name, [*takes, "rings"])
        if speeds[0] == speeds[1]:
            raise SurfaceError(
                f"{name}: both rings turn at {speeds[0]:g} rpm, so that no contact rolls: change "
                "inner_speed_rpm or outer_speed_rpm"
            )
        if not rings or isinstance(rings, str):
            raise SurfaceError(f"rings = {rings!r}: give a list of 'inner', 'outer', or both")
        zone = self._zone(loads, speeds if has_centrifugal_load else (0.0, 0.0))
        angles = zone.angles_deg(count(points, "points", name, 1))
        tables = []
        for ring in rings:
            loaded = (values.tolist() for values in (angles, *zone.loads_at(angles, ring)))
            given = zip(*loaded, strict=True)
            places = [self._place(ring, *one, speeds, oil, questions.options) for one in given]
            tables.append(table_of(places, questions, "angle_deg", {"angle_deg": angles.tolist()}))
        found = xr.concat(tables, dim="ring").assign_coords(ring=list(rings))
        found["angle_deg"].attrs |= {"units": "degree", "long_name": "angle from the load"}
        if self.variants:
            widen(found, self._inside_error(loads, speeds, oil))
        found.attrs |= self._attributes(zone, found, loads, speeds, oil, has_centrifugal_load)
        return found

    def _inside_error(
        self, loads: Mapping[str, float], speeds_rpm: tuple[float, float], oil: Oil
    ) -> float:
        """Return the relative error of films by estimated inner dimensions."""
        most = []
        for bearing in (self, *self.variants):
            load, alpha = (float(one) for one in bearing.load_zone(**loads).loads_at(0.0))
            most.append(bearing._place("inner", 0.0, load, alpha, speeds_rpm, oil, {}))
        return inside_error(most[0], most[1:])

    def _attributes(
        self,
        zone: LoadZone,
        found: xr.Dataset,
        loads: Mapping[str, float],
        speeds_rpm: tuple[float, float],
        oil: Oil,
        has_force: bool,
    ) -> dict[str, Any]:
        relative = speeds_rpm[0] - speeds_rpm[1]
        factor = float(found["thermal_film_factor"].min()) if "thermal_film_factor" in found else 1
        angles = self._angles(zone)
        loaded = [
            self._place(ring, 0.0, float(load), float(alpha), speeds_rpm, oil, {})
            for ring in RINGS
            for load, alpha in zip(*zone.loads_at(angles, ring), strict=True)
        ]
        centrifugal = self.centrifugal_load_n(*speeds_rpm, self.free_angle_deg)
        share = centrifugal / float(zone.loads_at(angles)[0].max())
        if share > LARGEST_LEFT_OUT and not has_force:
            warnings.warn(
                f"the centrifugal force of an element is {percent(share)} of the largest load, "
                "which the loads leave out: has_centrifugal_load = true adds it",
                ExtrapolationWarning,
                stacklevel=4,
            )
        rolling = rolling_power_w(loaded) * (1.0 if math.isnan(factor) else factor)
        return {
            "element": type(self).__name__,
            **loads,
            "inner_speed_rpm": speeds_rpm[0],
            "outer_speed_rpm": speeds_rpm[1],
            "oil": str(oil),
            "ring_displacement_m": zone.radial_m,
            "load_zone_half_width_deg": zone.half_width_deg,
            "rolling_power_w": rolling,
            "rolling_power_error": error_of(self.length_m()),
            "sliding_power_w": 0.0,
            "power_note": "rolling of loaded elements on both rings; without sliding in the "
            "contacts by their curvature and spin, cage, seals and churning",
            "time_between_overrollings_s": self.overrolling_time_s(*speeds_rpm),
            "centrifugal_load_n": centrifugal,
            "centrifugal_over_load": share,
            "kappa_iso_281": viscosity_ratio(oil, relative, self.pitch_diameter_m),
            "unanswered_places": unanswered(found),
            "worst": "; ".join(worst_places(found).values()),
        }
