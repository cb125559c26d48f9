"""Maps of the outcomes: steady states over M and L, the other families over their variants."""

from collections.abc import Iterable, Sequence

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from studies.stability.cases import OUTSIDE, SLIDING
from studies.stability.outcome import CONVERGED, FAILED, REFUSED, UNRESOLVED, UNSOLVED, Row

# Colours that stay apart for colour-blind readers (Okabe and Ito).
_COLOURS = {
    CONVERGED: "#009E73",
    UNRESOLVED: "#E69F00",
    UNSOLVED: "#B0B0B0",
    REFUSED: "#56B4E9",
    FAILED: "#D55E00",
}
_RESCUED_EDGE = "black"
_STYLE = {"font.size": 8, "axes.titlesize": 8.5, "axes.labelsize": 8.5, "legend.fontsize": 8}
_SIZE, _SMALL = 290, 190
WIDTH, ACROSS = 7.0, 3
"""Width of the map of steady states in inches, as a page shows it, and panels in a row."""


def steady_map(rows: Sequence[Row]) -> Figure:
    """Draw the smooth steady states over M and L, a panel for each D.

    The number in a mark is the number of Newton steps on the finest grid; a black rim means that a
    rung of the ladder above the direct solve was needed. Cases on a wide domain are left to the
    table.
    """
    steady = [row for row in rows if row.case.family == "steady" and row.case.variant == "smooth"]
    ratios = sorted({row.case.value("radius_ratio_d") for row in steady})
    loads = sorted({row.case.value("load_parameter_m") for row in steady})
    viscous = sorted({row.case.value("lubricant_parameter_l") for row in steady})
    with rc_context(_STYLE):
        down = -(-len(ratios) // ACROSS)
        height = 0.27 * len(viscous) + 0.85
        figure = Figure(figsize=(WIDTH, height * down + 0.5), layout="constrained")
        panels = figure.subplots(down, ACROSS, squeeze=False).ravel()
        for axes, ratio in zip(panels, ratios, strict=False):
            members = [row for row in steady if row.case.value("radius_ratio_d") == ratio]
            places = [
                (
                    loads.index(row.case.value("load_parameter_m")),
                    viscous.index(row.case.value("lubricant_parameter_l")),
                )
                for row in members
            ]
            _draw(axes, places, members, _SMALL)
            _ticks(axes, [f"{m:g}" for m in loads], [f"{l:g}" for l in viscous], rotation=45)
            axes.set_title(f"D = {ratio:g}")
            axes.set_xlabel("M")
        for axes in panels[::ACROSS]:
            axes.set_ylabel("L")
        for axes in panels[len(ratios) :]:
            axes.set_axis_off()
        _legend(figure, steady)
    return figure


def parameter_map(rows: Sequence[Row]) -> Figure:
    """Draw the other families, a panel each: conditions across, variants downwards.

    Numbers and rims as in :func:`steady_map`; of a march the Newton steps of each time step.
    """
    others = [row for row in rows if row.case.family not in ("steady", OUTSIDE)]
    families = list(dict.fromkeys(row.case.family for row in others))
    tables = {name: [row for row in others if row.case.family == name] for name in families}
    shapes = {
        name: (_unique(map(_condition, sorted(t, key=_place))), _unique(_variants(t)))
        for name, t in tables.items()
    }
    with rc_context(_STYLE):
        is_wide = any(len(across) > 5 for across, _ in shapes.values())
        columns = [[]] if is_wide else [[], []]
        height = 0.5 + _column_height(shapes.values(), len(columns))
        figure = Figure(figsize=(8 if is_wide else 11, height), layout="constrained")
        for name in sorted(families, key=lambda name: -len(shapes[name][1])):
            min(columns, key=lambda column: sum(len(shapes[n][1]) + 3 for n in column)).append(name)
        columns = [names for names in columns if names]
        parts = figure.subfigures(1, len(columns), squeeze=False)[0]
        for part, names in zip(parts, columns, strict=True):
            ratios = [len(shapes[name][1]) + 1 for name in names]
            panels = part.subplots(len(names), 1, height_ratios=ratios, squeeze=False)[:, 0]
            for axes, name in zip(panels, names, strict=True):
                across, down = shapes[name]
                places = [
                    (across.index(_condition(row)), len(down) - 1 - down.index(row.case.variant))
                    for row in tables[name]
                ]
                _draw(axes, places, tables[name])
                _ticks(axes, across, down[::-1])
                axes.set_title(name)
        _legend(figure, others)
    return figure


def _draw(
    axes: Axes, places: Iterable[tuple[int, int]], rows: Iterable[Row], size: float = _SIZE
) -> None:
    for (x, y), row in zip(places, rows, strict=True):
        is_rescued = row.result.get("rung", "direct") != "direct" and row.outcome == CONVERGED
        axes.scatter(
            x, y, s=size, marker="s", color=_COLOURS[row.outcome],
            edgecolors=_RESCUED_EDGE if is_rescued else "none", linewidths=1.4,
        )  # fmt: skip
        axes.text(x, y, _effort(row), ha="center", va="center", fontsize=6)


def _effort(row: Row) -> str:
    steps = row.result.get("nonlinear_steps")
    marched = row.result.get("time_steps")
    if not steps:
        return ""
    return f"{steps / marched:.1f}" if marched else f"{steps:d}"


def _ticks(axes: Axes, across: Sequence[str], upwards: Sequence[str], rotation: float = 0) -> None:
    axes.set_xticks(range(len(across)), across, rotation=rotation)
    axes.set_yticks(range(len(upwards)), upwards)
    axes.set_xlim(-0.6, len(across) - 0.4)
    axes.set_ylim(-0.6, len(upwards) - 0.4)
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)


def _legend(figure: Figure, rows: Sequence[Row]) -> None:
    met = {row.outcome for row in rows}
    handles = [
        Line2D([], [], marker="s", linestyle="", markersize=9, color=colour, label=outcome)
        for outcome, colour in _COLOURS.items()
        if outcome in met
    ]
    rim = {"markerfacecolor": "white", "markeredgecolor": _RESCUED_EDGE, "markeredgewidth": 1.4}
    handles.append(Line2D([], [], marker="s", linestyle="", markersize=9, label="rescued", **rim))
    figure.legend(handles=handles, loc="outside lower center", ncols=3, frameon=False)


def _place(row: Row) -> tuple[float, float, float]:
    m, l = row.case.value("load_parameter_m"), row.case.value("lubricant_parameter_l")
    return -row.case.value("radius_ratio_d"), m, l


def _condition(row: Row) -> str:
    m = row.case.value("load_parameter_m")
    l = row.case.value("lubricant_parameter_l")
    label = f"M {m:g}\nL {l:g}"
    if not row.case.family.startswith(SLIDING):
        return label
    d = row.case.value("radius_ratio_d")
    return f"{label}\nD {d:g}" if d > 0 else f"{label}\nline"


def _variants(rows: Iterable[Row]) -> Iterable[str]:
    return (row.case.variant for row in rows)


def _unique(names: Iterable[str]) -> list[str]:
    return list(dict.fromkeys(names))


def _column_height(shapes: Iterable[tuple[list[str], list[str]]], columns: int) -> float:
    return 0.34 * sum(len(down) + 3 for _, down in shapes) / columns + 0.9
