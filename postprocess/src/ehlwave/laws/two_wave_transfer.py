"""Transfers under slip from the law of the two waves.

A pattern that slides makes two waves in the film: the first moves with the surface, the second with
the oil (:mod:`ehlwave.contact.two_waves`). At the contact centre their sum is a transfer like any
other; at other places their phases differ.
"""

from dataclasses import dataclass

from numpy.typing import NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.line_contact import ROLLS_ALONE
from ehlwave.contact.rolling import rolling_transfer
from ehlwave.contact.two_waves import (
    FITTED_RANGES,
    MOST_CARREAU_SHEAR,
    SLIP_ERRORS,
    TwoWaves,
    two_waves,
)
from ehlwave.duals import np, placed
from ehlwave.errors import SurfaceError
from ehlwave.laws.sheared_ridges import ridges_under_slip
from ehlwave.laws.transfer import LawBasis, Waves

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class TwoWaveTransfer(LawBasis):
    """Amplitude and phase by the law of the two waves, and by its rolling transfer where S = 1.

    Ridges along rolling are stationary: they have the amplitude of pure rolling, plus the effect of
    a shear-thinning oil (:mod:`ehlwave.laws.sheared_ridges`). The ratio of the mean is 0: the load
    moves the bodies until it is carried.

    Raises
    ------
    SurfaceError
        If the surface does not move (S = 0), or the contact is a line.
    """

    conditions: Conditions
    name: str = "law of the two waves"

    def __post_init__(self) -> None:
        """Refuse a surface at rest, and line contacts."""
        if self.conditions.is_line:
            raise SurfaceError(f"the law of the two waves is of elliptical contacts; {ROLLS_ALONE}")
        if self.conditions.slip_parameter <= 0:
            raise SurfaceError("slip_parameter = 0: the surface stands still, nothing is launched")

    def waves(self, per_length_x: Waves, per_length_y: Waves) -> TwoWaves:
        """Return both waves for waves per metre along x (above 0) and y."""
        contact = self.conditions
        wave_x = 1 / (per_length_x * contact.semi_axis_a_m)
        return two_waves(contact, contact.slip_parameter, wave_x, self._wavelength(per_length_y))

    def ratio(self, per_length_x: Waves, per_length_y: Waves) -> Complex:
        """Return the transfer for waves per metre along x (any sign) and y."""
        along, across = np.broadcast_arrays(per_length_x, np.abs(per_length_y))
        moves = along != 0
        moving = self.waves(np.abs(along[moves]), across[moves]).at(0.0)
        value = placed(moves, moving.real + 1j * (moving.imag * np.sign(along[moves])))
        stands = ~moves & (across > 0)
        contact = self.conditions
        point = (contact.m, contact.l, contact.gamma)
        ridges = self._wavelength(across[stands])
        film = contact.medium(1.0).h
        rolling = rolling_transfer(*point, 0.0, ridges)
        return placed(stands, ridges_under_slip(contact, film, ridges, rolling)[0], value)

    def error(self, per_length_x: Waves, per_length_y: Waves) -> Waves | None:
        """Return the error of the law for this oil; None outside the conditions of its fit."""
        if not self.covers_all:
            return None
        shape = np.broadcast_shapes(np.shape(per_length_x), np.shape(per_length_y))
        return np.full(shape, SLIP_ERRORS[self.conditions.oil.name])

    def reasons(self) -> list[str]:
        """Return which of M, L, D, S and the laws of the oil are outside the fit."""
        contact = self.conditions
        values = {"M": contact.m, "L": contact.l, "D": contact.d, "S": contact.slip_parameter}
        ranges = [
            f"{name} = {values[name]:.4g}: the law was fitted to {low:g} to {high:g}"
            for name, (low, high) in FITTED_RANGES.items()
            if not low <= values[name] <= high
        ]
        sheared = zip(contact.stresses_in_inlet, MOST_CARREAU_SHEAR, strict=True)
        if contact.oil.name == "Carreau" and any(stress > most for stress, most in sheared):
            ranges.append("of an oil that thins in the inlet more than in the fit of the law")
        return ranges + [f"{law}: the law was fitted to others" for law in contact.oil.other_laws]

    def _wavelength(self, per_length: Waves) -> Floats:
        """Return wavelengths in units of a; zero for an infinite wavelength."""
        with np.errstate(divide="ignore"):
            return np.where(per_length > 0, 1 / (per_length * self.conditions.semi_axis_a_m), 0.0)
