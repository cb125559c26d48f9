"""Responses interpolated between the points of an atlas, with errors of their neighbours."""

import json
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ehlwave.atlas.coordinates import Complex, Floats
from ehlwave.atlas.process import Correlation, Process, Scales, correlation
from ehlwave.atlas.shape import Seen, Shape
from ehlwave.atlas.stored import numbers_of, responses_of, seen_of

if TYPE_CHECKING:
    from ehlwave.atlas.kinds import Kind

NEIGHBOURHOOD = 0.5
"""Of the length scales: how far around a wave errors of neighbours count for its own."""

PRECISION = 1e-4
"""Of the responses in the file and of the arithmetic, in units of Ai."""


def scales_of(data: xr.Dataset) -> dict[str, Scales]:
    """Return the length scales of an atlas, by what is interpolated."""
    return {
        name: Scales(np.array(one["contact"]), np.array(one["wave"]), one["noise"])
        for name, one in json.loads(data.attrs["length_scales"]).items()
    }


class Interpolated:
    """Responses of all contacts of an atlas, as Gaussian processes over contact and wave."""

    def __init__(self, data: xr.Dataset, kind: "Kind") -> None:
        """See all points; weights are solved for when they are first asked for."""
        self.data, self.scales = data, scales_of(data)
        self.seen = seen_of(data, kind)
        self.points = responses_of(data, kind, self.seen)
        self.misfit = data["error"].values.astype(float) ** 2
        self._processes: dict[str, Process] = {}

    def process(self, part: str) -> Process:
        """Return the interpolation of a part of the responses; its weights are found once."""
        if part not in self._processes:
            points, values = numbers_of(self.data, part, self.points, self.seen)
            self._processes[part] = Process(points, values, self.scales[part])
        return self._processes[part]

    @cached_property
    def near(self) -> Correlation:
        """How much the errors of waves count for others."""
        return Correlation(self.points.waves, self.scales["film"].waves * NEIGHBOURHOOD)

    def at(self, place: Floats, shape: Shape) -> "InterpolatedContact":
        """Return the responses of one contact by its coordinates and its shape."""
        return InterpolatedContact(self, place, shape)


class InterpolatedContact:
    """Responses of one contact."""

    def __init__(self, known: Interpolated, place: Floats, shape: Shape) -> None:
        """Weigh all contacts by their nearness."""
        self._known, self._place, self._shape = known, place, shape
        scales = known.scales["film"].contacts * NEIGHBOURHOOD
        near = correlation(place[None, :], known.points.contacts, scales)[0]
        self._near = near[known.points.of_contact]
        self._weights: dict[str, Floats] = {}

    def seen(self, wavelength: ArrayLike, angle_deg: ArrayLike) -> Seen:
        """Return waves as the contact sees them."""
        return self._shape.seen(wavelength, angle_deg)

    def film(self, seen: Seen) -> Complex:
        """Return film responses."""
        return seen.film(self._numbers("film", seen))

    def responses(self, seen: Seen) -> tuple[Complex, Complex, Floats]:
        """Return responses of film and pressure, and the error of the first."""
        film = self.film(seen)
        pressure = seen.pressure(film, self._numbers("pressure", seen))
        near = self._known.near(seen.coordinates)
        near *= self._near
        squares = near @ self._known.misfit / np.maximum(near.sum(axis=1), 1e-300)
        factor = self._known.data.attrs["error_factor"]
        return film, pressure, np.sqrt(factor**2 * squares + PRECISION**2)

    def rise(self, seen: Seen) -> Floats | None:
        """Return what waves add to the mean film, or None where that is not known."""
        if "mean_rise" not in self._known.data:
            return None
        return self._numbers("rise", seen)[:, 0]

    def _numbers(self, part: str, seen: Seen) -> Floats:
        """Return the interpolated numbers of a part, shape (n, numbers)."""
        process = self._known.process(part)
        if part not in self._weights:
            self._weights[part] = process.at_contact(self._place)
        return process.at_waves(self._weights[part], seen.coordinates)
