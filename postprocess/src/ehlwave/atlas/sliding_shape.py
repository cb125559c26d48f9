"""Waves under slip as the atlas of contacts that slide sees them."""

import json
from collections.abc import Mapping
from copy import copy
from dataclasses import astuple, dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ehlwave.atlas.coordinates import Complex, Floats, columns
from ehlwave.atlas.shape import Shape
from ehlwave.atlas.sliding import conditions_of, rolling_chart
from ehlwave.deform.conditions import MOES_KEYS, Conditions
from ehlwave.medium import INLET_VISCOSITY, Medium, hertz_medium
from ehlwave.two_waves import LAUNCH_LENGTH, SLIP_POWERS, Launch, launch_length, launched

if TYPE_CHECKING:
    from ehlwave.atlas.chart import Chart

STANDING = 1e4
"""Wavelength along X, in units of a, of waves that hardly move: those of 90 degrees."""

INSTALLED = np.array([*SLIP_POWERS, *LAUNCH_LENGTH])
"""The coefficients of :mod:`ehlwave.two_waves`."""

FILM_NUMBERS = 7
"""How many numbers change a film response; a pressure response has two."""


@dataclass(frozen=True)
class SlidingSeen:
    """Waves in contacts that slide.

    The law of the two waves, T = a + c, knows them by seven numbers, 0 where it stands as it is:
    what the power of S lacks (real and imaginary part, see :func:`ehlwave.two_waves.launched`), ln
    of the factors of the launch's length and of the flow at the centre under slip and in pure
    rolling, and what T lacks then (real and imaginary). The pressure is taken less that of the two
    waves, (a - 1)/W(k) + c/W(psi), times W(k): two numbers.

    Attributes
    ----------
    coordinates : ndarray, shape (n, 15)
        In which the numbers are smooth.
    kx, ky : ndarray
        Wave numbers, 1/a.
    media : ndarray, shape (c, 2, 7)
        :class:`ehlwave.medium.Medium` under slip and in pure rolling, of each wave or of all.
    rolling : ndarray of complex
        R, the transfers in pure rolling.
    law : ndarray
        Coefficients of the law.
    launch : Launch
        Of the law as it stands.
    compliance : ndarray
        W(k), in units of c/ph.
    """

    coordinates: Floats
    kx: Floats
    ky: Floats
    media: Floats
    rolling: Complex
    law: Floats
    launch: Launch
    compliance: Floats

    def film(self, numbers: Floats) -> Complex:
        """Return film responses by their numbers, shape (n, 7)."""
        power, length, flow = numbers[:, 0] + 1j * numbers[:, 1], numbers[:, 2], numbers[:, 3:5]
        media = np.array(np.broadcast_to(self.media, (len(numbers), *self.media.shape[1:])))
        media[..., 3:5] *= np.exp(flow)[..., None]
        launch = replace(
            _launch(self.kx, self.ky, media, self.launch),
            length=self.launch.length * np.exp(length),
            more=power,
        )
        left = numbers[:, 5] + 1j * numbers[:, 6]
        return np.asarray(launch.attenuated + self._launched(launch) + left)

    def film_by_law(self) -> Complex:
        """Return film responses by the law as it stands."""
        return np.asarray(self.launch.attenuated + self._launched(self.launch))

    def pressure(self, film: Complex, numbers: Floats) -> Complex:
        """Return pressure responses by those of the film and their numbers, shape (n, 2)."""
        left = numbers[:, 0] + 1j * numbers[:, 1]
        return np.asarray((self._deflection(film) + left) / self.compliance)

    def pressure_left(self, film: Complex, pressure: Complex) -> Complex:
        """Return what :meth:`pressure` takes as numbers, as complex ones."""
        return np.asarray(self.compliance * pressure - self._deflection(film))

    def _launched(self, launch: Launch) -> Complex:
        return launched(self.rolling, launch, self.law[: len(SLIP_POWERS)])

    def _deflection(self, film: Complex) -> Complex:
        """Return W(k) times the pressure of the two waves that make up a film response."""
        a, psi = self.launch.attenuated, self.kx + self.launch.mismatch
        ratio = np.sqrt((psi**2 + self.ky**2) / (self.kx**2 + self.ky**2))
        return np.asarray(a - 1 + (film - a) * ratio)


class SlidingShape(Shape):
    """What contacts that slide make of waves, by closed forms.

    The state of the contact centre has the film and the pressure there as they were computed.
    """

    OF_ALL = ("_law", "_rolling", "_chart")
    _contacts: NDArray[np.object_]
    _media: Floats
    _slip: Floats
    _alphabar: Floats
    _state: Floats
    _law: Floats
    _rolling: Complex | None

    @classmethod
    def of_keys(
        cls, keys: Mapping[str, ArrayLike], attributes: Mapping[str, Any]
    ) -> "SlidingShape":
        """Return that of contacts, and of the atlas' law.

        Columns are named as the keys of contacts; besides ``central_film``, H, and
        ``pressure_ratio``, ln P, at the centre.
        """
        shape = cls(*map(np.atleast_1d, columns(keys, MOES_KEYS)))
        found = conditions_of(keys)
        shape._contacts = np.empty(len(found), dtype=object)
        shape._contacts[:] = found
        film, log_p = map(np.atleast_1d, columns(keys, ("central_film", "pressure_ratio")))
        states = zip(found, film, np.exp(log_p), strict=True)
        shape._media = np.array([_media(*state) for state in states])
        shape._slip = np.array([one.slip_parameter for one in found])
        shape._alphabar = np.array([one.alphabar for one in found])
        thinned = np.log1p(INLET_VISCOSITY * shape._media[:, 0, 6])
        slip = np.log(shape._slip)
        parts = np.sqrt(film), np.log(shape.l), np.log(shape.kappa), thinned, slip, np.abs(slip)
        shape._state = np.stack([*parts, np.log(shape._alphabar), np.exp(log_p)], axis=-1)
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

    def seen_under_slip(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> SlidingSeen:
        """Return waves, of each contact one or all of the only contact.

        Coordinates are of the contact H^(1/2), ln L, ln kappa, ln(1 + 100 B0), ln S and its
        absolute value, ln(alpha ph) and P at the centre; of the wave cos^2 of its angle,
        ln(lambda/a), |R|^2, psi - kx, each part bounded, |a|^2 and ln x of :class:`Shape`.
        """
        rolled = self.seen(wavelength_over_a, angle_deg)
        rolling = self._chart.film_of(rolled) if self._rolling is None else self._rolling
        number, theta = 2 * np.pi / np.asarray(wavelength_over_a, float), np.radians(angle_deg)
        kx = np.maximum(number * np.cos(theta), 2 * np.pi / STANDING)
        ky = number * np.sin(theta)
        length = launch_length(self.load, self.l, self._alphabar, self._law[len(SLIP_POWERS) :])
        none = np.zeros(1)
        known = Launch(
            none, none, none, self._slip, kx**2 / (kx**2 + ky**2), self.load, length, none
        )
        launch = _launch(kx, ky, self._media, known)
        loss, turn = launch.mismatch.imag, launch.mismatch.real
        parts = (
            launch.along,
            rolled.coordinates[:, 3],
            np.abs(rolling) ** 2,
            loss / (1 + np.abs(loss) / 2),
            turn / (1 + np.abs(turn) / 3),
            np.abs(launch.attenuated) ** 2,
            rolled.coordinates[:, 0],
        )
        state = np.broadcast_to(self._state, (kx.size, self._state.shape[1]))
        coordinates = np.column_stack([state, *parts])
        return SlidingSeen(
            coordinates, kx, ky, self._media, rolling, self._law, launch, rolled.compliance
        )

    @cached_property
    def _chart(self) -> "Chart":
        """Of the only contact in pure rolling."""
        return rolling_chart(self._contacts[0])


def _media(contact: Conditions, film: float, pressure: float) -> list[tuple[float, ...]]:
    """Return the state of the centre under slip and in pure rolling."""
    c = contact
    scales = c.oil, c.kappa, c.alphabar, c.lambdabar, film
    return [astuple(hertz_medium(*scales, slip, pressure)) for slip in (c.slip_parameter, 1.0)]


def _launch(kx: Floats, ky: Floats, media: Floats, known: Launch) -> Launch:
    """Return what the state of the centre decides on, beside what is known."""
    under_slip, both = Medium(*media[:, 0].T), Medium(*media.T)
    psi = both.complementary_number(np.stack([kx * known.slip, kx + 0 * known.slip]), ky)
    return replace(
        known,
        attenuated=under_slip.attenuated(kx, ky, known.slip),
        mismatch=psi[0] - kx,
        mismatch_rolling=psi[1] - kx,
        thinning=under_slip.thinning,
    )
