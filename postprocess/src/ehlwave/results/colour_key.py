"""Colours of points by the values of a column, and their legend or colour bar."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm, Normalize, to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ehlwave.errors import ResultsError
from ehlwave.results.labels import SHORT
from ehlwave.results.schema import DIMENSION

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")
"""Colours that stay apart for colour-blind readers (Okabe and Ito)."""

MOST_NAMED = len(COLOURS)
"""Values that have a colour and a name each; more numbers have a colour bar."""

LOG_FROM = 10.0
"""Largest over smallest value from which the colour bar is logarithmic."""

_MAP = "viridis"


@dataclass(frozen=True)
class Colours:
    """Colours of the values of a column; ``norm`` where they belong to a colour bar."""

    column: str
    by_value: dict[float | str, str]
    norm: Normalize | None


def colours_of(points: xr.Dataset, column: str) -> Colours:
    """Return the colours of the values that a column of points has.

    Raises ResultsError if there is no such column, or it has more words than there are colours, or
    no numbers.
    """
    if column not in points.variables or points[column].dims != (DIMENSION,):
        columns = ", ".join(sorted(str(name) for name in points.data_vars)[:8])
        raise ResultsError(f"--color-by {column}: no such column; there are {columns}, ...")
    values = points[column].values
    if values.dtype.kind not in "fiu":
        names = sorted(set(values.tolist()))
        if len(names) > MOST_NAMED:
            raise ResultsError(f"--color-by {column}: {len(names)} words; at most {MOST_NAMED}")
        return Colours(column, dict(zip(names, COLOURS, strict=False)), None)
    numbers = np.unique(values[np.isfinite(values)])
    if numbers.size == 0:
        raise ResultsError(f"--color-by {column}: has no numbers at these points")
    if numbers.size <= MOST_NAMED:
        return Colours(column, dict(zip(numbers.tolist(), COLOURS, strict=False)), None)
    is_wide = numbers[0] > 0 and numbers[-1] > LOG_FROM * numbers[0]
    norm = (LogNorm if is_wide else Normalize)(numbers[0], numbers[-1])
    shades = [to_hex(colormaps[_MAP](norm(number))) for number in numbers]
    return Colours(column, dict(zip(numbers.tolist(), shades, strict=True)), norm)


def draw_key(figure: Figure, panels: Sequence[Axes], colours: Colours) -> None:
    """Draw the key of the colours: a legend in the last panel, or a colour bar."""
    name = SHORT.get(colours.column) or colours.column
    if colours.norm is not None:
        shown = ScalarMappable(colours.norm, _MAP)
        figure.colorbar(shown, ax=list(panels), label=name)
        return
    handles = [
        Line2D([], [], linestyle="none", marker="o", markersize=4.5, color=shade, label=_text(one))
        for one, shade in colours.by_value.items()
    ]
    panels[-1].legend(
        handles=handles,
        title=name,
        loc="lower left",
        frameon=False,
        title_fontsize=8,
    )


def _text(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:g}"
