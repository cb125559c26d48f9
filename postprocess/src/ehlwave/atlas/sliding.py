"""The coordinates of contacts that slide, and what of their responses is interpolated."""

import json
from collections.abc import Mapping
from dataclasses import astuple, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ehlwave.atlas.coordinates import (
    Complex,
    Floats,
    Shape,
    columns,
    contact_coordinates,
    wave_components,
)
from ehlwave.atlas.ranges import SLIDING_RANGES
from ehlwave.deform.conditions import MOES_KEYS, Conditions, conditions_from_keys, moes_film
from ehlwave.medium import INLET_VISCOSITY, Medium, log_viscosity
from ehlwave.two_waves import LAUNCH_LENGTH, SLIP_POWERS, Launch, launch_length, launched

STANDING = 1e4
"""Wavelength along X, in units of a, of waves that hardly move: those of 90 degrees."""

INSTALLED = np.array([*SLIP_POWERS, *LAUNCH_LENGTH])
"""The coefficients of :mod:`ehlwave.two_waves`."""

STRESS_POINTS = 24
"""Of the quadrature over the Hertz contact."""

MODULUS_PA = 2.2e11
"""Of steel bodies. Of E' and the Eyring stress their product alone counts."""


def sliding_coordinates(keys: Mapping[str, ArrayLike]) -> Floats:
    """Return the coordinates of contacts, shape (c, 7), by columns named as their keys.

    Those of contacts that roll, S, and ln of the Newtonian stress at S = 2 in the inlet over the
    Eyring stress.
    """
    stress = [np.log(INLET_VISCOSITY * one.medium(2.0).thinning) for one in conditions_of(keys)]
    slip = np.atleast_1d(np.asarray(keys["slip_parameter"], dtype=float))
    return np.column_stack([contact_coordinates(keys), slip, stress])


def conditions_of(keys: Mapping[str, ArrayLike]) -> list[Conditions]:
    """Return the conditions of contacts given by columns named as their keys."""
    table = map(np.atleast_1d, columns(keys, SLIDING_RANGES))
    return [_conditions(*map(float, row)) for row in zip(*table, strict=True)]


@lru_cache(maxsize=4096)
def _conditions(*values: float) -> Conditions:
    keys = dict(zip(SLIDING_RANGES, values, strict=True))
    stress = {
        "reduced_modulus_pa": MODULUS_PA,
        "eyring_stress_pa": keys.pop("stress_modulus_pa2") / MODULUS_PA,
    }
    return conditions_from_keys(keys | stress, "atlas", needs_lengths=False)


def mean_stress(contact: Conditions) -> float:
    """Return the mean of asinh(B) under the Hertz pressure: shear over Eyring stress, for its slip.

    Without pressure gradients, with the film of the centre everywhere.
    """
    oil = contact.oil
    hertz_pa = contact.alphabar / oil.pressure_viscosity_per_pa
    nodes, weights = np.polynomial.legendre.leggauss(STRESS_POINTS)
    pressure = hertz_pa * np.sqrt((1 - nodes) / 2)  # over squares of the distance from the centre
    viscosity = log_viscosity(oil.pressure_viscosity_per_pa, oil.roelands_index, pressure)
    thinning = contact.medium(contact.slip_parameter).thinning
    return float(weights @ np.arcsinh(thinning * np.exp(viscosity)) / 2)


def rolling_film(contact: Conditions) -> tuple[float, float]:
    """Return central and smallest film in pure rolling, Moes scale, of the atlas of that."""
    from ehlwave.atlas.atlas import load_atlas

    keys = replace(contact, slip_parameter=1.0).atlas_keys()
    film = load_atlas().at(keys).film(moes_film(contact.m, contact.l, contact.d))
    return film.central_moes, film.minimum_moes


class SlidingShape(Shape):
    """What turns responses of sliding contacts into numbers that hardly change, and back.

    The film response is taken less the law of the two waves, which begins with the transfer that
    the atlas of rolling contacts has; the pressure response as there. The law's coefficients are
    fitted to the points of the atlas.
    """

    OF_ALL = ("_last", "_law", "_rolling")
    _contacts: NDArray[np.object_]
    _rolling: Complex | None
    _law: Floats
    _last: tuple[tuple[object, ...], Launch, Complex] | None

    @classmethod
    def of_keys(
        cls, keys: Mapping[str, ArrayLike], attributes: Mapping[str, Any]
    ) -> "SlidingShape":
        """Return that of contacts given by columns named as their keys, and of the atlas' law."""
        shape = cls(*map(np.atleast_1d, columns(keys, MOES_KEYS)))
        found = conditions_of(keys)
        shape._contacts = np.empty(len(found), dtype=object)
        shape._contacts[:] = found
        shape._rolling = shape._last = None
        shape._law = np.array(json.loads(attributes["law"])) if "law" in attributes else INSTALLED
        return shape

    def with_rolling(self, rolling: Complex) -> "SlidingShape":
        """Return the same with known transfers of pure rolling, one for each contact."""
        self._rolling, self._last = rolling, None
        return self

    def with_law(self, law: Floats) -> "SlidingShape":
        """Return the same with other coefficients: the powers, then those of the length."""
        self._law = law
        return self

    def wave_coordinates(self, wavelength: ArrayLike, angle_deg: ArrayLike) -> Floats:
        """Return the coordinates of waves, shape (n, 6): as in rolling, |a|, the phase of R."""
        launch, rolling = self._launch(wavelength, angle_deg)
        rolled = super().wave_coordinates(wavelength, angle_deg)
        more = np.abs(launch.attenuated), np.angle(rolling)
        parts = np.broadcast_arrays(*np.moveaxis(rolled, -1, 0), *more)
        return np.stack(parts, axis=-1)

    def law_and_spread(
        self, wavelength: ArrayLike, angle_deg: ArrayLike
    ) -> tuple[Complex, Complex]:
        """Return the law of the two waves at the contact centre, and the phase of the launched one.

        The law crosses zero where its waves cancel.
        """
        launch, rolling = self._launch(wavelength, angle_deg)
        powers = tuple(self._law[: len(SLIP_POWERS)])
        law = np.asarray(launch.attenuated + launched(rolling, launch, powers))
        return law, np.exp(1j * launch.mismatch.real * (1 - launch.length))

    def formula(self, wavelength: ArrayLike, angle_deg: ArrayLike) -> Complex:
        """Return the law of the two waves at the contact centre."""
        return self.law_and_spread(wavelength, angle_deg)[0]

    def transfer(self, wavelength: Floats, angle_deg: Floats) -> Complex:
        """Return the transfers in pure rolling of waves of the only contact."""
        from ehlwave.atlas.atlas import load_atlas

        keys = replace(self._contacts[0], slip_parameter=1.0).atlas_keys()
        return load_atlas().at(keys).film_response(wavelength, angle_deg)

    def _launch(self, wavelength: ArrayLike, angle_deg: ArrayLike) -> tuple[Launch, Complex]:
        """Return what decides on the launch of waves, and their transfers in pure rolling.

        Of each contact one wave, or all of the only contact. What was found last is still known.
        """
        waves = np.broadcast_arrays(np.asarray(wavelength, float), np.asarray(angle_deg, float))
        asked = (*(one.tobytes() for one in waves), waves[0].shape)
        if self._last is None or self._last[0] != asked:
            rolling = self.transfer(*waves) if self._rolling is None else self._rolling
            self._last = asked, self._found(*waves), rolling
        _, launch, rolling = self._last
        l = np.array([one.l for one in self._contacts])  # noqa: E741
        alphabar = np.array([one.alphabar for one in self._contacts])
        length = launch_length(launch.load, l, alphabar, self._law[len(SLIP_POWERS) :])
        return replace(launch, length=length), rolling

    def _found(self, wavelength: Floats, angle_deg: Floats) -> Launch:
        along, across = wave_components(wavelength, angle_deg)
        kx = 2 * np.pi / np.where(along > 0, np.minimum(along, STANDING), STANDING)
        with np.errstate(divide="ignore"):
            ky = np.where(across > 0, 2 * np.pi / across, 0.0)
        contacts = self._contacts
        slip = np.array([one.slip_parameter for one in contacts])
        load = np.array([one.gamma * one.m for one in contacts])
        under_slip = _together([one.medium(one.slip_parameter) for one in contacts])
        rolling = _together([one.medium(1.0) for one in contacts])
        return Launch(
            under_slip.attenuated(kx, ky, slip),
            under_slip.complementary_number(kx * slip, ky) - kx,
            rolling.complementary_number(kx, ky) - kx,
            slip,
            kx**2 / (kx**2 + ky**2),
            load,
            np.zeros(load.shape),  # of the law: see _launch
            np.asarray(under_slip.thinning),
        )


def _together(media: list[Medium]) -> Medium:
    """Return the states of several contacts as one of arrays."""
    return Medium(*(np.array(column) for column in zip(*map(astuple, media), strict=True)))
