"""Both waves of a contact from computed responses, between which they are interpolated."""

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator

from ehlwave.contact.two_waves import TwoWaves
from ehlwave.surface import Conditions

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class ComputedWaves:
    """Both waves at Y = 0 of patterns cos(ky Y) exp(i kx X), from a table over kx and ky.

    Replaces a :class:`ehlwave.surface.TwoWaveTransfer`. Interpolated are a, psi - kx, and c exp(-i
    (psi - kx)), which turns slowly; a and psi are the closed forms at the computed contact centre,
    c the film there less a. Longer waves than the longest take its response, the mean 0; shorter
    waves than the shortest stay unchanged.
    """

    conditions: Conditions
    """Conditions of the contact, with its computed film."""
    table: pd.DataFrame
    """Linear responses at all combinations of wavelengths along X and Y; 0 is infinite."""
    name: str = "computed waves"

    def waves(self, per_length_x: Floats, per_length_y: Floats) -> TwoWaves:
        """Return both waves for waves per metre along x (above 0) and y."""
        kx, ky = self._numbers(per_length_x), self._numbers(np.abs(per_length_y))
        moving = self.table[self.table["wavelength_x_over_a"] > 0]
        along, across = (np.unique(_numbers(moving[name])) for name in _WAVELENGTHS)
        a, psi, film = (
            self._on_grid(moving, name)
            for name in ("attenuated_formula", "psi_formula", "harmonic")
        )
        mismatch = psi - along[:, None]
        launched = (film - a) * np.exp(-1j * mismatch)
        places = np.stack([np.clip(kx, along[0], along[-1]), np.clip(ky, 0, across[-1])], axis=-1)
        own, between, entering = (
            RegularGridInterpolator((along, across), values)(places)
            for values in (a, mismatch, launched)
        )
        shorter = (kx > along[-1]) | (ky > across[-1])
        own[shorter], entering[shorter], between[shorter] = 1.0, 0.0, 0.0
        return TwoWaves(own, entering * np.exp(1j * between), kx, kx + between)

    def ratio(self, per_length_x: Floats, per_length_y: Floats) -> Complex:
        """Return the response to ridges along rolling, which are stationary; 0 for the mean."""
        still = self.table[self.table["wavelength_x_over_a"] == 0]
        film = _complex(still, "harmonic")
        ky = _numbers(still["wavelength_y_over_a"])
        order = np.argsort(ky)
        known, values = np.append(0.0, ky[order]), np.append(0.0, film[order])
        return np.asarray(np.interp(self._numbers(np.abs(per_length_y)), known, values, right=1.0))

    def _numbers(self, per_length: Floats) -> Floats:
        return np.asarray(2 * np.pi * per_length * self.conditions.semi_axis_a_m)

    def _on_grid(self, moving: pd.DataFrame, name: str) -> Complex:
        """Return values over kx and ky, both ascending."""
        placed = moving.assign(value=_complex(moving, name))
        for column in _WAVELENGTHS:
            placed[column] = _numbers(placed[column])
        return placed.pivot(index=_WAVELENGTHS[0], columns=_WAVELENGTHS[1], values="value").values


_WAVELENGTHS = ["wavelength_x_over_a", "wavelength_y_over_a"]


def _numbers(wavelength: pd.Series) -> Floats:
    """Return wave numbers, 1/a; 0 of infinite waves."""
    waves = wavelength.to_numpy()
    return np.divide(2 * np.pi, waves, out=np.zeros(waves.shape), where=waves > 0)


def _complex(table: pd.DataFrame, name: str) -> Complex:
    return np.asarray(table[f"{name}_real"].to_numpy() + 1j * table[f"{name}_imaginary"].to_numpy())
