"""Figure of measured values, fit and residuals."""

from typing import TYPE_CHECKING

import numpy as np

from ehlwave.identify.identified import Identified
from ehlwave.identify.measurements import RESULTS, TEMPERATURE
from ehlwave.quantities import ZERO_CELSIUS_K

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ABSCISSAS = {
    "central_film_m": ("mean_speed_m_per_s", "load_n", "load_n_per_m"),
    "minimum_film_m": ("mean_speed_m_per_s", "load_n", "load_n_per_m"),
    "friction_coefficient": ("slide_to_roll_ratio", "mean_speed_m_per_s", "load_n"),
    "harmonic_ratio": ("wavelength_over_a", "mean_speed_m_per_s", "slide_to_roll_ratio"),
}
"""Keys that results are drawn over: the first that varies."""

LABELS = {
    "mean_speed_m_per_s": "mean speed [m/s]",
    "slide_to_roll_ratio": "slide-to-roll ratio",
    "wavelength_over_a": "wavelength over a",
    "load_n": "load [N]",
    "load_n_per_m": "load [N/m]",
}
SCALES = {"central_film_m": 1e6, "minimum_film_m": 1e6}
AXES = {
    "central_film_m": "central film [um]",
    "minimum_film_m": "smallest film [um]",
    "friction_coefficient": "friction coefficient",
    "harmonic_ratio": "Ad/Ai",
}


def identification_figure(found: Identified) -> "Figure":
    """Draw measured values and fit, above the residuals; a column for each result.

    Parameters
    ----------
    found : Identified
        From :func:`identify`.
    """
    from matplotlib.figure import Figure

    from ehlwave.results.scales_of_figures import COLUMN, PAGE

    data = found.measurements
    results = [name for name in RESULTS if name in data.result]
    figure = Figure(figsize=(min(COLUMN * len(results), PAGE), 5.2), layout="constrained")
    panels = figure.subplots(
        2, len(results), squeeze=False, sharex="col", gridspec_kw={"height_ratios": (2.5, 1)}
    )
    for column, name in enumerate(results):
        _draw(panels[0, column], panels[1, column], found, name)
    panels[1, 0].set_ylabel("measured/fit - 1 [%]")
    figure.suptitle("\n".join(_said(one) for one in found.parameters), fontsize=8)
    return figure


def _said(parameter) -> str:  # noqa: ANN001 - a Parameter
    text = f"{parameter.name} = {parameter.value:.3g}"
    if not parameter.is_identified:
        return f"{text} (not identified)"
    return f"{text} ({parameter.low:.3g} to {parameter.high:.3g})"


def _draw(above, below, found: Identified, name: str) -> None:  # noqa: ANN001 - axes
    from ehlwave.results.figures import COLOURS
    from ehlwave.results.scales_of_figures import plain_numbers

    data = found.measurements
    rows = [k for k, one in enumerate(data.result) if one == name]
    keys = ABSCISSAS[name]
    varying = [key for key in keys if len({data.conditions[k].get(key) for k in rows}) > 1]
    key = varying[0] if varying else None
    x = np.array([data.conditions[k].get(key, i) if key else i for i, k in enumerate(rows)])
    groups = [tuple((k, v) for k, v in data.conditions[row].items() if k != key) for row in rows]
    scale = SCALES.get(name, 1.0)
    for n, group in enumerate(dict.fromkeys(groups)):
        inside = np.array([one == group for one in groups])
        order = np.argsort(x[inside])
        chosen = np.array(rows)[inside][order]
        colour, at = COLOURS[n % len(COLOURS)], x[inside][order]
        above.plot(at, scale * found.fitted[chosen], "-", color=colour, lw=1)
        above.plot(at, scale * data.value[chosen], "o", color=colour, ms=4, label=_group(group))
        below.plot(at, 100 * found.residual[chosen], "o", color=colour, ms=3)
    below.axhline(0, color="black", lw=0.6)
    above.set_ylabel(AXES[name])
    below.set_xlabel(LABELS.get(key, key) if key else "row")
    if key and x.min() > 0 and x.max() > 4 * x.min():
        above.set_xscale("log")
        plain_numbers(below.xaxis)
        if name in SCALES:
            above.set_yscale("log")
            plain_numbers(above.yaxis)
    if len(set(groups)) > 1:
        above.legend(frameon=False, fontsize=8)


def _group(group: tuple[tuple[str, float], ...]) -> str:
    said = []
    for key, value in group:
        if key == TEMPERATURE:
            said.append(f"{value - ZERO_CELSIUS_K:.4g} °C")
        else:
            name, _, unit = LABELS.get(key, key).partition(" [")
            said.append(f"{name} {value:.4g} {unit.rstrip(']')}".rstrip())
    return ", ".join(said)
