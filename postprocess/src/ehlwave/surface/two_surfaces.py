"""The film between two rough surfaces that move with S and 2 - S: the sum of both responses."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from ehlwave.errors import SurfaceError
from ehlwave.shown import Shown, micrometres
from ehlwave.surface.predict import Deformed
from ehlwave.writing import Writer

Floats = NDArray[np.float64]

UM = 1e6


@dataclass(frozen=True, repr=False)
class FilmOfTwo(Shown):
    """Film at the contact centre, m, while two deformed surfaces pass it; see :func:`film_of_two`.

    ``rolled_m`` counts the way of the mean speed, in steps of the finer surface. ``film_m`` is NaN
    where the surfaces touch.
    """

    rolled_m: Floats
    film_m: Floats

    mean_film_m: float
    rq_m: float
    """Root mean square of the film about its mean: what both surfaces leave."""

    @property
    def smallest_film_m(self) -> float | None:
        """Smallest film, m; None where the surfaces touch."""
        return None if self.surfaces_touch else float(np.min(self.film_m))

    @property
    def surfaces_touch(self) -> bool:
        """Whether no film is left somewhere."""
        return bool(np.isnan(self.film_m).any())

    def _shown_rows(self) -> dict[str, str]:
        """Return films and Rq."""
        least = "none: the surfaces touch" if self.surfaces_touch else ""
        return {
            "mean film": micrometres(self.mean_film_m),
            "Rq": micrometres(self.rq_m),
            "smallest film": least or micrometres(self.smallest_film_m),
        }

    def text(self) -> str:
        """Return the report."""
        least = self.smallest_film_m
        said = "the surfaces touch: no smallest film"
        if least is not None:
            said = f"smallest {least * UM:.4g} um"
        return (
            f"Both         film at the centre, mean {self.mean_film_m * UM:.4g} um, "
            f"Rq {self.rq_m * UM:.4g} um, {said}, over {self.rolled_m[-1] * UM:.4g} um of rolling"
        )

    def summary(self) -> dict[str, float | bool | None]:
        """Return the report as numbers, m."""
        return {
            "mean_film_m": self.mean_film_m,
            "film_rq_m": self.rq_m,
            "smallest_film_m": self.smallest_film_m,
            "surfaces_touch": self.surfaces_touch,
            "rolled_m": float(self.rolled_m[-1]),
        }

    def write(self, path: Path, writer: Writer | None = None) -> Path:
        """Write it as CSV, um."""
        table = pd.DataFrame({"rolled_um": self.rolled_m * UM, "film_um": self.film_m * UM})
        options = {"float_format": "%.9g", "lineterminator": "\r\n"}
        return (writer or Writer()).table(path, table, **options)


def film_of_two(first: Deformed, second: Deformed) -> FilmOfTwo:
    """Return the film at the contact centre from the deformed heights of both surfaces.

    Their leading ends are at the centre together; it ends with the surface that has passed first.
    Maps are taken along their middle lines. Linear: the effect of a surface on the other is of
    second order. A surface at rest (S = 0) stays with its leading end at the centre.

    Raises
    ------
    SurfaceError
        If the film thickness is not known, or a surface has no length along rolling.
    """
    film = first.conditions.central_film_m
    if film is None:
        raise SurfaceError("the film thickness is unknown: give central_film_m or radius_x_m")
    both = (first, second)
    for one in both:
        if one.height.shape[0] == 1:
            raise SurfaceError(f"{one.surface.name}: a trace across rolling does not pass")
    moving = [one for one in both if one.conditions.slip_parameter > 0]
    lengths = [_length(one) / one.conditions.slip_parameter for one in moving]
    step = min(one.surface.step_x_m / one.conditions.slip_parameter for one in moving)
    rolled = np.arange(0.0, min(lengths) + 0.5 * step, step)
    deformed = [_passing(one, rolled) for one in both]
    # Changes of the means in the linear prediction belong to the film, not to the roughness.
    mean = film if first.statistics.mean_film_m is None else first.statistics.mean_film_m
    if second.statistics.mean_film_m is not None:
        mean += second.statistics.mean_film_m - film
    height = mean - deformed[0] - deformed[1]
    left = np.where(height > 0, height, np.nan)
    return FilmOfTwo(rolled, left, float(np.mean(height)), float(np.std(height)))


def _length(one: Deformed) -> float:
    return (one.height.shape[0] - 1) * one.surface.step_x_m


def _passing(one: Deformed, rolled: Floats) -> Floats:
    """Return the deformed height at the contact centre, m, after so much rolling."""
    place = np.arange(one.height.shape[0]) * one.surface.step_x_m
    line = one.height[:, one.height.shape[1] // 2]
    return np.interp(_length(one) - one.conditions.slip_parameter * rolled, place, line)
