"""Friction over the slide-to-roll ratio: isothermal, with heat, and with a limit of the stress."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from ehlwave.cases.keys import key_groups
from ehlwave.cases.study import Study
from ehlwave.choices import TRACTION_RATIOS
from ehlwave.contact.heat_data import EMPTY_HEAT
from ehlwave.errors import ArgumentError, ProgramError, SurfaceError
from ehlwave.inputs.key_values import values_of
from ehlwave.inputs.namelist import read_namelist
from ehlwave.inputs.slip import RATIO, SLIP
from ehlwave.results.schema import SETTLED

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ehlwave.programs.progress import Following

LIMIT, LIMIT_WIDTH = "shear_limit_over_pressure", "shear_limit_width"
UNUSED = ("waviness", "waviness2", "surface", "surface2", "dynamics")
"""Groups that friction of a smooth contact in its steady state does not depend on."""
SMALL_RATIO = 1e-5
"""Where friction is proportional to the ratio: its slope is taken there."""
FAR = 0.1
"""By so much, relative, friction lies below that without what a regime is named after."""
CURVES = {
    "isothermal": "isothermal",
    "thermal": "with heat",
    "limited": "isothermal, limited",
    "limited_thermal": "with heat, limited",
}
RISES = {
    "rise_mid_film_k": ("largest_rise_mid_film_k", "half-way across the film"),
    "rise_wall_1_k": ("largest_rise_wall_1_k", "surface 1"),
    "rise_wall_2_k": ("largest_rise_wall_2_k", "surface 2"),
}


@dataclass(frozen=True)
class Traction:
    """Friction of a contact over its slide-to-roll ratio."""

    table: pd.DataFrame
    """``slide_to_roll_ratio``; friction coefficients ``isothermal``, ``thermal``, ``limited`` and
    ``limited_thermal``, as far as heat and a limit are given; the largest rises, K, and the central
    film, um, of the last of these; ``regime``; ``status`` and ``warning`` of the computed cases."""
    limit: float | None
    """Largest shear stress over pressure."""

    @property
    def curve(self) -> str:
        """Return the name of the column that has all that is given."""
        return [name for name in CURVES if name in self.table][-1]

    @property
    def largest(self) -> tuple[float, float, bool]:
        """Return the largest friction, its ratio, and whether friction falls again beyond."""
        found = self.table[[RATIO, self.curve]].dropna()
        place = int(found[self.curve].to_numpy().argmax())
        value, ratio = (float(found[name].iloc[place]) for name in (self.curve, RATIO))
        return value, ratio, place < len(found) - 1

    @property
    def warnings(self) -> list[str]:
        """Return the warnings of the program, each once, with their ratios."""
        first: dict[str, str] = {}
        rows: dict[str, list[int]] = {}
        for row, text in enumerate(self.table.get("warning", ())):
            for part in filter(None, str(text).split("; ")):
                kind = re.sub(r"\d\S*", "#", part)
                first.setdefault(kind, part)
                rows.setdefault(kind, []).append(row)
        ratio, count = self.table[RATIO].tolist(), len(self.table)
        return [
            f"{RATIO} = {', '.join(f'{ratio[row]:g}' for row in held)}: {first[kind]}"
            if held != list(range(held[0], count))
            else f"from {RATIO} = {ratio[held[0]]:g} on: {first[kind]}"
            for kind, held in rows.items()
        ]


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
                f"{path}: has &{name}: friction over slip is that of one smooth contact in its "
                "steady state: remove it"
            )
    try:
        groups = values_of(file)
    except SurfaceError as error:
        raise ArgumentError(str(error)) from error
    if "heat" in groups and not groups["heat"]:
        raise ArgumentError(f"{path}: {EMPTY_HEAT}")
    return {key: value for group in groups.values() for key, value in group.items()}


def traction(
    keys: Mapping[str, Any],
    ratios: Sequence[float] = TRACTION_RATIOS,
    ranks: int = 1,
    progress: "Following" = None,
) -> Traction:
    """Compute friction and temperatures over the slide-to-roll ratio by ``ehlwave-sweep``.

    Parameters
    ----------
    keys : mapping
        Keys of a smooth contact, as for :class:`ehlwave.Case`; the ratios replace its slip. With
        keys of ``&heat`` there is friction with heat; with ``shear_limit_over_pressure`` friction
        with this limit, besides.
    ratios : sequence of float
        Slide-to-roll ratios, above 0 and, with heat, below 2.
    ranks : int
        MPI ranks of the sweep.
    progress : callable or False, optional
        As of :meth:`ehlwave.Study.run`.

    Raises
    ------
    ArgumentError
        If the ratios are none, or keys are of waves or of a march.
    SurfaceError
        If the conditions are Moes parameters.
    ProgramError
        If the program refuses the input, or no case converges.

    Examples
    --------
    >>> from ehlwave.traction import traction
    >>> keys = {"radius_x_m": 0.02, "reduced_modulus_pa": 2.26e11, "load_n_per_m": 4e5,
    ...         "mean_speed_m_per_s": 2, "viscosity_pa_s": 0.03, "flow_law": "eyring",
    ...         "eyring_stress_pa": 5e6, "cells_x": 256, "shear_limit_over_pressure": 0.05}
    >>> found = traction(keys, ratios=[1e-5, 0.01, 1], progress=False)
    >>> found.table["regime"].tolist()
    ['linear', 'nonlinear', 'limited']
    """
    given = {key: value for key, value in keys.items() if key not in (SLIP, RATIO)}
    if "load_parameter_m" in given:
        raise SurfaceError(
            "load_parameter_m: a film in um wants dimensional &conditions: give radius_x_m, "
            "reduced_modulus_pa, load_n or load_n_per_m, mean_speed_m_per_s and viscosity_pa_s"
        )
    groups = key_groups()
    for key in given:
        if groups.get(key) in UNUSED:
            raise ArgumentError(
                f"{key}: &{groups[key]} has no part in friction over slip, which is that of one "
                "smooth contact in its steady state: remove it"
            )
    has_heat = any(groups.get(key) == "heat" for key in given)
    chosen = _checked(ratios, has_heat)
    limit = float(given.get(LIMIT, 0)) or None
    free = {key: value for key, value in given.items() if key not in (LIMIT, LIMIT_WIDTH)}
    table = pd.DataFrame({RATIO: chosen})
    runs = [(("isothermal", "thermal"), free)]
    if limit is not None:
        runs.append((("limited", "limited_thermal"), given))
    for (cold, warm), each in runs:
        cases = pd.DataFrame({RATIO: chosen})
        found = Study(cases, **each).run(ranks=ranks, progress=progress).to_dataframe()
        good = found["status"].isin(SETTLED).to_numpy()
        if not good.any():
            raise ProgramError(f"no case converged: {found['message'].iloc[0]}")
        known = np.isfinite(found["friction_coefficient"].to_numpy(dtype=float)[good])
        if not known.any() and each is runs[-1][1]:
            raise ProgramError(_no_friction(found["warning"][good]))
        source = "isothermal_friction_coefficient" if has_heat else "friction_coefficient"
        table[cold] = np.where(good, found[source], np.nan)
        if has_heat and not good.all():
            table.loc[~good, cold] = _without_heat(each, cases[~good], ranks)
        if has_heat:
            table[warm] = np.where(good, found["friction_coefficient"], np.nan)
            for name, (column, _) in RISES.items():
                table[name] = np.where(good, found[column], np.nan)
        table["central_film_um"] = np.where(good, found["central_film_um"], np.nan)
        table["status"] = found["status"].to_numpy()
        table["warning"] = found["warning"].to_numpy()
    start = _without_heat(free, pd.DataFrame({RATIO: [SMALL_RATIO]}), ranks)
    table["regime"] = regimes(table, float(start[0]) / SMALL_RATIO)
    return Traction(table, limit)


def _no_friction(warnings: "pd.Series[str]") -> str:
    """Return why no case has a friction, with the message of the program."""
    said = next((str(text).split("; ")[0] for text in warnings if text), "")
    return (
        "friction is not known at any ratio"
        + (f" ({said})" if said else "")
        + ": give more cells, "
        "or a flow law such as flow_law = 'eyring' with eyring_stress_pa"
    )


def _without_heat(keys: Mapping[str, Any], cases: pd.DataFrame, ranks: int) -> NDArray[np.float64]:
    """Return isothermal friction of ratios."""
    dropped = [key for key, group in key_groups().items() if group == "heat"]
    if str(keys.get("viscosity_law")).lower() != "table":  # measured at temperatures, without heat
        dropped.append("temperature_k")
    cold = {key: value for key, value in keys.items() if key not in dropped}
    found = Study(cases, **cold).run(ranks=ranks, progress=False)
    return np.where(
        np.isin(found["status"].values, SETTLED), found["friction_coefficient"].values, np.nan
    )


def regimes(table: pd.DataFrame, slope: float) -> list[str]:
    """Return the regime of each ratio.

    ``linear``: friction is within a tenth of proportional to the ratio; ``nonlinear``: it is not,
    as the oil thins; ``thermal`` or ``limited``: heat, or the limit, takes more than a tenth of it,
    whichever takes more. Empty where nothing is known.

    Parameters
    ----------
    table : pandas.DataFrame
        Friction, as of :class:`Traction`.
    slope : float
        Friction over the ratio where that is small.

    Examples
    --------
    >>> import pandas as pd
    >>> from ehlwave.traction import regimes
    >>> regimes(pd.DataFrame({"slide_to_roll_ratio": [0.01, 0.1, 1],
    ...     "isothermal": [0.01, 0.04, 0.06], "thermal": [0.01, 0.039, 0.03]}), slope=1.05)
    ['linear', 'nonlinear', 'thermal']
    """
    cold = table["isothermal"].to_numpy(dtype=float)
    limited = table["limited"].to_numpy(dtype=float) if "limited" in table else cold
    warm_name = "limited_thermal" if "limited_thermal" in table else "thermal"
    warm = table[warm_name].to_numpy(dtype=float) if warm_name in table else limited
    names = []
    for place, ratio in enumerate(table[RATIO]):
        by_limit, by_heat = limited[place] / cold[place], warm[place] / limited[place]
        if not np.isfinite(by_limit * by_heat):
            names.append("")
        elif min(by_limit, by_heat) < 1 - FAR:
            names.append("limited" if by_limit < by_heat else "thermal")
        else:
            names.append("linear" if cold[place] > (1 - FAR) * slope * ratio else "nonlinear")
    return names


def traction_figure(found: Traction) -> "Figure":
    """Draw friction, and with heat the rises of the temperature, over the slide-to-roll ratio.

    Parameters
    ----------
    found : Traction
        From :func:`traction`.
    """
    from matplotlib.figure import Figure

    from ehlwave.results.figures import COLOURS

    table = found.table
    has_heat = "thermal" in table
    figure = Figure(figsize=(9.6 if has_heat else 5.2, 3.8), layout="constrained")
    panels = np.atleast_1d(figure.subplots(1, 2 if has_heat else 1))
    left = panels[0]
    for name, label in CURVES.items():
        if name in table:
            colour = COLOURS[1 if name in ("thermal", "limited_thermal") else 0]
            style = "--" if "limited" in name else "-"
            left.plot(table[RATIO], table[name], style, marker=".", color=colour, label=label)
    top = 1.3 * float(np.nanmax(table[[name for name in CURVES if name in table]].to_numpy()))
    if found.limit is not None and found.limit < top:
        left.axhline(found.limit, color="black", lw=0.7, ls=":", label="limit of the stress")
    left.set(ylabel="friction coefficient", ylim=(0, top))
    left.legend(frameon=False, fontsize=8, loc="center left", bbox_to_anchor=(0, 0.72))
    if has_heat:
        for name, (_, label) in RISES.items():
            panels[1].plot(table[RATIO], table[name], marker=".", label=label)
        panels[1].set(ylabel="largest rise of the temperature [K]", ylim=(0, None))
        panels[1].legend(frameon=False, fontsize=8)
    for axes in panels:
        axes.set(xscale="log", xlabel="slide-to-roll ratio")
    _name_regimes(left, table)
    return figure


def _name_regimes(axes: "Axes", table: pd.DataFrame) -> None:
    """Shade every other regime and write its name above."""
    ratio, names = table[RATIO].to_numpy(dtype=float), table["regime"].tolist()
    starts = [i for i, name in enumerate(names) if i == 0 or name != names[i - 1]]
    edges = [ratio[0], *(np.sqrt(ratio[i - 1] * ratio[i]) for i in starts[1:]), ratio[-1]]
    for k, start in enumerate(starts):
        if k % 2:
            axes.axvspan(edges[k], edges[k + 1], color="0.94", lw=0, zorder=0)
        middle = np.sqrt(edges[k] * edges[k + 1])
        axes.text(
            middle,
            0.98,
            names[start],
            transform=axes.get_xaxis_transform(),
            ha="center",
            va="top",
            fontsize=8,
            rotation=0 if edges[k + 1] > 3 * edges[k] else 90,
        )


def _checked(ratios: Sequence[float], has_heat: bool) -> list[float]:
    """Return the ratios, rising."""
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
