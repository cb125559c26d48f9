"""Units and steps of a measured surface: those of the file, or of the user where it has none."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ehlwave.errors import SurfaceError
from ehlwave.quantities import is_quantity, number
from ehlwave.surface.raw_surface import RawSurface, numbers_of
from ehlwave.surface.read_options import ReadOptions
from ehlwave.surface.surface import uniform_step
from ehlwave.surface.units import metres

LARGEST_STEP_DIFFERENCE = 1e-3
"""Relative, between a given step and the file's."""

LONGEST_M, LONGEST_STEP_M, SMALLEST_STEP_M = 10.0, 0.01, 1e-12
"""Lengths that no measured surface exceeds, and the step that none falls below."""


def height_unit(file: Path, raw: RawSurface, said: str | None) -> float:
    """Return the unit of heights, m: the file's, or the user's where it has none."""
    value = _unit(file, _first(raw.height_unit, said), "heights", "height_unit=")
    if said is None or raw.height_unit is None:
        return value
    given = metres(said, str(file))
    largest = float(np.nanmax(np.abs(raw.height), initial=0)) * value
    if given != value and largest > LONGEST_M:
        return given  # no surface is as high as the file states
    _refuse_contradiction(file, "height_unit=", said, given, raw.height_unit, value)
    return value


def _refuse_contradiction(
    file: Path, option: str, said: str, given: float, own: str, value: float
) -> None:
    if given != value:
        raise SurfaceError(
            f"{file}: {option}{said} contradicts the file, whose unit is {own}: leave it out"
        )


def steps(file: Path, raw: RawSurface, options: ReadOptions) -> tuple[float, float]:
    """Return the steps along x and y of the file, m."""
    length = _unit(file, _first(options.length_unit, raw.length_unit), "lengths", "length_unit=")
    own = length if raw.length_unit is None else metres(raw.length_unit, str(file))
    step, across = raw.step, raw.step_across
    if raw.x is not None:
        step = uniform_step(_positions(file, raw.x, raw.height.shape[-1], "x"), f"{file}: x")
    if raw.y is not None and raw.height.ndim == 2:
        across = uniform_step(_positions(file, raw.y, raw.height.shape[0], "y"), f"{file}: y")
    step, across = (None if value is None else value * own / length for value in (step, across))
    said = _said(file, "step", options.step, length)
    said_across = _said(file, "step_across", options.step_across, length)
    if raw.height.ndim == 1 and said_across is not None:
        if not raw.is_across:
            raise SurfaceError(
                f"{file}: step_across={options.step_across} is of a map, and this is a trace: "
                "remove it"
            )
        said, said_across = said_across, None
    if said is None and said_across is None and options.length_unit is not None and raw.length_unit:
        _refuse_contradiction(
            file, "length_unit=", options.length_unit, length, raw.length_unit, own
        )
    if _is_impossible(raw, step, across, length):
        if said is None:
            size = f"a step of {(step or 0) * length * 1e6:.4g} um"
            raise SurfaceError(
                f"{file}: states {size} over {raw.height.shape[-1]} points, a size that no surface "
                "has: give the right step by step= and length_unit=, which replace it"
            )
        step = across = None
    step = _agreed(file, "step=", said, step)
    across = _agreed(file, "step_across=", said_across, across)
    if step is None:
        hint = "; commas were taken as decimal ones" if raw.has_decimal_commas else ""
        raise SurfaceError(f"{file}: has no positions: give the sampling step by step={hint}")
    return step * length, (step if across is None else across) * length


def _is_impossible(
    raw: RawSurface, step: float | None, across: float | None, length: float
) -> bool:
    """Return whether the file states a size that no surface has."""
    counts = raw.height.shape[::-1]
    return any(
        value is not None
        and not (
            SMALLEST_STEP_M <= value * length <= LONGEST_STEP_M
            and value * length * count <= LONGEST_M
        )
        for value, count in zip((step, across), counts, strict=False)
    )


def _said(file: Path, name: str, step: Any, length: float) -> float | None:  # noqa: ANN401
    """Return a step given by the user, in the unit of lengths, m, where it has none itself."""
    if is_quantity(step):
        return number(step, f"{name}_m", str(file)) / length
    return None if step is None else number(step, name, str(file))


def _agreed(file: Path, option: str, said: float | None, own: float | None) -> float | None:
    """Return the step from the user or the file; both only where they agree."""
    if said is None or own is None:
        return own if said is None else said
    if not abs(said - own) <= LARGEST_STEP_DIFFERENCE * abs(own):
        raise SurfaceError(
            f"{file}: {option}{said:g} contradicts the file, whose step is {own:.6g}: leave it "
            "out, or give a file of the heights alone"
        )
    return own


def _positions(file: Path, positions: np.ndarray, count: int, name: str) -> np.ndarray:
    values = numbers_of(file, positions).astype(np.float64)
    if values.shape != (count,):
        raise SurfaceError(
            f"{file}: {values.size} positions along {name} for {count} heights; they must match"
        )
    return values


def _first(said: str | None, own: str | None) -> str | None:
    return own if said is None else said


def _unit(file: Path, unit: str | None, what: str, option: str) -> float:
    if unit is None:
        raise SurfaceError(f"{file}: states no unit of its {what}: set {option} (m, mm, um, nm)")
    return metres(unit, str(file))
