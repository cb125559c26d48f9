"""Published data, from ``data``; needs the standard library alone, since tests read it too."""

import csv
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas as pd

FOLDER = Path(__file__).parent / "data"


@dataclass(frozen=True)
class LineRatio:
    """Ad/Ai of a line contact, Venner and others (1997): M = 100, L = 11, pure rolling."""

    wavelength_over_a: float
    amplitude_over_film: float
    amplitude_ratio: float


def line_ratios() -> list[LineRatio]:
    """Return all 18 values of Venner and others (1997), long waves first."""
    return [
        LineRatio(**{name: float(value) for name, value in row.items()})
        for row in _rows("venner1997.csv")
    ]


def small_line_ratios() -> dict[float, float]:
    """Return Ad/Ai by lambda/a for the smallest waves of them, Ai = 10 % of the film."""
    ratios = line_ratios()
    smallest = min(one.amplitude_over_film for one in ratios)
    return {
        one.wavelength_over_a: one.amplitude_ratio
        for one in ratios
        if one.amplitude_over_film == smallest
    }


def centre_line(kind: str, instant: int, quantity: str) -> tuple[list[float], list[float]]:
    """Return places, um, and values, nm or MPa, along the centre line of Mourier and others (2006).

    Parameters
    ----------
    kind : {"simulated", "measured"}
    instant : {1, 4}
    quantity : {"film", "pressure"}
        Pressure was not measured.
    """
    points = [
        (float(row["x_um"]), float(row["value"]))
        for row in _rows("mourier2006.csv")
        if (row["kind"], row["instant"], row["quantity"]) == (kind, str(instant), quantity)
    ]
    if not points:
        raise KeyError(f"no {quantity}, {kind}, at instant {instant}")
    return [x for x, _ in points], [value for _, value in points]


def rig_films() -> "pd.DataFrame":
    """Return films of FVA 3 by Dao (2018): run, speed, temperature, load, film."""
    import pandas as pd

    return pd.read_csv(FOLDER / "dao2018.csv")


def _rows(name: str) -> list[dict[str, str]]:
    with (FOLDER / name).open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))
