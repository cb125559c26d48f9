"""Waves under slip as the atlas of contacts that slide sees them."""

import json
from collections.abc import Mapping
from copy import copy
from dataclasses import astuple
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ehlwave.atlas.coordinates import Complex, Floats, columns
from ehlwave.atlas.shape import Seen, Shape
from ehlwave.atlas.sliding import conditions_of, rolling_chart
from ehlwave.deform.conditions import MOES_KEYS
from ehlwave.medium import Medium
from ehlwave.two_waves import LAUNCH_LENGTH, SLIP_POWERS, Launch, launch_length, launched

if TYPE_CHECKING:
    from ehlwave.atlas.chart import Chart

STANDING = 1e4
"""Wavelength along X, in units of a, of waves that hardly move: those of 90 degrees."""

INSTALLED = np.array([*SLIP_POWERS, *LAUNCH_LENGTH])
"""The coefficients of :mod:`ehlwave.two_waves`."""


class SlidingShape(Shape):
    """What turns responses of sliding contacts into numbers that hardly change, and back.

    The law is that of the two waves, which begins with the transfer that the atlas of rolling
    contacts has and crosses zero where the waves cancel; its coefficients are fitted to the points
    of the atlas. The spread is the phase of the launched wave. The pressure response is taken as
    that of contacts that roll.
    """

    OF_ALL = ("_law", "_rolling", "_chart")
    _contacts: NDArray[np.object_]
    _media: Floats
    _slip: Floats
    _alphabar: Floats
    _law: Floats
    _rolling: Complex | None

    @classmethod
    def of_keys(
        cls, keys: Mapping[str, ArrayLike], attributes: Mapping[str, Any]
    ) -> "SlidingShape":
        """Return that of contacts given by columns named as their keys, and of the atlas' law."""
        shape = cls(*map(np.atleast_1d, columns(keys, MOES_KEYS)))
        found = conditions_of(keys)
        shape._contacts = np.empty(len(found), dtype=object)
        shape._contacts[:] = found
        shape._media = np.array(  # under slip and in pure rolling
            [[astuple(one.medium(slip)) for slip in (one.slip_parameter, 1.0)] for one in found]
        )
        shape._slip = np.array([one.slip_parameter for one in found])
        shape._alphabar = np.array([one.alphabar for one in found])
        shape._law = np.array(json.loads(attributes["law"])) if "law" in attributes else INSTALLED
        shape._rolling = None
        return shape

    def with_rolling(self, rolling: Complex) -> "SlidingShape":
        """Return the same with known transfers of pure rolling, one for each contact."""
        other = copy(self)
        other._rolling = rolling
        return other

    def with_law(self, law: Floats) -> "SlidingShape":
        """Return the same with other coefficients: the powers, then those of the length."""
        other = copy(self)
        other._law = law
        return other

    def seen(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Seen:
        """Return waves; to the coordinates in rolling |a| and the phase of R are added."""
        rolled = super().seen(wavelength_over_a, angle_deg)
        rolling = self._chart.film_of(rolled) if self._rolling is None else self._rolling
        launch = self._launch(wavelength_over_a, angle_deg)
        law = launch.attenuated + launched(rolling, launch, self._law[: len(SLIP_POWERS)])
        more = np.stack([np.abs(launch.attenuated), np.angle(rolling)], axis=-1)
        return Seen(
            np.concatenate([rolled.coordinates, more], axis=-1),
            law,
            np.exp(1j * launch.mismatch.real * (1 - launch.length)),
            rolled.compliance,
        )

    @cached_property
    def _chart(self) -> "Chart":
        """Of the only contact in pure rolling."""
        return rolling_chart(self._contacts[0])

    def _launch(self, wavelength: ArrayLike, angle_deg: ArrayLike) -> Launch:
        """Return what decides on the launch of waves, and on their way."""
        number, theta = 2 * np.pi / np.asarray(wavelength, dtype=float), np.radians(angle_deg)
        kx = np.maximum(number * np.cos(theta), 2 * np.pi / STANDING)
        ky = number * np.sin(theta)
        under_slip, both = Medium(*self._media[:, 0].T), Medium(*self._media.T)
        psi = both.complementary_number(np.stack([kx * self._slip, kx + 0 * self._slip]), ky)
        return Launch(
            under_slip.attenuated(kx, ky, self._slip),
            psi[0] - kx,
            psi[1] - kx,
            self._slip,
            kx**2 / (kx**2 + ky**2),
            self.load,
            launch_length(self.load, self.l, self._alphabar, self._law[len(SLIP_POWERS) :]),
            under_slip.thinning,
        )
