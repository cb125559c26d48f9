"""Transfer from the atlas: amplitude and phase, and their errors, of each harmonic component."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RectBivariateSpline

from ehlwave.atlas.atlas import Atlas, Chart, load_atlas
from ehlwave.atlas.ranges import WAVE_RANGE
from ehlwave.deform.conditions import Conditions, moes_film
from ehlwave.deform.transfer import Waves
from ehlwave.errors import RangeError
from ehlwave.formula import recommended_ratio

Complex = NDArray[np.complex128]

WAVES, ANGLES = 72, 31
"""Of the chart that is interpolated for maps, over ln wavelength and angle."""

SHORT_WAVE_POWER = 1.5
"""Waves below the atlas: 1 - response falls with this power of the wavelength, as it does above."""


@dataclass(frozen=True)
class Lookup:
    """Interpolation in a chart: functions of ln wavelength and angle, degrees."""

    film: Callable[[Waves, Waves], Complex]
    error: Callable[[Waves, Waves], Waves]
    rise: Callable[[Waves, Waves], Waves]


class AtlasTransfer:
    """Film responses of the atlas for a contact in pure rolling.

    Waves shorter than the atlas have nearly their whole amplitude: 1 - T continues with the power
    3/2 of the wavelength. Longer ones hardly any: T falls as the recommended formula does. Of both
    the error counts as large as what is continued, so that they stand in the error of the whole.
    """

    def __init__(self, conditions: Conditions, atlas: Atlas | None = None) -> None:
        """Draw the chart of the contact.

        Raises
        ------
        RangeError
            A ValueError: the contact lies outside the atlas, there is slip, or the oil has laws of
            viscosity or density that the atlas does not.
        """
        if conditions.slip_parameter != 1:
            raise RangeError(
                f"slip_parameter = {conditions.slip_parameter:g}: the atlas holds pure rolling, "
                "slip_parameter = 1; give a harmonic table of this slip"
            )
        if conditions.oil.other_laws:
            laws = ", ".join(conditions.oil.other_laws)
            raise RangeError(f"{laws}: the atlas holds Roelands' oil; give a harmonic table")
        self._conditions = conditions
        self._atlas = atlas or load_atlas()
        self._chart: Chart = self._atlas.at(conditions.atlas_keys())
        self._lookups: dict[str, Lookup] = {}

    @property
    def name(self) -> str:
        """What it is."""
        return self._atlas.name

    @property
    def covers_all(self) -> bool:
        """The atlas ends somewhere."""
        return False

    @property
    def outside_reason(self) -> str:
        """Why components are not covered."""
        low, high = WAVE_RANGE
        return f"of wavelengths outside {low:g} to {high:g} a: continued, counted in the error"

    def ratio(self, per_length_x: Waves, per_length_y: Waves) -> Complex:
        """Return the transfer for waves per metre along x (any sign) and y; 0 for the mean."""
        wave, angle, shape = self._polar(per_length_x, per_length_y)
        inside = np.clip(wave, *WAVE_RANGE)
        value = self._lookup(angle).film(np.log(inside), angle)
        short = wave < inside
        value[short] = 1 - (1 - value[short]) * (wave[short] / inside[short]) ** SHORT_WAVE_POWER
        value *= self._fall(wave, inside, angle)
        value = value.reshape(shape)
        value.imag *= np.sign(np.broadcast_to(per_length_x, shape))
        return value

    def error(self, per_length_x: Waves, per_length_y: Waves) -> Waves:
        """Return the error of the transfer, absolute, in units of the amplitude before."""
        wave, angle, shape = self._polar(per_length_x, per_length_y)
        inside = np.clip(wave, *WAVE_RANGE)
        error = self._lookup(angle).error(np.log(inside), angle)
        continued = wave != inside
        if np.any(continued):
            ratio = np.abs(self.ratio(per_length_x, per_length_y).ravel()[continued])
            error[continued] += np.where(
                wave[continued] < inside[continued], np.abs(1 - ratio), ratio
            )
        error[~np.isfinite(wave)] = 0  # the mean is not deformed
        return error.reshape(shape)

    def rise(self, per_length_x: Waves, per_length_y: Waves) -> Waves | None:
        """Return what waves add to the mean film, to second order; None: the atlas has no rises.

        Shorter waves than the atlas' add as much as its shortest; longer ones less, as the square
        of their response.
        """
        if not self._atlas.has_rises:
            return None
        wave, angle, shape = self._polar(per_length_x, per_length_y)
        inside = np.clip(wave, *WAVE_RANGE)
        value = self._lookup(angle).rise(np.log(inside), angle)
        return np.asarray(value * self._fall(wave, inside, angle) ** 2).reshape(shape)

    def is_covered(self, per_length_x: Waves, per_length_y: Waves) -> NDArray[np.bool_]:
        """Return whether a wave lies within the wavelengths of the atlas."""
        wave, _, shape = self._polar(per_length_x, per_length_y)
        return ((wave >= WAVE_RANGE[0]) & (wave <= WAVE_RANGE[1])).reshape(shape)

    def _polar(
        self, per_length_x: Waves, per_length_y: Waves
    ) -> tuple[Waves, Waves, tuple[int, ...]]:
        """Return wavelengths over a and angles, degrees, of flattened waves, and their shape."""
        qx, qy = np.broadcast_arrays(np.abs(per_length_x), np.abs(per_length_y))
        with np.errstate(divide="ignore"):
            wave = 1 / (np.hypot(qx, qy) * self._conditions.semi_axis_a_m)
        wave, angle = wave.ravel(), np.degrees(np.arctan2(qy, qx)).ravel()
        angle[~np.isfinite(wave)] = angle[-1]  # the mean has no direction
        return wave, angle, qx.shape

    def _fall(self, wave: Waves, inside: Waves, angle: Waves) -> Waves:
        """Return by how much less than at the end of the atlas is left of longer waves."""
        fall, long = np.ones(wave.shape), wave > inside
        if np.any(long):
            c = self._conditions
            theta = np.radians(angle[long])
            shares = np.cos(theta), np.sin(theta)
            at, end = (
                recommended_ratio(
                    c.m,
                    c.l,
                    c.gamma,
                    *(np.where(s > 1e-9, w / np.maximum(s, 1e-9), 0) for s in shares),
                )
                for w in (np.minimum(wave[long], 1e9), inside[long])
            )
            fall[long] = np.where(np.isfinite(wave[long]), at / end, 0)
        return fall

    def _lookup(self, angle: Waves) -> Lookup:
        """Return interpolation in a chart over ln wavelength and angle, or along one angle."""
        one = float(angle[-1]) if np.all(angle == angle[-1]) else None
        key = "map" if one is None else f"{one:g}"
        if key not in self._lookups:
            logs = np.linspace(*np.log(WAVE_RANGE), WAVES)
            angles = np.linspace(0, 90, ANGLES) if one is None else np.array([one])
            waves = np.exp(logs)[:, None], angles[None, :]
            found, rise = self._chart.responses(*waves), self._chart.rise(*waves)
            parts = [found.film.real, found.film.imag, found.error]
            parts.append(np.zeros(found.error.shape) if rise is None else rise)
            if one is None:
                splines = [RectBivariateSpline(logs, angles, part) for part in parts]
                evaluated = [lambda log, angle, s=s: s.ev(log, angle) for s in splines]
            else:
                evaluated = [lambda log, angle, p=p[:, 0]: np.interp(log, logs, p) for p in parts]
            real, imaginary, error, rises = evaluated
            self._lookups[key] = Lookup(
                lambda log, angle: real(log, angle) + 1j * imaginary(log, angle),
                lambda log, angle: np.maximum(error(log, angle), 0),
                rises,
            )
        return self._lookups[key]


def with_atlas_film(conditions: Conditions, atlas: Atlas | None = None) -> Conditions:
    """Return conditions with the atlas' central film in place of that of a formula.

    A given film stays; so does the formula's where there are no lengths, or outside the atlas.
    """
    if conditions.metres_per_moes is None or conditions.film_source.startswith("given"):
        return conditions
    chosen = atlas or load_atlas()
    film = chosen.at(conditions.atlas_keys()).film(
        moes_film(conditions.m, conditions.l, conditions.d)
    )
    source = f"atlas, within {100 * film.central_error:.1g} %"
    return replace(
        conditions,
        central_film_m=film.central_moes * conditions.metres_per_moes,
        film_source=source,
    )
