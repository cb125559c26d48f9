"""Waves through a line contact beside Venner and others (1997): section of the page."""

from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from ehlwave.results.figures import COLOURS
from studies.section import Picture, Section, Table
from studies.validation.line_ratios import (
    AMPLITUDE,
    WAVE,
    domain_changes,
    linear_ratios,
    marched_ratios,
)
from studies.validation.line_runs import FINE_CELLS, OILS, QUICK_CELLS, responses, transients
from studies.validation.published import small_line_ratios

HEADINGS = {
    WAVE: "lambda/b",
    AMPLITUDE: "Ai/Hc",
    "published": "published",
    "march": "march",
    "march_difference": "its difference",
    "march_error": "its error bar",
    "linear": "linear response",
    "linear_difference": "difference of it",
    "linear_error": "error bar of it",
}

SHORT = 0.5
"""Shortest wave, lambda/b, that counts as long in the text."""


def section(folder: Path) -> Section:
    """Return the part of the page about the line contact; runs in `folder` what is not there."""
    linear = linear_ratios(responses(folder, cells=FINE_CELLS))
    domain = domain_changes(folder)
    found = marched_ratios(transients(folder), linear, domain)
    return Section(
        "Waves through a line contact",
        _text(found, domain),
        [value_table(found), oil_table(folder)],
        [
            Picture(
                "venner",
                "Ad/Ai less the published value, for three amplitudes; lines: linear response. "
                "The published values have three decimals",
                deviation_figure(found),
            )
        ],
    )


def value_table(found: pd.DataFrame) -> Table:
    """Return all published values beside the march and the linear response."""
    caption = "Line contact, M = 100, L = 11, pure rolling, Ad/Ai; lambda counted in the half width"
    return Table("venner", caption, found[list(HEADINGS)].rename(columns=HEADINGS))


def oil_table(folder: Path) -> Table:
    """Return the linear response with other oils of the same L."""
    published = small_line_ratios()
    columns = {"lambda/b": list(published), "published, Ai = 0.1 Hc": list(published.values())}
    for oil, keys in OILS.items():
        name = ", ".join(f"{key} = {value}" for key, value in keys.items()) or "default"
        columns[name] = responses(folder, oil=oil)["harmonic_extrapolated"].values
    return Table(
        "venner_oils",
        "Linear response with other oils of the same L: the published one's z and alpha are not "
        f"known (default: alpha = 2.2e-8, z = 0.68); on {QUICK_CELLS} cells",
        pd.DataFrame(columns),
    )


def deviation_figure(found: pd.DataFrame) -> Figure:
    """Draw Ad/Ai less the published value against lambda/b."""
    figure = Figure(figsize=(6.0, 3.4), layout="constrained")
    axes = figure.subplots()
    for index, (amplitude, some) in enumerate(found.groupby(AMPLITUDE)):
        colour, label = COLOURS[index], f"Ai = {amplitude:g} Hc"
        x, march, error = some[WAVE], some["march_difference"], some["march_error"]
        style = {"fmt": "o", "color": colour, "label": label, "markersize": 4}
        axes.errorbar(x * 1.04 ** (index - 1), march, error, **style)
        axes.plot(x, some["linear_difference"], color=colour, linewidth=0.8)
    axes.axhline(0, color="black", linewidth=0.6)
    axes.set(xscale="log", xlabel="lambda/b", ylabel="Ad/Ai less published")
    axes.legend(fontsize=8, frameon=False)
    return figure


def _text(found: pd.DataFrame, domain: pd.Series) -> list[str]:
    *small, large = sorted(found[AMPLITUDE].unique())
    short = found[found[WAVE] < SHORT]
    by_amplitude = found[found[WAVE] >= SHORT].abs().groupby(AMPLITUDE).max()
    march, response = by_amplitude["march_difference"], by_amplitude["linear_difference"]
    return [
        "Venner, Couhier, Lubrecht and Greenwood (1997): transverse waves through a line contact, "
        "M = 100, L = 11, pure rolling, three amplitudes. Marches on 512 cells with X from -2.5 to "
        "1.5; what they have more than the linear response on the same grid is added to that on "
        f"{FINE_CELLS} cells, extrapolated. The error bars are the change of that difference from "
        "256 cells, the linear response's own error, and the change on a domain from -10.5 "
        f"(at most {domain.abs().max():.1g}).",
        f"Down to lambda/b = {SHORT:g} marches are within {march[small].max():.3f} of the "
        f"published values up to Ai = {small[-1]:g} Hc and within "
        f"{march[large]:.3f} at {large:g} Hc, linear responses within "
        f"{response[small[0]]:.3f} of those at {small[0]:g} Hc; the published ones "
        "have three decimals. For shorter waves marches are up to "
        f"{short['march_difference'].abs().max():.3f} off, where their error bars are at most "
        f"{short['march_error'].max():.3f}, and no oil of the second table removes that.",
    ]
