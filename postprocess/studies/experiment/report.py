"""The experiment as a part of the report."""

from pathlib import Path

import numpy as np
import pandas as pd

from ehlwave.errors import ResultsError
from ehlwave.surface import read_surface
from studies.experiment import paper
from studies.experiment.cases import GRIDS, SMOOTH, SPEEDS, TRACE, Run, all_runs, read_input
from studies.experiment.comparison import (
    definition_rows,
    film_rows,
    read_films,
    run_rows,
    variant_rows,
)
from studies.experiment.conditions import condition_rows
from studies.experiment.discussion import discussion
from studies.experiment.figures import line_figure, trace_figure
from studies.experiment.maps import HIGHEST_H, fringes_figure, surfaces_figure
from studies.experiment.measure import read_solved
from studies.experiment.stage import REPEATS
from studies.experiment.trace import (
    AMPLITUDE_UM,
    WAVELENGTH_UM,
    Floats,
    fits_of_trace,
    harmonic,
    read_trace,
)
from studies.section import Picture, Section, Table, comparison, comparison_row

FOLDER = "experiment"
TRACE_FILE = "sputtered_profile.csv"


def section(folder: Path) -> Section:
    """Return the part of the report on the experiment.

    Parameters
    ----------
    folder : Path
        Of the study; the stage's files are in ``folder/experiment``.

    Raises
    ------
    ResultsError
        If a run is missing or did not converge.
    """
    files = folder / FOLDER
    if not (files / TRACE_FILE).is_file():
        raise ResultsError(f"{files / TRACE_FILE}: no such file; run the stage first")
    wave = _wave(files)
    undeformed = _amplitudes(wave)
    films = [read_films(files, speed) for speed in SPEEDS]
    rows = [row for one in films for row in film_rows(one, undeformed[0])]
    runs = all_runs()
    found = Section("The experiment (section 4)", text=discussion(files, films, undeformed))
    found.tables = [
        comparison(
            "experiment-comparison",
            "Films and amplitudes beside the paper's. This code's values are extrapolated to mesh "
            "size 0 from two grids; the error bar is their distance from the finer one.",
            rows,
        ),
        comparison(
            "experiment-conditions",
            "Tables 1 and 2 and formula (18), computed anew.",
            condition_rows(files),
        ),
        _trace_table(files),
        Table(
            "experiment-definitions",
            "Mean film by its possible definitions, um, trace, finer grid: over 1 to 5 waves on "
            "the centre line; at the centre in time, its level and the middle of its range.",
            pd.DataFrame(definition_rows(files)),
        ),
        Table(
            "experiment-variants",
            "Variants of the model on the coarser grid: central film of the smooth contact, its "
            "change, and mean film with waves, um.",
            pd.DataFrame(variant_rows(files)),
        ),
        Table("experiment-runs", "The runs.", pd.DataFrame(run_rows(files, runs)), is_long=True),
    ]
    found.pictures = _pictures(files, wave)
    return found


def _wave(files: Path) -> Floats:
    """Return a wave from the middle of the computed surface, um, where nothing is faded."""
    file = read_input(files / f"{TRACE}.nml")["surface"]["file"]
    heights = read_surface(file).height[:, 0] * 1e6
    count = heights.size // REPEATS
    return heights[count * (REPEATS // 2) : count * (REPEATS // 2 + 1)]


def _amplitudes(wave: Floats) -> list[float]:
    """Return the amplitudes of the first three harmonics of a wave, um."""
    x = np.arange(wave.size) / wave.size
    return [abs(harmonic(x, wave, 1 / number)) for number in (1, 2, 3)]


def _trace_table(files: Path) -> Table:
    """Return the paper's fit of a sinusoid, to the whole trace and to its parts."""
    fits = fits_of_trace(*read_trace(files / TRACE_FILE))
    rows = []
    for number, (name, fit) in enumerate(fits):
        remark = f"left: {1e3 * fit.rms_left:.1f} nm rms"
        theirs = AMPLITUDE_UM if number == 0 else None
        rows.append(
            comparison_row(f"wavelength, {name}", "um", WAVELENGTH_UM, fit.wavelength, None, remark)
        )
        rows.append(comparison_row(f"amplitude, {name}", "um", theirs, fit.amplitude))
    parts = [fit.amplitude for _, fit in fits[1:]]
    for which, theirs, ours in zip(
        ("smallest", "largest"), paper.PARTS_AMPLITUDE_UM, (min(parts), max(parts)), strict=True
    ):
        rows.append(comparison_row(f"{which} amplitude of a part", "um", theirs, ours))
    caption = "Least-squares sinusoids of the synthetic trace, made to have the paper's properties."
    return comparison("experiment-trace", caption, rows)


def _pictures(files: Path, wave: Floats) -> list[Picture]:
    wavy, smooth = (
        {speed: read_solved(files, Run(kind, speed, *max(GRIDS))) for speed in SPEEDS}
        for kind in (TRACE, SMOOTH)
    )
    x, height = read_trace(files / TRACE_FILE)
    fit = fits_of_trace(x, height)[0][1]
    measured = (
        "The measured films (Figures {}) exist in print only: their mean is a line, their "
        "amplitude a band over the central region."
    )
    return [
        Picture(
            "experiment-figure4",
            "As Figure 4: synthetic trace, its least-squares sinusoid, and the wave cut out of it.",
            trace_figure(x, height, fit, wave),
        ),
        Picture(
            "experiment-figure5",
            "Beside Figure 5: computed film at 0.024 m/s, waves all over the contact, as fringes "
            "(filters taken as 0.63 and 0.54 um, refractive index as 1.5) and in um; inlet on the "
            "left.",
            fringes_figure(wavy[SPEEDS[0]]),
        ),
        Picture(
            "experiment-figure7",
            "As Figure 7: P and H over X and Y at 0.024 m/s, waves all over the contact; H is cut "
            f"off above {HIGHEST_H:g}.",
            surfaces_figure(wavy[SPEEDS[0]]),
        ),
        Picture(
            "experiment-figure8",
            "As Figure 8, with Figure 6: film along the centre line at 0.024 m/s. "
            + measured.format("6"),
            line_figure([(wavy[SPEEDS[0]], smooth[SPEEDS[0]])]),
        ),
        Picture(
            "experiment-figure10",
            "As Figure 10, with Figure 9: films along the centre line at 0.048 and 0.096 m/s. "
            + measured.format("9"),
            line_figure([(wavy[speed], smooth[speed]) for speed in SPEEDS[1:]]),
        ),
    ]
