"""The film at any place and time between rough surfaces under slip, by the law of the two waves.

With two rough surfaces the film changes by the sum of both effects, S for the first surface and
2 - S for the second.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.errors import SurfaceError
from ehlwave.laws.two_wave_transfer import TwoWaveTransfer
from ehlwave.surface.surface import Surface

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]

LEAST_SHARE = 1e-10
"""Share of the mean square of a surface: smaller components are left out of profiles."""

AT_ONCE = 2**20
"""Components times places that are held at a time."""


@dataclass(frozen=True)
class Mover:
    """A rough surface on its way through the contact.

    Attributes
    ----------
    surface : Surface
        Trace along rolling, or map; its heights repeat beyond its ends.
    transfer : TwoWaveTransfer
        Of the conditions with this surface's slip parameter.
    at_centre_m : float
        The x of the surface that is at the contact centre at the start, counted along its motion.
    """

    surface: Surface
    transfer: TwoWaveTransfer
    at_centre_m: float = 0.0

    def film_change(self, place_m: ArrayLike, rolled_m: float, line_m: float = 0.0) -> Floats:
        """Return the film less the smooth film, m, at places along X; see :func:`film_profile`."""
        places = np.asarray(place_m, dtype=float)
        height, qx, qy = self._components(line_m)
        slip = self.transfer.conditions.slip_parameter
        a_m = self.transfer.conditions.semi_axis_a_m
        own = np.exp(2j * np.pi * qx * (self.at_centre_m - slip * rolled_m))
        change = np.zeros(places.shape)
        step = max(1, AT_ONCE // max(1, places.size))
        for first in range(0, qx.size, step):
            part = slice(first, first + step)
            waves = self.transfer.waves(qx[part], qy[part])
            film = waves.at(places[:, None] / a_m) * (height * own)[part]
            change -= 2 * film.real.sum(axis=1)
        return change - self._standing(line_m)

    def _components(self, line_m: float) -> tuple[Complex, Floats, Floats]:
        """Return amplitudes on the line, m, and waves per metre, for moving non-zero components.

        Each represents itself and its conjugate. The shortest wave along x is its own conjugate.
        """
        spectrum, qx, qy = self._spectrum(line_m)
        moving = spectrum[1:]
        if self.surface.height.shape[0] % 2 == 0:
            moving[-1] /= 2
        squares = np.abs(moving) ** 2
        row, column = np.nonzero(squares > LEAST_SHARE * squares.sum())
        return moving[row, column], qx[1:][row], np.abs(qy)[column]

    def _standing(self, line_m: float) -> float:
        """Return the deformed height of ridges along rolling on the line, m."""
        spectrum, _, qy = self._spectrum(line_m)
        ratio = self.transfer.ratio(np.zeros(qy.size), np.abs(qy))
        return float((spectrum[0] * ratio).sum().real)

    def _spectrum(self, line_m: float) -> tuple[Complex, Floats, Floats]:
        height = self.surface.height
        qx = np.fft.rfftfreq(height.shape[0], self.surface.step_x_m)
        qy = np.fft.fftfreq(height.shape[1], self.surface.step_y_m or 1.0)
        full = np.fft.fft2(height)[: qx.size] / height.size
        middle = (height.shape[1] - 1) / 2 * (self.surface.step_y_m or 1.0)
        return full * np.exp(2j * np.pi * qy * (middle + line_m)), qx, qy


def film_profile(
    movers: Sequence[Mover], place_m: ArrayLike, rolled_m: float, line_m: float = 0.0
) -> Floats:
    """Return the film, m, along the contact at a time: smooth film and waves of surfaces.

    It is NaN where the surfaces touch.

    Parameters
    ----------
    movers : sequence of Mover
        One or two rough surfaces.
    place_m : array_like
        Distances from the contact centre along rolling, m. The waves are valid at the centre: use
        them within about half a semi-axis.
    rolled_m : float
        How far the mean speed has come since the start, m: time times mean speed.
    line_m : float
        Distance of the line from the middle of maps, m.

    Raises
    ------
    SurfaceError
        If the film thickness is not known.
    """
    film = movers[0].transfer.conditions.central_film_m
    if film is None:
        raise SurfaceError("the film thickness is unknown: give central_film_m or radius_x_m")
    changes = [mover.film_change(place_m, rolled_m, line_m) for mover in movers]
    found = film + np.sum(changes, axis=0)
    return np.where(found > 0, found, np.nan)


def second_conditions(conditions: Conditions) -> Conditions:
    """Return the conditions as the other surface has them: its slip parameter is 2 - S."""
    return replace(conditions, slip_parameter=2 - conditions.slip_parameter)
