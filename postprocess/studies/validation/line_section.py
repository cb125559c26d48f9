"""Waves through a line contact beside Venner and others (1997): section of the page."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from ehlwave_post.figures import COLOURS
from studies.section import Cell, Picture, Section, Table
from studies.validation.line_ratios import Ratio, domain_changes, linear_ratios, marched_ratios
from studies.validation.line_runs import FINE_CELLS, OILS, QUICK_CELLS, responses, transients
from studies.validation.published import LineRatio, small_line_ratios

SHORT = 0.5
"""Shortest wave, lambda/b, that counts as long in the text."""


def section(folder: Path) -> Section:
    """Return the part of the page about the line contact; runs in `folder` what is not there."""
    linear = linear_ratios(responses(folder, cells=FINE_CELLS))
    domain = domain_changes(folder)
    marched = marched_ratios(transients(folder), linear, domain)
    table = value_table(marched, linear, domain)
    return Section(
        "Waves through a line contact",
        _text(table, domain),
        [table, oil_table(folder)],
        [
            Picture(
                "venner",
                "Ad/Ai less the published value, for three amplitudes; lines: linear response. "
                "The published values have three decimals",
                deviation_figure(marched, linear),
            )
        ],
    )


def value_table(
    marched: dict[LineRatio, Ratio], linear: dict[float, Ratio], domain: dict[float, float]
) -> Table:
    """Return all published values beside the march and the linear response."""
    rows: list[tuple[Cell, ...]] = []
    for one, found in marched.items():
        small = linear[one.wavelength_over_a]
        bar = small.error + abs(domain[one.wavelength_over_a])
        rows.append(
            (
                *(one.wavelength_over_a, one.amplitude_over_film, one.amplitude_ratio),
                *(found.value, found.value - one.amplitude_ratio, found.error),
                *(small.value, small.value - one.amplitude_ratio, bar),
            )
        )
    return Table(
        "venner",
        "Line contact, M = 100, L = 11, pure rolling, Ad/Ai; lambda counted in the half width",
        (
            *("lambda/b", "Ai/Hc", "published", "march", "difference", "error bar"),
            *("linear response", "difference", "error bar"),
        ),
        rows,
    )


def oil_table(folder: Path) -> Table:
    """Return the linear response with other oils of the same L."""
    columns = [responses(folder, oil=oil)["harmonic_extrapolated"].values for oil in OILS]
    rows = [
        (wave, ratio, *(float(column[index]) for column in columns))
        for index, (wave, ratio) in enumerate(small_line_ratios().items())
    ]
    names = [", ".join(f"{key} = {value}" for key, value in keys.items()) for keys in OILS.values()]
    return Table(
        "venner_oils",
        "Linear response with other oils of the same L: the published one's z and alpha are not "
        f"known (default: alpha = 2.2e-8, z = 0.68); on {QUICK_CELLS} cells",
        ("lambda/b", "published, Ai = 0.1 Hc", "default", *names[1:]),
        rows,
    )


def deviation_figure(marched: dict[LineRatio, Ratio], linear: dict[float, Ratio]) -> Figure:
    """Draw Ad/Ai less the published value against lambda/b."""
    figure = Figure(figsize=(6.0, 3.4), layout="constrained")
    axes = figure.subplots()
    amplitudes = sorted({one.amplitude_over_film for one in marched})
    for index, amplitude in enumerate(amplitudes):
        some = [one for one in marched if one.amplitude_over_film == amplitude]
        x = np.array([one.wavelength_over_a for one in some])
        known = np.array([one.amplitude_ratio for one in some])
        y = np.array([marched[one].value for one in some]) - known
        colour, label = COLOURS[index], f"Ai = {amplitude:g} Hc"
        error = [marched[one].error for one in some]
        axes.errorbar(
            x * 1.04 ** (index - 1), y, error, fmt="o", color=colour, label=label, markersize=4
        )
        small = [linear[one.wavelength_over_a].value for one in some]
        axes.plot(x, small - known, color=colour, linewidth=0.8)
    axes.axhline(0, color="black", linewidth=0.6)
    axes.set_xscale("log")
    axes.set_xlabel("lambda/b")
    axes.set_ylabel("Ad/Ai less published")
    axes.legend(fontsize=8, frameon=False)
    return figure


def _text(table: Table, domain: dict[float, float]) -> list[str]:
    def worst(is_short: bool, column: int, amplitudes: Sequence[float]) -> float:
        off = [
            float(row[column])  # type: ignore[arg-type]
            for row in table.rows
            if (float(row[0]) < SHORT) == is_short and row[1] in amplitudes  # type: ignore[arg-type]
        ]
        return max(map(abs, off))

    *small, large = sorted({float(row[1]) for row in table.rows})  # type: ignore[arg-type]
    march, response, bar = (table.columns.index("march") + step for step in (1, 4, 2))
    return [
        "Venner, Couhier, Lubrecht and Greenwood (1997): transverse waves through a line contact, "
        "M = 100, L = 11, pure rolling, three amplitudes. Marches on 512 cells with X from -2.5 to "
        "1.5; what they have more than the linear response on the same grid is added to that on "
        f"{FINE_CELLS} cells, extrapolated. The error bars are the change of that difference from "
        "256 cells, the linear response's own error, and the change on a domain from -10.5 "
        f"(at most {max(abs(one) for one in domain.values()):.1g}).",
        f"Down to lambda/b = {SHORT:g} marches are within {worst(False, march, small):.3f} of the "
        f"published values up to Ai = {small[-1]:g} Hc and within "
        f"{worst(False, march, [large]):.3f} at {large:g} Hc, linear responses within "
        f"{worst(False, response, small[:1]):.3f} of those at {small[0]:g} Hc; the published ones "
        "have three decimals. For shorter waves marches are up to "
        f"{worst(True, march, [*small, large]):.3f} off, where their error bars are at most "
        f"{worst(True, bar, [*small, large]):.3f}, and no oil of the second table removes that.",
    ]
