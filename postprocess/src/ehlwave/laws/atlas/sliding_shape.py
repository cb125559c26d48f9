"""Waves under slip as the atlas of contacts that slide sees them."""

from collections.abc import Mapping
from copy import copy
from dataclasses import astuple
from functools import cached_property

from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.conditions import MOES_KEYS, Conditions
from ehlwave.contact.medium import INLET_VISCOSITY, Medium, hertz_medium
from ehlwave.contact.two_waves import (
    LAUNCH_LENGTH,
    SLIP_POWERS,
    Launch,
    launch_length,
    launched,
)
from ehlwave.duals import np
from ehlwave.laws.atlas.chart import Chart
from ehlwave.laws.atlas.coordinates import Complex, Floats, columns
from ehlwave.laws.atlas.rolling import rolling_chart
from ehlwave.laws.atlas.shape import Seen, Shape
from ehlwave.laws.atlas.sliding import conditions_of

STANDING = 1e4
"""Wavelength along X, in units of a, of waves that hardly move: 90 degrees."""


class SlidingShape(Shape):
    """Responses of contacts that slide, by the law of the two waves, T = a + c.

    Two numbers change the ratio of c to the law, two are added to T. The pressure follows from the
    two waves, W(k) P = a - 1 + c W(k)/W(psi). The state of the contact centre has the film and the
    pressure there.
    """

    OF_ALL = ("_rolling", "_chart")
    WAVE_AND_X: tuple[int, ...] = (2, 0)
    """Coordinates of waves that roll which count here: ln(lambda/a) and ln x."""
    POWERS: tuple[float, ...] = SLIP_POWERS
    LENGTH: tuple[float, ...] = LAUNCH_LENGTH
    """Coefficients of the law of the two waves."""

    _contacts: NDArray[np.object_]
    _media: Floats
    _slip: Floats
    _alphabar: Floats
    _state: Floats
    _rolling: Complex | None

    @classmethod
    def of_keys(cls, keys: Mapping[str, ArrayLike]) -> "SlidingShape":
        """Return the shape of contacts.

        Columns are named as the keys of contacts; besides ``central_film``, H, and
        ``pressure_ratio``, ln P, at the centre.
        """
        shape = cls(*map(np.atleast_1d, columns(keys, MOES_KEYS)))
        shape._take(conditions_of(keys), keys)
        return shape

    def _take(self, found: list[Conditions], keys: Mapping[str, ArrayLike]) -> None:
        """Take contacts and the states of their centres."""
        self._contacts = np.empty(len(found), dtype=object)
        self._contacts[:] = found
        film, log_p = map(np.atleast_1d, columns(keys, ("central_film", "pressure_ratio")))
        states = zip(found, film, np.exp(log_p), strict=True)
        self._media = np.array([_media(*state) for state in states])
        self._slip = np.array([one.slip_parameter for one in found])
        self._alphabar = np.array([one.alphabar for one in found])
        thinned = np.log1p(INLET_VISCOSITY * self._media[:, 0, 6])
        parts = np.sqrt(film), *self._lengths(), thinned, *self._slips()
        self._state = np.stack([*parts, np.log(self._alphabar), np.exp(log_p)], axis=-1)
        self._rolling = None

    def _lengths(self) -> tuple[Floats, ...]:
        """Return the coordinates of a contact by L and its ellipticity."""
        return np.log(self.l), np.log(self.kappa)

    def _slips(self) -> tuple[Floats, ...]:
        """Return the coordinates of a contact by its slip."""
        slip = np.log(self._slip)
        return slip, np.abs(slip)

    @staticmethod
    def _rolls(contact: Conditions) -> Chart:
        """Return the chart of a contact in pure rolling."""
        return rolling_chart(contact)

    def rolling_responses(self, wave: Floats, angle_deg: Floats) -> Complex:
        """Return the transfers in pure rolling of waves, one per contact."""
        found = np.empty(wave.size, dtype=complex)
        places: dict[int, list[int]] = {}
        for place, contact in enumerate(self._contacts):
            places.setdefault(id(contact), []).append(place)
        for own in places.values():
            chart = self._rolls(self._contacts[own[0]])
            found[own] = chart.film_response(wave[own], angle_deg[own])
        return found

    def with_rolling(self, rolling: Complex) -> "SlidingShape":
        """Return the shape with known transfers of pure rolling, one for each contact."""
        other = copy(self)
        other._rolling = rolling
        return other

    def seen(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Seen:
        """Return waves, one of each contact or all of the only contact.

        Coordinates are of the contact H^(1/2), ln L, ln kappa, ln(1 + 100 B0), ln S and its
        absolute value, ln(alpha ph) and P at the centre; of the wave cos^2 of its angle,
        ln(lambda/a), ln x of :class:`Shape`, |R|^2, |a|^2 and psi - kx, each part bounded.
        """
        rolled = super().seen(wavelength_over_a, angle_deg)
        rolling = self._chart.film_of(rolled) if self._rolling is None else self._rolling
        number, theta = 2 * np.pi / np.asarray(wavelength_over_a, float), np.radians(angle_deg)
        kx = np.maximum(number * np.cos(theta), 2 * np.pi / STANDING)
        ky = number * np.sin(theta)
        launch = self._launch(kx, ky)
        a, c = launch.attenuated, launched(rolling, launch, self.POWERS)
        loss, turn = launch.mismatch.imag, launch.mismatch.real
        parts = (
            launch.along,
            *rolled.coordinates[:, list(self.WAVE_AND_X)].T,
            np.abs(rolling) ** 2,
            np.abs(a) ** 2,
            loss / (1 + np.abs(loss) / 2),
            turn / (1 + np.abs(turn) / 3),
        )
        states = np.broadcast_to(self._state, (kx.size, self._state.shape[1]))
        waves = np.stack(np.broadcast_arrays(*parts), axis=1)
        coordinates = np.concatenate([states, waves], axis=1)
        psi, one = kx + launch.mismatch, np.ones(kx.shape)
        gain = np.sqrt((psi**2 + ky**2) / (kx**2 + ky**2))
        slopes = np.stack([c, 1j * c, one, 1j * one], axis=-1)
        return Seen(coordinates, a + c, slopes, gain, a - 1 - a * gain, rolled.compliance)

    def _launch(self, kx: Floats, ky: Floats) -> Launch:
        """Return the coordinate of the waves launched by the inlet."""
        under_slip, both = Medium(*self._media[:, 0].T), Medium(*self._media.T)
        psi = both.complementary_number(np.stack([kx * self._moving, kx + 0 * self._slip]), ky)
        return Launch(
            attenuated=under_slip.attenuated(kx, ky, self._slip),
            mismatch=psi[0] - kx,
            mismatch_rolling=psi[1] - kx,
            slip=self._launching,
            along=kx**2 / (kx**2 + ky**2),
            load=self.load,
            length=launch_length(self.load, self.l, self._alphabar, self.LENGTH),
            thinning=under_slip.thinning,
        )

    @property
    def _moving(self) -> Floats:
        """S of the complementary wave."""
        return self._slip

    @property
    def _launching(self) -> Floats:
        """S by which the law of the two waves launches it."""
        return self._slip

    @cached_property
    def _chart(self) -> Chart:
        """Transfer of the only contact in pure rolling."""
        return self._rolls(self._contacts[0])


def _media(contact: Conditions, film: float, pressure: float) -> list[tuple[float, ...]]:
    """Return the state of the centre under slip and in pure rolling."""
    c = contact
    scales = c.oil, c.kappa, c.alphabar, c.lambdabar, film
    return [astuple(hertz_medium(*scales, slip, pressure)) for slip in (c.slip_parameter, 1.0)]
