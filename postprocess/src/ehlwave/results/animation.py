"""A march in motion: film and pressure over the contact and along rolling, as GIF or MP4."""

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib import rc_context
from matplotlib.animation import FFMpegWriter
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from PIL import Image

from ehlwave.errors import ResultsError
from ehlwave.results.case_figures import (
    FILM_SHOWN,
    REACH,
    STYLE,
    Units,
    conditions_text,
    draw_map,
    units_of,
)
from ehlwave.results.case_file import central_film
from ehlwave.results.figures import COLOURS
from ehlwave.results.instants import fields_at, instants
from ehlwave.results.map_panel import rolling_arrow
from ehlwave.writing import Writer

DOTS_PER_INCH = 120
Update = Callable[[xr.Dataset], None]


def write_animation(
    case: xr.Dataset,
    path: str | Path,
    writer: Writer | None = None,
    frames_per_second: float = 10.0,
) -> Path:
    """Write a march in motion; return the path.

    Parameters
    ----------
    case : xarray.Dataset
        From :func:`ehlwave.read_case`, of a march with ``fields_every``.
    path : path
        File to write. Its ending chooses the format: ``.gif`` by Pillow, ``.mp4`` by ffmpeg.
    writer : Writer, optional
        Writer to replace; a new one by default.
    frames_per_second : float
        Speed of the film; each stored instant is one frame.

    Raises
    ------
    ResultsError
        If the file has no fields over time, or the format is not available.
    """
    target = Path(path)
    if not (np.isfinite(frames_per_second) and 0 < frames_per_second <= 100):
        raise ResultsError(f"frames_per_second = {frames_per_second:g} is outside 0 to 100")
    if target.suffix not in (".gif", ".mp4"):
        raise ResultsError(f"{target}: an animation is a .gif or .mp4 file")
    if target.suffix == ".mp4" and not FFMpegWriter.isAvailable():
        raise ResultsError(f"{target}: ffmpeg is missing: install it, or write a .gif file")
    count = instants(case).size
    chosen = writer or Writer()
    with rc_context(STYLE):
        figure, update = animated_figure(case)

        def frames() -> Iterator[Figure]:
            for number in range(count):
                update(fields_at(case, number))
                yield figure

        if target.suffix == ".gif":
            return chosen.gif(target, _pictures(frames()), round(1000 / frames_per_second))
        return chosen.file(target, lambda part: _mp4(part, frames(), frames_per_second))


def animated_figure(case: xr.Dataset) -> tuple[Figure, Update]:
    """Return the picture of the first instant, and a function that shows another one in it."""
    units, first = units_of(case), fields_at(case, 0)
    is_line = case["y"].size == 1
    highest = float(case["pressure_over_time"].max()) * units.pressure
    panels = 1 if is_line else 3
    figure = Figure(figsize=(3.4 * panels, 3.3), layout=ConstrainedLayoutEngine(w_pad=0.12))
    *maps, line = figure.subplots(1, panels, squeeze=False)[0]
    thickest = FILM_SHOWN * central_film(case) * units.film
    looks = (("film", "viridis", thickest, units.film, units.names[2]),)
    looks += (("pressure", "magma", highest, units.pressure, units.names[3]),)
    meshes = []
    for axes, (name, colours, most, scale, title) in zip(maps, looks, strict=False):
        field = first[name]
        mesh = draw_map(axes, field, units, scale, colours, most, name == "film")
        axes.set_title(f"{name}, {title}")
        meshes.append((name, scale, mesh))
    if maps:
        rolling_arrow(maps[0])
    update_line = _draw_line(line, first, units, (thickest, highest))

    def update(case_then: xr.Dataset) -> None:
        for name, scale, mesh in meshes:
            mesh.set_array(case_then[name].values * scale)
        update_line(case_then)
        figure.suptitle(conditions_text(case_then, units), fontsize=9)

    update(first)
    return figure, update


def _draw_line(axes: Axes, case: xr.Dataset, units: Units, tops: tuple[float, float]) -> Update:
    """Draw film and pressure along rolling; return the function that renews them."""
    right = axes.twinx()
    looks = (("film", axes, units.film), ("pressure", right, units.pressure))
    x = case["x"].values * units.x
    curves = []
    for (name, panel, scale), colour, top, label in zip(
        looks, COLOURS, tops, units.names[2:4], strict=False
    ):
        (curve,) = panel.plot(x, np.zeros_like(x), color=colour)
        panel.set_ylim(0, 1.1 * top)
        panel.set_ylabel(label, color=colour)
        curves.append((name, scale, curve))
    axes.set(xlabel=units.names[0], title="along rolling, $y = 0$")
    axes.set_xlim(*(units.x * np.clip([case["x"].min(), case["x"].max()], -REACH, REACH)))

    def update(case_then: xr.Dataset) -> None:
        middle = case_then.sel(y=0, method="nearest")
        for name, scale, curve in curves:
            curve.set_ydata(middle[name].values * scale)

    return update


def _pictures(frames: Iterator[Figure]) -> list[Image.Image]:
    """Return the frames with a palette of their own each, dithered, since GIF has 256 colours."""
    pictures = []
    for figure in frames:
        canvas = FigureCanvasAgg(figure)
        figure.set_dpi(DOTS_PER_INCH)
        canvas.draw()
        full = Image.fromarray(np.asarray(canvas.buffer_rgba())[:, :, :3].copy())
        palette = full.quantize(256, Image.Quantize.MAXCOVERAGE)
        pictures.append(full.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG))
        figure.set_layout_engine("none")  # the layout of the first frame holds for all
    return pictures


def _mp4(path: Path, frames: Iterator[Figure], per_second: float) -> None:
    film = FFMpegWriter(fps=max(1, round(per_second)), extra_args=["-f", "mp4"])
    for number, figure in enumerate(frames):
        if number == 0:
            FigureCanvasAgg(figure)
            film.setup(figure, str(path), DOTS_PER_INCH)
        film.grab_frame()
    film.finish()
