"""Common parts of test rigs: a contact, its speeds, and tables over the speed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from ehlwave.contact.bodies import Body
from ehlwave.contact.data_sheet import Oil
from ehlwave.elements.answers import Questions
from ehlwave.elements.given import above
from ehlwave.elements.place import ElementContact
from ehlwave.elements.rolling_resistance import error_of
from ehlwave.elements.table import table_of, unanswered, worst_places
from ehlwave.errors import SurfaceError
from ehlwave.quantities import number


class TestRig:
    """A rig of a single contact; subclasses define the bodies."""

    __test__ = False  # no test of pytest
    bodies: tuple[Body, Body]
    """The rough one first."""
    length_m: float | None = None
    """Length of a line contact."""

    def contact_at(
        self,
        *,
        load_n: float,
        mean_speed_m_per_s: float,
        oil: Oil,
        slide_to_roll_ratio: float = 0.0,
        options: Mapping[str, Any] | None = None,
    ) -> ElementContact:
        """Return the contact at a speed.

        Parameters
        ----------
        load_n, mean_speed_m_per_s : float
            Load, and mean of both surface speeds.
        oil : Oil
            At the temperature of the inlet.
        slide_to_roll_ratio : float
            (u1 - u2) over the mean speed; above 0 the first body is faster.
        options : mapping, optional
            Options of :class:`ehlwave.Contact`.
        """
        name = type(self).__name__
        mean = above(mean_speed_m_per_s, "mean_speed_m_per_s", name, example="1")
        ratio = number(slide_to_roll_ratio, "slide_to_roll_ratio", name)
        return ElementContact(
            bodies=self.bodies,
            oil=oil,
            speeds_m_per_s=(mean * (1 + ratio / 2), mean * (1 - ratio / 2)),
            load_n=above(load_n, "load_n", name, example="20"),
            length_m=self.length_m,
            options=options or {},
        )

    def places(
        self,
        *,
        mean_speeds_m_per_s: Sequence[float],
        **given: Any,  # noqa: ANN401
    ) -> list[ElementContact]:
        """Return the contacts at mean speeds.

        Parameters
        ----------
        mean_speeds_m_per_s : sequence of float
            Mean speeds.
        **given
            As of :meth:`contact_at`.
        """
        speeds = np.atleast_1d(np.asarray(mean_speeds_m_per_s, dtype=object))
        if speeds.size == 0:
            raise SurfaceError(f"{type(self).__name__}: mean_speeds_m_per_s is empty: give a speed")
        return [self.contact_at(mean_speed_m_per_s=one, **given) for one in speeds]

    def over_speeds(
        self,
        *,
        load_n: float,
        mean_speeds_m_per_s: Sequence[float],
        oil: Oil,
        slide_to_roll_ratio: float = 0.0,
        **asked: Any,  # noqa: ANN401
    ) -> xr.Dataset:
        """Return films, roughness, friction and stresses over mean speeds.

        Parameters
        ----------
        load_n, oil, slide_to_roll_ratio
            As of :meth:`contact_at`.
        mean_speeds_m_per_s : sequence of float
            Mean speeds.
        **asked
            ``trace``, ``second``, ``heat``, ``stress``, ``oil_over_flooded``, ``reading`` of
            :class:`ehlwave.elements.answers.Questions`.
        """
        questions = Questions.of(asked, type(self).__name__)
        places = self.places(
            mean_speeds_m_per_s=mean_speeds_m_per_s,
            load_n=load_n,
            oil=oil,
            slide_to_roll_ratio=slide_to_roll_ratio,
            options=questions.options,
        )
        speeds = [place.mean_speed_m_per_s for place in places]
        found = table_of(places, questions, "speed_m_per_s", {"speed_m_per_s": speeds})
        found["speed_m_per_s"].attrs |= {"units": "m/s", "long_name": "mean speed"}
        found.attrs |= {
            "element": type(self).__name__,
            "load_n": load_n,
            "slide_to_roll_ratio": slide_to_roll_ratio,
            "oil": str(oil),
            "rolling_power_error": error_of(self.length_m),
            "unanswered_places": unanswered(found),
            "worst": "; ".join(worst_places(found).values()),
        }
        return found
