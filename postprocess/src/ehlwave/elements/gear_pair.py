"""Common parts of spur and helical pairs: places along the path, table, power."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np
import scipy
import xarray as xr
from numpy.typing import NDArray

from ehlwave.contact.bodies import Body
from ehlwave.contact.data_sheet import Oil
from ehlwave.elements.answers import Questions
from ehlwave.elements.given import RADIANS, above, at_least, count, pair
from ehlwave.elements.involute import InvolutePair
from ehlwave.elements.material import both_elastic
from ehlwave.elements.place import ElementContact
from ehlwave.elements.rolling_resistance import LINE_ERROR
from ehlwave.elements.table import sliding_error, table_of, unanswered, worst_places
from ehlwave.errors import ExtrapolationWarning, SurfaceError

FINE = 2001
"""Points of the integral of the power over the path, on which load and sliding are exact."""


NO_OIL = Oil(viscosity_pa_s=0.01, pressure_viscosity_per_pa=2e-8)
"""An oil where only pressures are asked for."""


class GearPair:
    """A pair of involute gears; subclasses define the helix angle."""

    geometry: InvolutePair
    """Geometry of the involutes."""
    face_width_m: float
    """Width that bears load."""
    elastic: tuple[Mapping[str, Any], Mapping[str, Any]]
    """Materials of pinion and wheel, as arguments of :class:`ehlwave.Body`."""

    def _take(self, given: Mapping[str, Any], helix_angle_deg: float) -> None:
        """Check and keep the arguments of all gear pairs."""
        name = type(self).__name__
        teeth = pair(given["teeth"], "teeth", name)
        if min(teeth) < 0:
            raise SurfaceError(f"{name}: teeth = {given['teeth']}: internal gears are not covered")
        distance = given["centre_distance_m"]
        helix = at_least(helix_angle_deg, "helix_angle_deg", name)
        if 0 < helix < RADIANS:
            raise SurfaceError(
                f"{name}: helix_angle_deg = {helix:g}: give degrees, such as 20, or 0"
            )
        if not helix < 45:
            raise SurfaceError(f"{name}: helix_angle_deg = {helix:g} must be below 45")
        angle = above(given["pressure_angle_deg"], "pressure_angle_deg", name, RADIANS, "20")
        if not angle < 45:
            raise SurfaceError(f"{name}: pressure_angle_deg = {angle:g} must be below 45")
        self.geometry = InvolutePair(
            module_m=above(given["module_m"], "module_m", name, example="0.003"),
            teeth=(count(teeth[0], "teeth", name, 5), count(teeth[1], "teeth", name, 5)),
            pressure_angle_deg=angle,
            helix_angle_deg=helix,
            profile_shift=pair(given["profile_shift"], "profile_shift", name),
            centre_distance_m=None
            if distance is None
            else above(distance, "centre_distance_m", name, example="0.09"),
            addendum=above(given["addendum"], "addendum", name, example="1"),
        )
        self.face_width_m = above(given["face_width_m"], "face_width_m", name, example="0.02")
        constants = (given["elastic_modulus_pa"], given["poisson_ratio"])
        self.elastic = both_elastic(given["material"], *constants, name)
        _ = self.geometry.path_m  # refuses pairs that do not mesh

    @property
    def overlap_ratio(self) -> float:
        """Return eps_beta."""
        return self.geometry.overlap_ratio(self.face_width_m)

    @property
    def line_length_m(self) -> float:
        """Return the length of a contact line over the whole face, b/cos(beta_b)."""
        return self.face_width_m / math.cos(self.geometry.base_helix_rad)

    def normal_load_n(self, pinion_torque_n_m: float) -> float:
        """Return the force normal to the flanks, T/(r_b cos(beta_b)).

        Parameters
        ----------
        pinion_torque_n_m : float
            T of the pinion.
        """
        transverse = pinion_torque_n_m / self.geometry.base_radii_m[0]
        return transverse / math.cos(self.geometry.base_helix_rad)

    def _load_n_per_m(
        self, pinion_torque_n_m: float, distance_m: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return the load per length of the contact lines, load factors of 1.

        A line has the length b/cos(beta_b), and the force F/cos(beta_b): both cosines cancel.
        """
        transverse = pinion_torque_n_m / self.geometry.base_radii_m[0]
        share = self.geometry.share(distance_m, self.overlap_ratio)
        return transverse / self.face_width_m * share

    def _speeds(self, pinion_speed_rpm: float, distance_m: Any) -> tuple[Any, Any]:  # noqa: ANN401
        """Return omega_1 s and omega_2 (N - s)."""
        turn = 2 * math.pi / 60 * pinion_speed_rpm
        first, second = self.geometry.teeth
        return turn * distance_m, turn * first / second * (self.geometry.action_m - distance_m)

    def contact_at(
        self,
        distance_m: float,
        *,
        pinion_torque_n_m: float,
        pinion_speed_rpm: float,
        oil: Oil,
        load_factor: float = 1.0,
        options: Mapping[str, Any] | None = None,
    ) -> ElementContact:
        """Return the contact at s.

        Parameters
        ----------
        distance_m : float
            s, from the base tangent point of the pinion along the line of action.
        pinion_torque_n_m, pinion_speed_rpm, oil
            Torque and speed of the pinion, and the oil.
        load_factor : float
            Factor K on loads over the loads of the torque, as K_A K_v K_Hbeta K_Halpha of ISO 6336.
        options : mapping, optional
            Options of :class:`ehlwave.Contact`.
        """
        name = type(self).__name__
        torque = above(pinion_torque_n_m, "pinion_torque_n_m", name, example="150")
        speed = above(pinion_speed_rpm, "pinion_speed_rpm", name, example="1500")
        s = np.asarray(distance_m, dtype=np.float64)
        load = float(self._load_n_per_m(torque, s))
        load *= above(load_factor, "load_factor", name, example="1")
        first, second = self._speeds(speed, float(s))
        points = self.geometry.named_points_m
        near = min(points, key=lambda key: abs(points[key] - float(s)))
        radii = self.geometry.radii_m(s)
        flanks = tuple(
            Body(radius_x_m=float(radius), **elastic)
            for radius, elastic in zip(radii, self.elastic, strict=True)
        )
        return ElementContact(
            bodies=flanks,  # type: ignore[arg-type]
            oil=oil,
            speeds_m_per_s=(first, second),
            load_n=load * self.line_length_m,
            length_m=self.line_length_m,
            angle_deg=math.degrees(float(s) / self.geometry.base_radii_m[0]),
            name=near if abs(points[near] - float(s)) < 1e-9 else "",
            options=options or {},
        )

    def _distances_m(self, points: int) -> NDArray[np.float64]:
        name = type(self).__name__
        return np.linspace(*self.geometry.path_m, count(points, "points", name, 2))

    def places(self, *, points: int = 9, **given: Any) -> list[ElementContact]:  # noqa: ANN401
        """Return the contacts from A to E.

        Parameters
        ----------
        points : int
            Evenly spread, both ends included.
        **given
            As of :meth:`contact_at`.
        """
        return [self.contact_at(float(s), **given) for s in self._distances_m(points)]

    def along_path(
        self,
        *,
        pinion_torque_n_m: float,
        pinion_speed_rpm: float,
        oil: Oil,
        points: int = 9,
        load_factor: float = 1.0,
        **asked: Any,  # noqa: ANN401
    ) -> xr.Dataset:
        """Return films, roughness, friction and stresses along the path of contact, A to E.

        Parameters
        ----------
        pinion_torque_n_m, pinion_speed_rpm, oil, load_factor
            As of :meth:`contact_at`.
        points : int
            Evenly spread from A to E, both ends included.
        **asked
            ``trace``, ``second``, ``heat``, ``stress``, ``reading`` of
            :class:`ehlwave.elements.answers.Questions`. The trace is of the pinion.

        Returns
        -------
        xarray.Dataset
            Over ``distance_m``, s; columns as in
            :data:`ehlwave.elements.columns.COLUMNS`. Attributes have mean powers of sliding and
            rolling, efficiency and the worst places.
        """
        questions = Questions.of(asked, type(self).__name__)
        places = self.places(
            pinion_torque_n_m=pinion_torque_n_m,
            pinion_speed_rpm=pinion_speed_rpm,
            oil=oil,
            points=points,
            load_factor=load_factor,
            options=questions.options,
        )
        distances = self._distances_m(points)
        coordinates = {
            "distance_m": distances.tolist(),
            "pinion_angle_deg": [place.angle_deg for place in places],
        }
        found = table_of(places, questions, "distance_m", coordinates)
        found["distance_m"].attrs |= {
            "units": "m",
            "long_name": "distance from the base tangent point of the pinion",
        }
        found.attrs |= self._attributes(found, pinion_torque_n_m, pinion_speed_rpm, load_factor)
        found.attrs["oil"] = str(oil)
        return found

    def _attributes(
        self, found: xr.Dataset, torque: float, speed: float, factor: float
    ) -> dict[str, Any]:
        sliding, rolling = self._powers_w(found, torque, speed, factor)
        through = torque * 2 * math.pi / 60 * speed
        if notes := self.geometry.notes:
            warnings.warn(f"{type(self).__name__}: {notes}", ExtrapolationWarning, stacklevel=3)
        points = ", ".join(f"{k} {s * 1e3:.4g}" for k, s in self.geometry.named_points_m.items())
        return {
            "element": type(self).__name__,
            "pinion_torque_n_m": torque,
            "pinion_speed_rpm": speed,
            "load_factor": factor,
            "contact_ratio": self.geometry.contact_ratio,
            "overlap_ratio": self.overlap_ratio,
            "working_pressure_angle_deg": math.degrees(self.geometry.working_angle_rad),
            "named_points_mm": points,
            "backlash_m": self.geometry.backlash_m,
            **self._peak(torque, speed, factor),
            **({"geometry_note": notes} if notes else {}),
            "sliding_power_w": sliding,
            "sliding_power_error": sliding_error(found),
            "rolling_power_w": rolling,
            "rolling_power_error": LINE_ERROR,
            "efficiency": 1 - (sliding + rolling) / through,
            "power_note": "mean over the mesh of sliding and rolling; without churning, windage "
            "and bearings",
            "unanswered_places": unanswered(found),
            "worst": "; ".join(worst_places(found).values()),
        }

    def _peak(self, torque: float, speed: float, factor: float) -> dict[str, float]:
        """Return the largest Hertz pressure, at a point A to E, and its place.

        Loads jump at B and D, which evenly spread places miss.
        """
        found: dict[float, float] = {}
        for s in self.geometry.named_points_m.values():
            given = {"pinion_torque_n_m": torque, "pinion_speed_rpm": speed, "load_factor": factor}
            found[self.contact_at(s, oil=NO_OIL, **given).hertz_pressure_pa] = s
        return {"peak_hertz_pressure_pa": max(found), "peak_hertz_distance_m": found[max(found)]}

    def _powers_w(
        self, found: xr.Dataset, torque: float, speed: float, factor: float
    ) -> tuple[float, float]:
        """Return mean powers of sliding and rolling: integrals over the path over p_bt.

        Between places friction and rolling resistance are straight lines; NaN where a value is
        unknown.
        """
        s = found["distance_m"].values
        fine = np.linspace(s[0], s[-1], FINE)
        first, second = self._speeds(speed, fine)
        load = self._load_n_per_m(torque, fine) * self.line_length_m * factor
        pitch = self.geometry.base_pitch_m
        friction = found["friction"].values if "friction" in found else np.full(s.size, np.nan)
        sliding = np.interp(fine, s, friction) * load * np.abs(first - second)
        rolling = np.interp(fine, s, found["rolling_resistance_n"].values) * (first + second)
        return float(scipy.integrate.trapezoid(sliding, fine) / pitch), float(
            scipy.integrate.trapezoid(rolling, fine) / pitch
        )
