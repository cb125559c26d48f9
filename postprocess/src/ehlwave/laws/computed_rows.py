"""Waves of a contact by ``ehlwave-sweep``: linear responses, and what passing temperatures add."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.heat_data import Heat
from ehlwave.error_bars import bar
from ehlwave.errors import RangeError
from ehlwave.laws.computed_waves import AMPLITUDE, error_of, film_of
from ehlwave.laws.transfer import Waves
from ehlwave.programs.case_input import case_keys
from ehlwave.programs.computing import Result, is_usable, run_waves
from ehlwave.programs.progress import Following

ACCURACY, FINER_ACCURACY = 0.05, 0.015
"""Relative errors of Ad/Ai that are asked for: of all waves, and of those that turn out worse than
`LARGE_ERROR`. Asking for less at once takes up to 50 times as long for short waves."""
LARGE_ERROR = 0.025
"""Absolute error of a computed wave above which it is computed again."""
STARVED_ACCURACY, LARGE_STARVED_ERROR = 0.2, 0.04
"""Relative error that is asked for waves of starved contacts at first, and absolute error above
which they are computed again: little is left of long waves, and a small relative error takes ten
times as long."""
STARVED_SHORT, SHORT_CELLS, OTHER_CELLS = 0.2, 640, 96
"""Wavelength over a below which starved contacts have a grid that is fine along the wave alone:
2 s a wave, where the plan of an accuracy takes half a minute."""
LINE_X = 1000.0
"""Wavelength along X, over a, of waves along a line contact: the program takes no infinite one."""
MOST_FROZEN = 0.3
"""Largest error by frozen temperatures; above it there is no answer without marches."""
NEGLIGIBLE_FROZEN = 0.05
"""Error by frozen temperatures below which linear responses answer alone."""
NEWTONIAN_FROZEN = bar("frozen.newtonian")
"""Factor on the program's estimate of this error, for Newtonian oils under slip."""
SMALL, CHANGE_ERROR = 0.02, bar("frozen.change")
"""Ai over the film of marches. Error of the change by passing temperatures, over the change."""
LINE_CELLS: dict[str, Any] = {"cells_x": 256}
CELLS: tuple[dict[str, Any], ...] = (
    {"cells_x": 96, "cells_y": 64},
    {"cells_x": 192, "cells_y": 96},
)
"""Grids of marches: of lines, of other contacts, and of those that the first does not resolve. Only
the change by passing temperatures counts, which needs fewer cells than the response."""
MARCHED = "amplitude_ratio_fit", "phase_fit"


class ComputedRows:
    """Computed waves of a contact, by their direction.

    Parameters
    ----------
    conditions : Conditions
        Contact of any shape, oil and slip; flooded or starved.
    heat : Heat or None
        Heat data.
    progress : callable, False or None
        As of :meth:`ehlwave.Study.run`.

    Attributes
    ----------
    frozen : float
        Largest error of linear responses by temperatures that are frozen as waves pass.
    """

    def __init__(self, conditions: Conditions, heat: Heat | None, progress: Following) -> None:
        self.frozen = 0.0
        self._conditions = conditions
        self._heat = heat
        self._progress = progress
        self._keys = case_keys(conditions, heat) | {
            "orientation": "custom",
            "response": "harmonic",
            "amplitude_over_film": AMPLITUDE,
        }

    def linear(self, waves: Waves, angle: float) -> list[Result]:
        """Return linear responses of a direction, with frozen temperatures."""
        keys, every = self._keys, self._columns(waves, angle)
        if self._conditions.is_starved:
            rows = self._starved(waves, every)
            self._keep_frozen(rows)
            return rows
        if 0 < angle < 90:  # products of cosines have another rise
            keys = keys | {"mean_rise": False}
        rows = self._run(keys | {"accuracy": ACCURACY}, every)
        self._keep_frozen(rows)
        if self.frozen > NEGLIGIBLE_FROZEN:  # a smaller error of the grid would not count
            return rows
        return self._finer(rows, keys | {"accuracy": FINER_ACCURACY}, every, LARGE_ERROR)

    def _finer(
        self,
        rows: list[Result],
        keys: dict[str, Any],
        every: Sequence[dict[str, float]],
        most: float,
    ) -> list[Result]:
        """Return rows of which those with an error above the most are computed again."""
        coarse = [k for k, row in enumerate(rows) if error_of(row) > most]
        better = self._run(keys, [every[k] for k in coarse])
        for k, row in zip(coarse, better, strict=True):
            rows[k] = row if error_of(row) < error_of(rows[k]) else rows[k]
        return rows

    def _starved(self, waves: Waves, every: Sequence[dict[str, float]]) -> list[Result]:
        """Return responses of a starved contact, each on a grid for its wavelength."""
        grids: list[dict[str, Any]] = []
        for wave, lengths in zip(waves, every, strict=True):
            along_x = 0 < lengths["wavelength_x_over_a"] < 2 * STARVED_SHORT
            along_y = 0 < lengths["wavelength_y_over_a"] < 2 * STARVED_SHORT
            if wave < STARVED_SHORT and not self._conditions.is_line:
                fine = (SHORT_CELLS if short else OTHER_CELLS for short in (along_x, along_y))
                grids.append(dict(zip(("cells_x", "cells_y"), fine, strict=True)))
            else:
                grids.append({"accuracy": STARVED_ACCURACY})
        found: dict[int, Result] = {}
        shared = self._keys | {"mean_rise": False}
        for grid in [grid for k, grid in enumerate(grids) if grid not in grids[:k]]:
            here = [k for k, own in enumerate(grids) if own == grid]
            rows = self._run(shared | grid, [every[k] for k in here])
            found |= dict(zip(here, rows, strict=True))
        rows = [found[k] for k in range(len(every))]
        needed = [
            lengths
            | {"accuracy": LARGE_STARVED_ERROR / max(abs(film_of(row)), LARGE_STARVED_ERROR)}
            for row, lengths in zip(rows, every, strict=True)
        ]
        return self._finer(rows, shared, needed, LARGE_STARVED_ERROR)

    def changes(self, waves: Waves, angle: float) -> list[Result]:
        """Return what marches add that carry the temperatures of oil and surfaces.

        The film of a row is the response of a march less the linear response on the same grid.
        """
        keys = self._keys | {"response": "both", "amplitude_over_film": SMALL}
        keys |= {"wave_temperatures": "carried", "mean_rise": False}
        every = self._columns(waves, angle)
        first, *finer = (LINE_CELLS,) if self._conditions.is_line else CELLS
        rows = self._run(keys | first, every)
        for grid in finer:
            left = [k for k, row in enumerate(rows) if not is_usable(row)]
            again = self._run(keys | grid, [every[k] for k in left])
            for k, row in zip(left, again, strict=True):
                rows[k] = row
        return [_change(row) for row in rows]

    def warms(self, angle: float) -> bool:
        """Return whether temperatures that change as waves pass matter, and marches have them."""
        if self._heat is None or angle == 90 or (self._conditions.is_line and angle > 0):
            return False
        wave = self._columns(np.array([1.0]), angle)
        return self._frozen_error(self._run(self._keys | {"accuracy": ACCURACY}, wave)) > (
            NEGLIGIBLE_FROZEN
        )

    def check_frozen(self) -> None:
        """Raise RangeError where the error by frozen temperatures is too large."""
        if self.frozen > MOST_FROZEN:
            raise RangeError(
                f"the contact warms so far that linear responses may be {self.frozen:.2g} of Ai "
                "off, and marches do not take such waves: leave heat out"
            )

    def _run(self, keys: dict[str, Any], waves: Sequence[dict[str, float]]) -> list[Result]:
        return run_waves(keys, waves, self._progress)

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

    def _keep_frozen(self, rows: Sequence[Result]) -> None:
        if self._heat is not None:
            self.frozen = max(self.frozen, self._frozen_error(rows))

    def _frozen_error(self, rows: Sequence[Result]) -> float:
        c = self._conditions
        slides = not c.rolls and c.oil.name == "Newtonian"
        factor = NEWTONIAN_FROZEN if slides else 1.0
        found = [float(row.get("frozen_heat_error") or 0.0) * factor for row in rows]
        return max((one for one in found if math.isfinite(one)), default=0.0)


def _change(row: Result) -> Result:
    """Return the row with the march less the linear response as its film, and the error of it."""
    size, phase = (float(row.get(key) or math.nan) for key in MARCHED)
    parts = {"real": size * math.cos(phase), "imaginary": size * math.sin(phase)}
    change = {
        f"harmonic_{part}": value - float(row.get(f"harmonic_{part}") or math.nan)
        for part, value in parts.items()
    }
    return row | change | {"error_estimate": CHANGE_ERROR} | _NO_LIMIT


_NO_LIMIT = dict.fromkeys(
    (
        f"harmonic_{kind}{part}"
        for kind in ("extrapolated_", "pressure_", "pressure_extrapolated_")
        for part in ("real", "imaginary")
    ),
    math.nan,
)
