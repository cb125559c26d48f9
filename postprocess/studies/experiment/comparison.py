"""Films and amplitudes beside the paper's, and their dependence on parameters."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from studies.experiment import paper
from studies.experiment.cases import (
    COSINE,
    GRIDS,
    INCOMPRESSIBLE,
    PAPER_ML,
    SMOOTH,
    SPEEDS,
    TRACE,
    Z_DEFAULT,
    Run,
)
from studies.experiment.conditions import formula_ratio
from studies.experiment.measure import (
    Value,
    extrapolated,
    half_range_um,
    line_amplitude_um,
    line_mean_um,
    middle_um,
    read_solved,
    second_order_mean_um,
    smooth_film_um,
    time_amplitude_um,
    time_mean_um,
)
from studies.experiment.trace import AMPLITUDE_UM
from studies.section import Cell, comparison_row

UM = "um"
MEASURES = {
    "line_mean": line_mean_um,
    "time_mean": time_mean_um,
    "line_amplitude": line_amplitude_um,
    "time_amplitude": time_amplitude_um,
    "half_range": half_range_um,
    "middle": middle_um,
}


@dataclass(frozen=True)
class Films:
    """Results at a speed, um, at mesh size 0; of the trace and of the cosine by measure."""

    speed: float
    smooth: Value
    smooth_mean: Value
    """Mean of the smooth contact over the central region."""
    trace: dict[str, Value]
    cosine: dict[str, Value]
    second_order_mean: Value
    """Mean film of the cosine by its linear response."""
    formula_ratio: float


def read_films(folder: Path, speed: float) -> Films:
    """Read the results of a speed and extrapolate them."""
    smooth = read_solved(folder, Run(SMOOTH, speed, *max(GRIDS)))
    trace, cosine = (
        {name: extrapolated(folder, kind, speed, measure) for name, measure in MEASURES.items()}
        for kind in (TRACE, COSINE)
    )
    return Films(
        speed,
        extrapolated(folder, SMOOTH, speed, smooth_film_um),
        extrapolated(folder, SMOOTH, speed, line_mean_um),
        trace,
        cosine,
        extrapolated(folder, COSINE, speed, second_order_mean_um),
        formula_ratio(smooth),
    )


def film_rows(films: Films, wave_amplitude_um: float) -> Iterator[tuple[Cell, ...]]:
    """Yield a comparison for every film and amplitude the paper gives at a speed.

    ``wave_amplitude_um`` belongs to the wave that was cut from the trace.
    """
    printed, at = paper.PRINTED[films.speed], f" at {films.speed:g} m/s"

    def row(quantity: str, theirs: float | None, ours: Value, remark: str) -> tuple[Cell, ...]:
        return comparison_row(quantity + at, UM, theirs, ours.value, ours.error, remark)

    trace, cosine = films.trace, films.cosine
    yield row("smooth central film", printed.smooth_film, films.smooth, "H(0,0)")
    for theirs, whose in ((printed.computed_mean, "computed"), (printed.measured_mean, "measured")):
        remark = f"paper: {whose}; trace, three waves on the centre line"
        yield row(f"mean film, {whose}", theirs, trace["line_mean"], remark)
        remark = f"paper: {whose}; trace, one wave passing the centre"
        yield row(f"mean film in time, {whose}", theirs, trace["time_mean"], remark)
    remark = "paper: computed; cosine, three waves on the centre line"
    yield row("mean film, cosine", printed.computed_mean, cosine["line_mean"], remark)
    remark = "paper: computed; cosine, linear response and what it adds to the mean, second order"
    yield row("mean film, second order", printed.computed_mean, films.second_order_mean, remark)
    raised = printed.smooth_film and printed.computed_mean - printed.smooth_film
    rise = trace["line_mean"].less(films.smooth_mean)
    yield row("rise of the mean film by the waves", raised, rise, "same region of both")
    for theirs, whose in (
        (printed.computed_amplitude, "computed"),
        (printed.measured_amplitude, "measured"),
    ):
        remark = f"paper: {whose}" + ("" if theirs else ", 'roughly equals the undeformed'")
        given, name = theirs or AMPLITUDE_UM, f"amplitude of the film, {whose}"
        yield row(name, given, trace["line_amplitude"], remark + "; trace, centre line")
        yield row(name + ", in time", given, trace["time_amplitude"], remark + "; trace")
        yield row(name + ", half range", given, trace["half_range"], remark + "; trace, in time")
    given = printed.computed_amplitude
    name = "amplitude of the film, cosine"
    yield row(name, given or AMPLITUDE_UM, cosine["time_amplitude"], "in time")
    remark = "paper: 0.13/0.14 um" if given else f"formula (18): {films.formula_ratio:.2f}"
    for name, found, undeformed in (
        ("trace", trace["time_amplitude"], wave_amplitude_um),
        ("cosine", cosine["time_amplitude"], AMPLITUDE_UM),
    ):
        ratio, error = found.value / undeformed, found.error / undeformed
        theirs = given and given / AMPLITUDE_UM
        yield comparison_row(f"Ad/Ai, {name}{at}", "-", theirs, ratio, error, remark)


def definition_rows(folder: Path) -> Iterator[dict[str, float]]:
    """Yield the mean film by its possible definitions, um, on the finest grid."""
    for speed in SPEEDS:
        wavy = read_solved(folder, Run(TRACE, speed, *max(GRIDS)))
        yield {
            "speed [m/s]": speed,
            **{f"{waves} waves": line_mean_um(wavy, waves) for waves in range(1, 6)},
            "in time": time_mean_um(wavy),
            "middle": middle_um(wavy),
            "paper": paper.PRINTED[speed].computed_mean,
        }


def variant_rows(folder: Path) -> Iterator[dict[str, Cell]]:
    """Yield smooth and mean films of variants of the model, um, on the coarser grid.

    Load and viscosity give the printed M and L, with the paper's R, E' and alpha.
    """
    names = {"": "Table 1", PAPER_ML: "printed M and L", Z_DEFAULT: "z = 0.68"}
    names[INCOMPRESSIBLE] = "incompressible lubricant"
    for speed in SPEEDS:
        for variant, name in names.items():
            smooth = coarse_film_um(folder, SMOOTH, speed, variant)
            has_waves = variant in ("", PAPER_ML)
            yield {
                "speed [m/s]": speed,
                "model": name,
                "smooth film [um]": smooth,
                "change [%]": 100 * (smooth / coarse_film_um(folder, SMOOTH, speed) - 1),
                "mean film [um]": (
                    coarse_film_um(folder, TRACE, speed, variant) if has_waves else None
                ),
            }


def coarse_film_um(folder: Path, surface: str, speed: float, variant: str = "") -> float:
    """Return the central film of smooth surfaces, the mean film of others, coarser grid, um."""
    solved = read_solved(folder, Run(surface, speed, *min(GRIDS), variant))
    return smooth_film_um(solved) if surface == SMOOTH else line_mean_um(solved)


def run_rows(folder: Path, runs: list[Run]) -> Iterator[dict[str, Cell]]:
    """Yield the time of every run."""
    for run in runs:
        result = read_solved(folder, run).result
        yield {
            "run": run.name,
            "cells along X": run.cells_x,
            "cells along Y": run.cells_y,
            "status": result["status"],
            "time steps": result["time_steps"],
            "mass residual": result["residual"],
            "points per wave": result["points_per_wave_x"] or None,
            "hX over the inlet length": result["inlet_resolution"],
            "seconds": result["seconds"],
        }
