"""Transfer whose responses are computed by ``ehlwave-sweep``, for contacts without a law."""

import contextlib
import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.heat_data import Heat
from ehlwave.contact.two_waves import two_waves
from ehlwave.errors import ProgramError, RangeError
from ehlwave.laws.answers import Response
from ehlwave.laws.atlas.ranges import WAVE_RANGE
from ehlwave.laws.atlas_transfer import SHORT_WAVE_POWER, AtlasTransfer
from ehlwave.laws.computed_angles import map_of
from ehlwave.laws.computed_film import computed_film
from ehlwave.laws.computed_rows import ComputedRows
from ehlwave.laws.computed_waves import (
    FIRST,
    MOST,
    Base,
    Complex,
    Responses,
    changed,
    no_base,
    refined,
)
from ehlwave.laws.transfer import Waves
from ehlwave.programs.progress import Following

TOLERANCE, STARVED_TOLERANCE, CHANGE_TOLERANCE = 0.01, 0.02, 0.02
"""Errors of the interpolation, absolute, below the errors of the atlases and of the law of starved
contacts; of the changes by passing temperatures."""
MOST_STARVED, FIRST_STARVED = 13, 7
"""Numbers of the waves of starved contacts: largest, and first."""
CHANGED_LINE, CHANGED = (0.3, 3.0), (0.5, 3.0)
"""Wavelengths over a of marches, of lines and of other contacts."""
MOST_CHANGES, FIRST_CHANGES = 9, 5
"""Numbers of marches, some seconds each: largest, and first."""
FINE = 161
"""Points of the tables that replace the splines."""
LOGS = np.linspace(math.log(WAVE_RANGE[0]), math.log(WAVE_RANGE[1]), FINE)

SOURCE = "computed by ehlwave-sweep"


class ComputedTransfer(AtlasTransfer):
    """Amplitude and phase of computed waves, interpolated.

    Only the requested directions are computed: one for a trace, several for a map. Waves outside
    the computed range are continued as in the atlas.

    Parameters
    ----------
    conditions : Conditions
        Contact of any shape, oil and slip; flooded or starved.
    heat : Heat, optional
        Heat data. Temperatures are frozen at the smooth contact as waves pass, and the error covers
        this.
    progress : callable or False, optional
        As of :meth:`ehlwave.Study.run`.

    Raises
    ------
    RangeError
        If waves slide on a starved contact, or if the central film is given.
    """

    def __init__(
        self, conditions: Conditions, heat: Heat | None = None, progress: Following = None
    ) -> None:
        if conditions.is_starved and not conditions.rolls:
            raise RangeError(
                "waves on a starved contact need pure rolling (slip_parameter = 1): under slip the "
                "two layers of oil move apart, which neither laws nor programs have"
            )
        self._conditions = conditions
        self._heat = heat
        self._progress = progress
        self._rows = ComputedRows(conditions, heat, progress)
        self._curves: dict[float, Responses] = {}
        self._lookups: dict[str, Callable[[Waves, Waves], Waves]] = {}
        self._asked: tuple[Waves, Waves] | None = None

    def __getstate__(self) -> dict[str, Any]:
        """Return the pickled state: waves come from the cache of the programs again."""
        return super().__getstate__() | {"_curves": {}, "_progress": False}

    @property
    def name(self) -> str:
        """Return its description."""
        return SOURCE

    def rise(self, per_length_x: Waves, per_length_y: Waves) -> Waves:
        """Return the rise of the mean film by waves; None where it is not known."""
        found = super().rise(per_length_x, per_length_y)
        return found if np.all(np.isfinite(found)) else None  # type: ignore[return-value]

    def response(self, wavelength_over_a: float, angle_deg: float) -> Response:
        """Return film, pressure and error of a wave; its direction is computed.

        Parameters
        ----------
        wavelength_over_a, angle_deg : float
            As of :meth:`ehlwave.Contact.response`.

        Raises
        ------
        RangeError
            If the wavelength lies outside the computed range.
        ProgramError
            If there is no program, or if it does not solve the waves.
        """
        curve, log = self.curve(angle_deg), math.log(wavelength_over_a)
        if not curve.log[0] - 1e-9 <= log <= curve.log[-1] + 1e-9:
            low, high = np.exp(curve.log[[0, -1]])
            raise RangeError(
                f"wavelength_over_a = {wavelength_over_a:.5g} lies outside {low:.3g} to "
                f"{high:.3g}, the computed waves"
            )
        film, pressure, error, _ = curve.at(np.array(log))
        return Response(complex(film), complex(pressure), float(error), self.name)

    def pressure(self, per_length_x: Waves, per_length_y: Waves) -> Complex:
        """Return the amplitude of the pressure over Ai, ph/c, for waves per metre along x and y.

        Only directions that were computed have it; NaN elsewhere, and outside the computed waves.
        """
        wave, angle, shape = self._polar(per_length_x, per_length_y)
        found = np.full(wave.shape, complex(np.nan, np.nan))
        for one in np.unique(angle.round(6)):
            curve, here = self._curves.get(float(one)), angle.round(6) == one
            if curve is not None:
                with np.errstate(divide="ignore"):
                    log = np.log(wave[here])
                inside = (log >= curve.log[0] - 1e-9) & (log <= curve.log[-1] + 1e-9)
                found[here] = np.where(inside, curve.at(log)[1], complex(np.nan, np.nan))
        found = found.reshape(shape)
        found.imag *= np.sign(np.broadcast_to(per_length_x, shape))
        return found

    def curve(self, angle_deg: float) -> Responses:
        """Return the computed responses along a direction, in degrees from rolling."""
        angle = round(float(angle_deg), 6)
        if angle not in self._curves:
            self._curves[angle] = self._computed(angle)
        return self._curves[angle]

    def _computed(self, angle: float) -> Responses:
        """Return linear responses, of a warm contact with the changes by passing temperatures."""
        bases: list[Base] = [no_base]
        if base := self._law(angle):
            bases.append(base)
        tolerance, most, first = TOLERANCE, MOST, FIRST
        if self._conditions.is_starved:
            tolerance, most, first = STARVED_TOLERANCE, MOST_STARVED, FIRST_STARVED
        rows = self._rows
        rows.frozen = 0.0
        found = refined(
            lambda waves: rows.linear(waves, angle), WAVE_RANGE, tolerance, bases, most, first
        )
        if rows.warms(angle):
            with contextlib.suppress(ProgramError):  # marches that stall leave frozen temperatures
                return changed(found, self._changes(angle))
        rows.check_frozen()
        return replace(found, error=found.error + rows.frozen)

    def _changes(self, angle: float) -> Responses:
        ends = CHANGED_LINE if self._conditions.is_line else CHANGED
        waves = {"most": MOST_CHANGES, "first": FIRST_CHANGES}
        return refined(
            lambda waves: self._rows.changes(waves, angle), ends, CHANGE_TOLERANCE, **waves
        )

    def _law(self, angle: float) -> Base | None:
        """Return the law of the two waves for a direction; None in rolling and of line contacts."""
        c = self._conditions
        if c.slip_parameter in (0, 1) or c.is_line or angle == 90 or c.oil.other_laws:
            return None
        film = computed_film(c, self._heat, self._progress)
        if film.central_m is not None:
            c = replace(c, central_film_m=film.central_m, film_source=film.source)
        cosine, sine = math.cos(math.radians(angle)), math.sin(math.radians(angle))

        def law(waves: Waves) -> Any:  # noqa: ANN401 - complex array
            across = waves / sine if angle > 0 else 0.0
            return two_waves(c, c.slip_parameter, waves / cosine, across).at(0.0)

        return law

    def _lookup(self, angle: Waves) -> Callable[[Waves, Waves], Waves]:
        """Return film (real, imaginary), error and rise over ln wavelength and angle."""
        one = float(angle[-1]) if np.all(angle == angle[-1]) else None
        key = "map" if one is None else f"{one:g}"
        if key not in self._lookups:
            self._lookups[key] = (
                map_of(self._parts, LOGS, TOLERANCE) if one is None else self._along(one)
            )
        return self._lookups[key]

    def _parts(self, angle: float) -> Waves:
        """Return the columns of `_lookup` at evenly spaced ln wavelengths; ends are continued."""
        logs, curve = LOGS, self.curve(angle)
        film, _, error, rise = curve.at(logs)
        short, long = logs < curve.log[0] - 1e-9, logs > curve.log[-1] + 1e-9
        kept = np.exp(np.minimum(logs - curve.log[0], 0.0) * SHORT_WAVE_POWER)
        film = (1 - (1 - film.real) * kept) + 1j * film.imag * kept
        error = error + np.where(short, abs(1 - film), 0) + long * abs(film)
        return np.stack([film.real, film.imag, error, rise])

    def _along(self, angle: float) -> Callable[[Waves, Waves], Waves]:
        logs, parts = LOGS, self._parts(angle)
        return lambda log, _: np.stack([np.interp(log, logs, part) for part in parts])
