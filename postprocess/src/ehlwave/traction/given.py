"""Keys and ratios that friction over the slide-to-roll ratio takes."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ehlwave.errors import ArgumentError, SurfaceError
from ehlwave.inputs.key_values import values_of
from ehlwave.inputs.namelist import read_namelist

UNUSED = ("waviness", "waviness2", "surface", "surface2", "dynamics")
"""Groups that friction of a smooth contact in its steady state does not depend on."""


def read_keys(path: str | Path) -> dict[str, Any]:
    """Return the keys of an input file of ``ehlwave-case``, whatever their group.

    Raises ArgumentError if the file is none, or has waves or lists of a sweep.
    """
    if not Path(path).is_file():
        raise ArgumentError(f"{path}: no such file: give an input file of ehlwave-case")
    try:
        file = read_namelist(path)
    except SurfaceError as error:
        raise ArgumentError(str(error)) from error
    for name in ("sweep", *UNUSED):
        if any(group == name for group, _ in file.entries):
            raise ArgumentError(
                f"{path}: has &{name}: friction over slip is computed for a smooth contact in "
                "a steady state: remove it"
            )
    try:
        groups = values_of(file)
    except SurfaceError as error:
        raise ArgumentError(str(error)) from error
    return {key: value for group in groups.values() for key, value in group.items()}


def checked_ratios(ratios: Sequence[float], has_heat: bool) -> list[float]:
    """Return the slide-to-roll ratios in rising order."""
    try:
        chosen = sorted({float(ratio) for ratio in ratios})
    except (TypeError, ValueError):
        raise ArgumentError(f"ratios = {ratios}: give numbers, such as 0.01 0.1 1") from None
    if len(chosen) < 2 or not all(0 < ratio <= 2 for ratio in chosen):
        said = ", ".join(f"{ratio:g}" for ratio in chosen)
        raise ArgumentError(
            f"ratios = {said}: give two or more slide-to-roll ratios above 0 and at most 2"
        )
    if has_heat and chosen[-1] == 2:
        raise ArgumentError("ratios: 2 is a surface at rest, which &heat refuses: give less than 2")
    return chosen
