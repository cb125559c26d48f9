"""Responses under slip by the law of the two waves, corrected by kernels about some of its points.

The numbers of :class:`ehlwave.atlas.sliding_shape.SlidingSeen` are sums of Matern kernels about
centres, fitted together to all points (``studies.atlas.correct``), and so is ln of their error.
"""

import json
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from ehlwave.atlas.coordinates import Complex, Floats
from ehlwave.atlas.process import Correlation
from ehlwave.atlas.shape import Shape
from ehlwave.atlas.sliding_shape import FILM_NUMBERS, SlidingSeen, SlidingShape
from ehlwave.atlas.stored import waves_of

if TYPE_CHECKING:
    from ehlwave.atlas.kinds import Kind

ERROR_NUMBER = FILM_NUMBERS + 2
"""Place of ln of the error among the numbers, after those of film and pressure."""


class Expanded:
    """Responses of all contacts of an atlas."""

    def __init__(self, data: xr.Dataset, _: "Kind") -> None:
        """See the centres."""
        scales = np.array(json.loads(data.attrs["wave_scales"]))
        of_contact = data["centre_contact"].values.astype(np.intp)
        rolling = data["rolling_real"].values + 1j * data["rolling_imaginary"].values
        centres = seen_in(data, of_contact, waves_of(data), rolling)
        self.near = Correlation(centres.coordinates, scales)
        self.coefficients = data["coefficient"].values.astype(float)
        self.factor, self.usual = data.attrs["error_factor"], data.attrs["usual_log_error"]

    def at(self, _: Floats, shape: Shape) -> "ExpandedContact":
        """Return the responses of one contact by its shape."""
        if not isinstance(shape, SlidingShape):
            raise TypeError("responses under slip are those of contacts that slide")
        return ExpandedContact(self, shape)


class ExpandedContact:
    """Responses of one contact."""

    def __init__(self, known: Expanded, shape: SlidingShape) -> None:
        """Take what it makes of waves."""
        self._known, self._shape = known, shape

    def seen(self, wavelength: ArrayLike, angle_deg: ArrayLike) -> SlidingSeen:
        """Return waves as the contact sees them."""
        return self._shape.seen_under_slip(wavelength, angle_deg)

    def film(self, seen: SlidingSeen) -> Complex:
        """Return film responses."""
        return seen.film(self._numbers(seen)[:, :FILM_NUMBERS])

    def responses(self, seen: SlidingSeen) -> tuple[Complex, Complex, Floats]:
        """Return responses of film and pressure, and the error of the first."""
        numbers = self._numbers(seen)
        film = seen.film(numbers[:, :FILM_NUMBERS])
        pressure = seen.pressure(film, numbers[:, FILM_NUMBERS:ERROR_NUMBER])
        error = np.exp(self._known.usual + numbers[:, ERROR_NUMBER])
        return film, pressure, self._known.factor * error

    def rise(self, _: SlidingSeen) -> None:
        """Return None: the rise of the mean film is not known under slip."""

    def _numbers(self, seen: SlidingSeen) -> Floats:
        return np.asarray(self._known.near(seen.coordinates) @ self._known.coefficients)


def seen_in(
    data: xr.Dataset, of_contact: NDArray[np.intp], waves: tuple[Floats, Floats], rolling: Complex
) -> SlidingSeen:
    """Return waves by the place of their contact in an atlas and their transfers in pure rolling.

    `waves` are wavelengths over a and angles, degrees.
    """
    shape = SlidingShape.of_keys(data, data.attrs)[of_contact].with_rolling(rolling)
    return shape.seen_under_slip(*waves)
