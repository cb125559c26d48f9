"""Table of friction over the slide-to-roll ratio, its largest value and its regimes."""

import re
from dataclasses import dataclass

import numpy as np
import pandas as pd

from ehlwave.inputs.slip import RATIO

FAR = 0.1
"""Relative reduction of friction by the effect that names a regime."""
CURVES = {
    "isothermal": "isothermal",
    "thermal": "with heat",
    "limited": "isothermal, limited",
    "limited_thermal": "with heat, limited",
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
