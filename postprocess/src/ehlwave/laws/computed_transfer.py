"""Transfer whose responses are computed by ``ehlwave-sweep``, for contacts without a law."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.heat_data import Heat
from ehlwave.contact.two_waves import two_waves
from ehlwave.errors import RangeError
from ehlwave.laws.answers import Response
from ehlwave.laws.atlas.ranges import WAVE_RANGE
from ehlwave.laws.atlas_transfer import SHORT_WAVE_POWER, AtlasTransfer
from ehlwave.laws.computed_angles import map_of
from ehlwave.laws.computed_film import computed_film
from ehlwave.laws.computed_waves import (
    AMPLITUDE,
    FIRST,
    MOST,
    Base,
    Complex,
    Responses,
    error_of,
    no_base,
    refined,
)
from ehlwave.laws.transfer import Waves
from ehlwave.programs.case_input import case_keys
from ehlwave.programs.computing import Result, is_usable, run_waves
from ehlwave.programs.progress import Following

ACCURACY, FINER_ACCURACY = 0.05, 0.015
"""Relative errors of Ad/Ai that are asked for: of all waves, and of those that turn out worse than
`LARGE_ERROR`. Asking for less at once takes up to 50 times as long for short waves."""
LARGE_ERROR = 0.025
"""Absolute error of a computed wave above which it is computed again."""
TOLERANCE, STARVED_TOLERANCE = 0.01, 0.02
"""Errors of the interpolation, absolute, below the errors of the atlases and of the law of starved
contacts.
"""
STARVED_WAVES, MOST_STARVED, FIRST_STARVED = (0.2, 4.0), 11, 5
"""Wavelengths over a of starved contacts, their largest and first number. A shorter wave needs
a grid that takes half a minute: it is continued, and its error covers this.
"""
STARVED_LONG, LONG_ACCURACY = 0.7, 0.2
"""Wavelength over a from which on starved contacts have the second relative error: little is left
of such waves, and a small relative error takes ten times as long.
"""
FINE = 161
"""Points of the tables that replace the splines."""
LOGS = np.linspace(math.log(WAVE_RANGE[0]), math.log(WAVE_RANGE[1]), FINE)
LINE_X = 1000.0
"""Wavelength along X, over a, of waves along a line contact: the program takes no infinite one."""
MOST_FROZEN = 0.3
"""Largest error by frozen temperatures; above it there is no answer."""
NEGLIGIBLE_FROZEN = 0.05
"""Error by frozen temperatures below which linear responses answer; above it marches do."""
MARCHED, MOST_MARCHED, MARCHED_ACCURACY, SMALL = (0.3, 3.0), 13, 0.05, 0.02
"""Marches: wavelengths over a, largest number, accuracy, and Ai over the film."""
MARCHED_ELLIPSE, MOST_ELLIPSE, FIRST_ELLIPSE = (0.5, 3.0), 9, 5
"""Limits of contacts other than lines, and the number of their first waves."""
FINER: dict[str, Any] = {"cells_x": 256, "cells_y": 128}
"""Grid of marches that stall on the planned one."""
MARCHED_COLUMNS = "amplitude_ratio_fit", "phase_fit"
NEWTONIAN_FROZEN = 2.0
"""Factor on the program's estimate of this error, for Newtonian oils under slip."""

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
        self._keys = case_keys(conditions, heat) | {
            "orientation": "custom",
            "response": "harmonic",
            "amplitude_over_film": AMPLITUDE,
            "accuracy": ACCURACY,
        }
        self._curves: dict[float, Responses] = {}
        self._lookups: dict[str, Callable[[Waves, Waves], Waves]] = {}
        self._asked: tuple[Waves, Waves] | None = None
        self._frozen = 0.0

    def __getstate__(self) -> dict[str, Any]:
        """Return the pickled state: waves come from the cache of the programs again."""
        return super().__getstate__() | {"_curves": {}, "_progress": False}

    @property
    def name(self) -> str:
        """Return its description."""
        return SOURCE

    @property
    def outside_reason(self) -> str:
        """Why components are not covered."""
        low, high = WAVE_RANGE
        return f"of wavelengths outside {low:g} to {high:g} a: continued, counted in the error"

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
        return Response(complex(film), complex(pressure), float(error) + self._frozen, self.name)

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
            bases: list[Base] = [no_base]
            if base := self._law(angle):
                bases.append(base)
            rows, ends, most, first = self._rows, WAVE_RANGE, MOST, FIRST
            if self._warms(angle):
                rows, ends, most, first = self._marches, MARCHED, MOST_MARCHED, FIRST
                if not self._conditions.is_line:  # a march takes up to a minute
                    ends, most, first = MARCHED_ELLIPSE, MOST_ELLIPSE, FIRST_ELLIPSE
            tolerance = TOLERANCE
            if self._conditions.is_starved:
                tolerance, ends = STARVED_TOLERANCE, STARVED_WAVES
                most, first = MOST_STARVED, FIRST_STARVED
            self._curves[angle] = refined(
                lambda waves: rows(waves, angle), ends, tolerance, bases, most, first
            )
        return self._curves[angle]

    def _rows(self, waves: Waves, angle: float) -> Sequence[Result]:
        """Compute linear responses of a direction."""
        keys, every = self._keys, self._columns(waves, angle)
        if 0 < angle < 90 or self._conditions.is_starved:  # products of cosines have another rise
            keys = keys | {"mean_rise": False}
        if self._conditions.is_starved:  # the finest grid that a plan takes
            keys = {key: value for key, value in keys.items() if key != "accuracy"}
            for wave, columns in zip(waves, every, strict=True):
                columns["accuracy"] = ACCURACY if wave < STARVED_LONG else LONG_ACCURACY
        rows = run_waves(keys, every, self._progress)
        self._judge_heat(rows)
        if self._conditions.is_starved:
            return rows
        coarse = [k for k, row in enumerate(rows) if error_of(row) > LARGE_ERROR]
        finer = keys | {"accuracy": FINER_ACCURACY}
        better = run_waves(finer, [every[k] for k in coarse], self._progress)
        for k, row in zip(coarse, better, strict=True):
            rows[k] = row if error_of(row) < error_of(rows[k]) else rows[k]
        return rows

    def _columns(self, waves: Waves, angle: float) -> list[dict[str, float]]:
        """Return wavelengths along X and Y; 0: infinite."""
        cosine, sine = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        no_x = LINE_X if self._conditions.is_line else 0.0
        return [
            {
                "wavelength_x_over_a": float(wave / cosine) if angle < 90 else no_x,
                "wavelength_y_over_a": float(wave / sine) if angle > 0 else 0.0,
            }
            for wave in waves
        ]

    def _warms(self, angle: float) -> bool:
        """Return whether temperatures that change as waves pass matter, and marches have them."""
        if self._heat is None or angle == 90 or (self._conditions.is_line and angle > 0):
            return False
        rows = run_waves(self._keys, self._columns(np.array([1.0]), angle), self._progress)
        return self._frozen_error(rows) > NEGLIGIBLE_FROZEN

    def _marches(self, waves: Waves, angle: float) -> Sequence[Result]:
        """Compute marches of a direction that carry the temperatures of oil and surfaces."""
        keys = self._keys | {
            "response": "transient",
            "amplitude_over_film": SMALL,
            "wave_temperatures": "carried",
            "accuracy": MARCHED_ACCURACY,
            "mean_rise": None,
        }
        every = self._columns(waves, angle)
        rows = run_waves(keys, every, self._progress)
        # Marches that stall on a coarse grid are repeated on a finer grid.
        stalled = [k for k, row in enumerate(rows) if not is_usable(row)]
        finer = keys | {"accuracy": None} | FINER
        if self._conditions.is_line:
            finer.pop("cells_y")
        again = run_waves(finer, [every[k] for k in stalled], self._progress)
        for k, row in zip(stalled, again, strict=True):
            rows[k] = row
        for row in rows:
            size, phase = (float(row.get(key) or math.nan) for key in MARCHED_COLUMNS)
            row["harmonic_real"] = size * math.cos(phase)
            row["harmonic_imaginary"] = size * math.sin(phase)
            row["harmonic_extrapolated_real"] = math.nan
        return rows

    def _frozen_error(self, rows: Sequence[Result]) -> float:
        c = self._conditions
        slides = not c.rolls and c.oil.name == "Newtonian"
        factor = NEWTONIAN_FROZEN if slides else 1.0
        found = [float(row.get("frozen_heat_error") or 0.0) * factor for row in rows]
        return max((one for one in found if math.isfinite(one)), default=0.0)

    def _judge_heat(self, rows: Sequence[Result]) -> None:
        """Keep the error by frozen temperatures; refuse contacts where it is unreliable."""
        if self._heat is None:
            return
        self._frozen = max(self._frozen, self._frozen_error(rows))
        if self._frozen > MOST_FROZEN:
            raise RangeError(
                f"the contact warms so far that linear responses may be {self._frozen:.2g} of Ai "
                "off, and marches do not take such waves: leave heat out"
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
        error = error + self._frozen + np.where(short, abs(1 - film), 0) + long * abs(film)
        return np.stack([film.real, film.imag, error, rise])

    def _along(self, angle: float) -> Callable[[Waves, Waves], Waves]:
        logs, parts = LOGS, self._parts(angle)
        return lambda log, _: np.stack([np.interp(log, logs, part) for part in parts])
