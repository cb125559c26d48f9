"""The numbers of the paper's Tables 1 and 2, computed anew."""

from collections.abc import Iterator
from pathlib import Path

from ehlwave.contact.formula import amplitude_ratio_formula, v
from studies.experiment import paper
from studies.experiment.cases import GRIDS, SMOOTH, SPEEDS, Run, read_input
from studies.experiment.measure import Solved, read_solved
from studies.experiment.trace import WAVELENGTH_UM
from studies.section import Cell, comparison_row

ROUNDED_WAVE = 0.32
"""lambda/a as the paper seems to have rounded it: with this its V follow from its M and L."""


def formula_v(solved: Solved) -> float:
    """Return V of the waves, eq. (17), for a circular contact."""
    moes = solved.result["load_parameter_m"], solved.result["lubricant_parameter_l"]
    return float(v(WAVELENGTH_UM / solved.a_um, *moes, 1.0))


def formula_ratio(solved: Solved) -> float:
    """Return Ad/Ai of the formula, eq. (18)."""
    return float(amplitude_ratio_formula(formula_v(solved)))


def condition_rows(folder: Path) -> Iterator[tuple[Cell, ...]]:
    """Yield a comparison for every number of Tables 1 and 2, and of formula (18)."""
    solved = {speed: read_solved(folder, Run(SMOOTH, speed, *max(GRIDS))) for speed in SPEEDS}
    first = solved[SPEEDS[0]]
    keys = read_input(folder / f"{SMOOTH}.nml")
    given, alpha = keys["conditions"], keys["lubricant"]["pressure_viscosity_per_pa"]
    modulus, radius = given["reduced_modulus_pa"], given["radius_x_m"]
    row = comparison_row
    yield row("a", "mm", paper.SEMI_AXIS_MM, first.a_um / 1e3)
    yield row("ph", "GPa", paper.HERTZ_PRESSURE_GPA, first.hertz_pressure_pa / 1e9)
    w_remark = "printed 2.4 % below what Table 1 gives"
    yield row("W", "-", paper.W, given["load_n"] / (modulus * radius**2), remark=w_remark)
    yield row("G", "-", paper.G, alpha * modulus)
    for speed, u in paper.U.items():
        ours = given["viscosity_pa_s"] * speed / (modulus * radius)
        yield row(f"U at {speed:g} m/s", "-", u, ours)
    remark = "printed one goes with the printed M at 0.024 m/s"
    yield row("alphabar", "-", paper.ALPHABAR, first.result["alphabar"], remark=remark)
    for speed in SPEEDS:
        printed, result = paper.PRINTED[speed], solved[speed].result
        remark = "printed with the printed W" if speed == SPEEDS[0] else ""
        at = f" at {speed:g} m/s"
        yield row("M" + at, "-", printed.m, result["load_parameter_m"], remark=remark)
        yield row("L" + at, "-", printed.l, result["lubricant_parameter_l"])
        yield row("lambdabar" + at, "-", printed.lambdabar, result["lambdabar"])
        rounded = float(v(ROUNDED_WAVE, printed.m, printed.l, 1.0))
        remark = f"lambda/a = {ROUNDED_WAVE:g} and the printed M and L give {rounded:.3f}"
        yield row("V" + at, "-", printed.v, formula_v(solved[speed]), remark=remark)
        ratio = formula_ratio(solved[speed])
        yield row("Ad/Ai by formula (18)" + at, "-", printed.formula_ratio, ratio)
    yield row(
        "V in the text, 0.024 m/s", "-", paper.V_IN_TEXT, formula_v(first), remark="see V above"
    )
