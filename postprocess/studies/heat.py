"""Steps of ``scripts/study heat``: laws of film and friction of contacts with heat."""

import argparse
import math
import sys
from collections.abc import Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from numpy.typing import NDArray

from ehlwave.contact import Conditions, conditions_from_keys
from ehlwave.contact.heat_data import Heat
from ehlwave.laws.heat_laws import (
    FRICTION_COEFFICIENTS,
    WEDGE_POWER,
    friction_factor,
    sliding_film,
    wedge,
)
from ehlwave.laws.inlet_warming import inlet_factor, thermal_loading, wall_parameter
from ehlwave.laws.sheared_film import Sheared, shear_isothermal, shear_warm
from ehlwave.results.figures import write_figure
from ehlwave.writing import Writer
from studies import heat_films
from studies.folds import held_out
from studies.heated_contacts import (
    DENSITY,
    EXPANSION,
    LARGEST_ERROR,
    MORE,
    contact,
    dimensional_keys,
    film_over_approach,
    heat_of,
    largest_error,
    write_more,
)
from studies.sweeps import Row, read_sweep, run_command, write_rows, write_sweep

Floats = NDArray[np.float64]

LINE_CELLS = 12
"""Cells of a line contact over the cells of a point contact."""
FITTED_LOADING = 4.0
"""Largest L_t of the contacts that the laws are fitted to."""
ROLLING_LOADING = 8.0
"""Largest L_t of contacts that roll."""
LOADS, OILS = (5.0, 1500.0), (2.0, 20.0)
"""M and L of the contacts that are taken."""
FOLDS = 20
"""Parts of the contacts, each predicted by a fit to the others."""
ROBUST = {"loss": "soft_l1", "f_scale": 0.03}
"""How laws are fitted."""
THICKEST = 0.4
"""Film by the formula over the Hertz approach; thicker films are rather rigid."""


def contacts(count: int, is_line: bool) -> list[Row]:
    """Return as many contacts as `count` whose M, L and film are in the range of the laws."""
    rng = np.random.default_rng(38 + is_line)
    rows: list[Row] = []
    while len(rows) < count:
        row = contact(rng, is_line, is_wide=True)
        c = conditions_from_keys(dimensional_keys(row))
        film = film_over_approach(c)
        if LOADS[0] <= c.m <= LOADS[1] and OILS[0] <= c.l <= OILS[1] and film < THICKEST:
            rows.append(row)
    return rows


def write_cases(folder: Path, lines: int, points: int, more: int, cells: int) -> None:
    """Write the sweeps of line and of elliptical contacts, of bearings and of thick films."""
    write_more(folder, more, has_cold=True)
    oil = {"flow_law": "eyring"}
    heat = {"oil_density_kg_per_m3": DENSITY, "oil_expansion_per_k": EXPANSION}
    grid = {"x_min": -4.5, "x_max": 2.0, "edges": "flooded", "cells_x": LINE_CELLS * cells}
    grids = {"lines": grid}
    grid = {"x_min": -3.5, "x_max": 1.5, "y_max": 2.5, "edges": "flooded"}
    grids["points"] = grid | {"cells_x": cells, "cells_y": cells}
    for name, count in (("lines", lines), ("points", points)):
        rows = contacts(count, is_line=name == "lines")
        write_sweep(folder, name, rows, {"lubricant": oil, "heat": heat, "grid": grids[name]})
        cold = [dimensional_keys(row) for row in rows]
        write_sweep(folder, f"{name}_cold", cold, {"lubricant": oil, "grid": grids[name]})


def usable(folder: Path) -> pd.DataFrame:
    """Return the contacts that converged on a grid that resolves them, with the input of laws."""
    rows = []
    for name in ("lines", "points", *MORE):
        largest = largest_error(name)
        pairs = zip(read_sweep(folder, name), read_sweep(folder, f"{name}_cold"), strict=True)
        for case, cold in pairs:
            if case["status"] != "converged" or not case["central_film_error"] < largest:
                continue
            ratio = 2 * (case["slip_parameter"] - 1)
            if ratio and not case["friction_error"] < LARGEST_ERROR:
                case = {**case, "friction_coefficient": math.nan}
            thinner = case["minimum_film"] / cold["minimum_film"]
            is_known = case["minimum_film_error"] < largest and cold["status"] == "converged"
            rows.append(
                _compared(case, ratio)
                | {"smallest": thinner if is_known else math.nan, "group": name}
            )
    return pd.DataFrame(rows)


def _compared(case: Row, ratio: float) -> Row:
    """Return the input of laws for a contact, and the values to compare."""
    given = dimensional_keys(
        {k: v for k, v in case.items() if not (isinstance(v, float) and math.isnan(v))}
    )
    c = conditions_from_keys(given)
    heat = heat_of(case)
    warm_m = case["central_film_um"] * 1e-6
    film_m = warm_m * case["isothermal_central_film"] / case["central_film"]
    u = case["mean_speed_m_per_s"]
    beta, k = heat.viscosity_temperature_per_k, heat.oil_conductivity_w_per_m_k
    walls = (case["central_rise_wall_1_k"] + case["central_rise_wall_2_k"]) / 2
    mean = Sheared(0.0, case["central_rise_mid_film_k"], walls).rise_mean_k
    thicker = wedge(heat, ratio, walls) ** WEDGE_POWER if ratio else 1.0
    row: Row = {
        "is_line": c.is_line,
        "ratio": ratio,
        "loading": float(thermal_loading(case["viscosity_pa_s"], beta, u, k)),
        "wall": wall_parameter(heat, film_m, c.semi_axis_a_m, u),
        "film_over_approach": film_m / (c.hertz_approach_c_m or math.nan),
        "radius_ratio_d": c.d,
        "m": c.m,
        "film": warm_m / film_m,
        "warmth": beta * walls if ratio else 0.0,
        "inlet": warm_m / film_m * (1 - EXPANSION * mean) / thicker,
        "hertz_over_modulus": c.hertz_pa / case["reduced_modulus_pa"],
        "rise_mid_film_k": case["central_rise_mid_film_k"],
        "friction": case["friction_coefficient"],
        "isothermal": case["isothermal_friction_coefficient"],
    }
    return row | _sheared(c, heat, case["eyring_stress_pa"], film_m, warm_m) if ratio else row


def _sheared(c: Conditions, heat: Heat, tau0: float, film_m: float, warm_m: float) -> Row:
    """Return friction of the even film, with and without heat, and the input of its factor."""
    cold = shear_isothermal(sliding_film(c, tau0, film_m))
    warm = shear_warm(sliding_film(c, tau0, warm_m), heat)
    found: Row = {"modelled_rise_k": warm.rise_mid_film_k}
    for name, one, film in (("cold", cold, film_m), ("warm", warm, warm_m)):
        found |= {
            f"{name}_friction": one.friction,
            f"{name}_thickness": film / (c.hertz_approach_c_m or math.nan),
            f"{name}_stress": one.friction * c.hertz_pa / tau0,
        }
    return found


def report(folder: Path) -> None:
    """Fit the laws of friction and of smallest films; judge the law of the inlet.

    Writes laws.csv, films.csv, contacts.csv and a figure; prints a line for each law.
    """
    table = usable(folder)
    write_rows(folder / "contacts.csv", table.to_dict("records"), digits=5)
    fold = np.random.default_rng(1).permutation(len(table)) % FOLDS
    names = ("loading", "ratio", "wall", "film_over_approach", "radius_ratio_d", "m")
    inlet = inlet_factor(*(table[name].to_numpy() for name in names))
    rows = [_row("film, Gupta", None, gupta(table) - table["film"].to_numpy())]
    rolls = table["ratio"] == 0
    of_law = (table["loading"] <= np.where(rolls, ROLLING_LOADING, FITTED_LOADING)).to_numpy()
    films, found = heat_films.fit(table[of_law].assign(law=inlet[of_law]), fold[of_law])
    heat_films.write(found)
    write_rows(folder / "films.csv", films, digits=5)
    for film in films:
        print(", ".join(f"{k} {v}" for k, v in film.items()))
    slides = table[(table["ratio"] > 0) & table["friction"].notna() & of_law]
    both = pd.concat([_part(slides, "cold", "isothermal"), _part(slides, "warm", "friction")])

    def friction(p: Floats) -> Floats:
        columns = (both[name].to_numpy() for name in _FACTOR)
        return np.log(friction_factor(*columns, p))

    y = np.log(both["computed"] / both["modelled"]).to_numpy()
    twice = np.tile(fold[slides.index.to_numpy()], 2)
    best, errors = held_out(friction, y, FRICTION_COEFFICIENTS, twice, **ROBUST)
    is_warm = np.arange(len(y)) >= len(slides)
    rows.append(_row("friction, even film", None, -y[is_warm]))
    is_thick = np.tile((slides["film_over_approach"] > THICKEST).to_numpy(), 2)
    rows.append(_row("friction", best, errors[is_warm & ~is_thick]))
    rows.append(_row("friction without heat", best, errors[~is_warm & ~is_thick]))
    rows.append(_row("friction, thick films", None, errors[is_warm & is_thick]))
    rows.append(_row("friction without heat, thick films", None, errors[~is_warm & is_thick]))
    write_rows(folder / "laws.csv", rows, digits=5)
    for row in rows:
        print(
            f"{row['law']:22} {row['contacts']} contacts: rms {row['rms']:.4f}, 95 % within "
            f"{row['within_95']:.4f}, largest {row['largest']:.3f}; "
            + ", ".join(f"{row[f'c{i}']:.4g}" for i in range(1, 8) if f"c{i}" in row)
        )
    _draw(folder, table, inlet, both, errors)


_FACTOR = ("thickness", "is_line", "stress", "warmth", "ratio")


def _part(table: pd.DataFrame, name: str, computed: str) -> pd.DataFrame:
    """Return friction with or without heat beside the even film."""
    return pd.DataFrame(
        {
            "thickness": table[f"{name}_thickness"],
            "is_line": table["is_line"],
            "stress": table[f"{name}_stress"],
            "warmth": table["loading"] * (name == "warm"),
            "ratio": table["ratio"],
            "modelled": table[f"{name}_friction"],
            "computed": table[computed],
        }
    )


def gupta(table: pd.DataFrame) -> Floats:
    """Return the factor of Gupta and others, (T3), which programs warn by."""
    x, s = table["loading"].to_numpy(), table["ratio"].to_numpy()
    pressure = 13.2 * table["hertz_over_modulus"].to_numpy() * x**0.42
    return np.asarray((1 - pressure) / (1 + 0.213 * (1 + 2.23 * s**0.83) * x**0.64))


def _row(law: str, best: Floats | None, errors: Floats) -> Row:
    row: Row = {"law": law, "contacts": len(errors)}
    row |= {
        "rms": float(np.sqrt(np.mean(errors**2))),
        "within_95": float(np.percentile(np.abs(errors), 95)),
        "largest": float(np.abs(errors).max()),
    }
    return row | ({} if best is None else {f"c{i + 1}": float(c) for i, c in enumerate(best)})


def _draw(
    folder: Path, table: pd.DataFrame, inlet: Floats, both: pd.DataFrame, errors: Floats
) -> None:
    """Draw films and friction of the laws beside computed values."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4.2), layout="constrained")
    left.plot([0.2, 1], [0.2, 1], color="0.7")
    left.scatter(gupta(table), table["film"], s=7, color="0.6", label="Gupta and others")
    left.scatter(inlet, table["inlet"], s=7, label="law of the inlet")
    left.set(xlabel="film with heat over without, by the law", ylabel="computed")
    left.legend(frameon=False)
    y = both["computed"].to_numpy()
    half = len(y) // 2
    right.plot([1e-4, 0.2], [1e-4, 0.2], color="0.7")
    for name, part in (("without heat", slice(half)), ("with heat", slice(half, None))):
        right.scatter((y * np.exp(errors))[part], y[part], s=7, label=name)
    right.set(xscale="log", yscale="log", xlabel="friction by the law, held out", ylabel="computed")
    right.legend(frameon=False)
    write_figure(figure, folder, "heat", writer=Writer(overwrite=True))
    plt.close(figure)


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the sweeps or report on their results."""
    parser = argparse.ArgumentParser("a step of scripts/study heat", description=__doc__)
    parser.add_argument("step", choices=("cases", "report"))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--lines", type=int, default=1200)
    parser.add_argument("--points", type=int, default=600)
    parser.add_argument("--more", type=int, default=160)
    parser.add_argument("--cells", type=int, default=128)
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> None:
    if options.step == "cases":
        write_cases(options.folder, options.lines, options.points, options.more, options.cells)
    else:
        report(options.folder)


if __name__ == "__main__":
    sys.exit(main())
