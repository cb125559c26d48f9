"""Errors of laws that follow from records of studies: rows of ``error_bars.csv`` in the package.

``python -m studies.error_bars`` writes them anew. Rows with another basis than ``record`` stay.
"""

import csv
import io
import json
import math
import sys
from collections.abc import Callable

import numpy as np
import pandas as pd

import ehlwave
from ehlwave.contact.conditions import MOES_KEYS
from ehlwave.contact.line_contact import line_film
from ehlwave.contact.scales import moes_film
from ehlwave.error_bars import TABLE, bars
from ehlwave.laws.atlas.atlas import load_atlas, shipped
from ehlwave.laws.atlas.kinds import KINDS
from ehlwave.surface.amplitude import RISE_KINDS
from ehlwave.writing import Writer
from studies.programs import ROOT

Found = dict[str, tuple[float, int]]
"""Value and number of contacts or waves of each row."""
RECORD = ROOT / "postprocess" / "record"
LOADS, LUBRICANTS, RATIOS = (20.0, 2000.0), (2.0, 20.0), (0.04, 1.0)
"""M, L and D of drawn contacts."""
DRAWN = 600
SMALL = 0.05
"""Rq over the film of the map whose errors come from the grid and the atlas alone."""


def formulas() -> Found:
    """Return by how much film formulas are too thick, and by how much slip thins films."""
    rng, over, thinned = np.random.default_rng(1), {}, []
    for kind, fit in (("rolling", moes_film), ("line", lambda *moes: line_film(*moes[:2]))):
        atlas, found = load_atlas(shipped(KINDS[kind])), []
        for _ in range(DRAWN):
            m, l, d = _moes(rng)
            keys = {"load_parameter_m": m, "lubricant_parameter_l": l, "radius_ratio_d": d}
            keys |= {"pressure_viscosity_per_pa": 2.2e-8, "roelands_index": 0.68}
            found.append(float(fit(m, l, d)) / atlas.at(keys).film().central_moes - 1)
        over[kind] = found
    for _ in range(DRAWN):
        keys = dict(zip(MOES_KEYS, _moes(rng), strict=True))
        oil = {"reduced_modulus_pa": 2.2e11, "slip_parameter": float(rng.uniform(0.5, 1.5))}
        oil["eyring_stress_pa"] = float(np.exp(rng.uniform(*np.log((0.9e6, 43e6)))))
        films = [ehlwave.Contact(**keys, **of).film().central_moes for of in (oil, {})]
        thinned.append(1 - films[0] / films[1])
    return {
        "film.formula": (float(np.percentile(over["rolling"], 97.5)), DRAWN),
        "film.formula_line": (max(over["line"]), DRAWN),
        "film.thinned": (float(np.percentile(thinned, 97.5)), DRAWN),
    }


def _moes(rng: np.random.Generator) -> tuple[float, float, float]:
    m, d = (float(np.exp(rng.uniform(*np.log(ends)))) for ends in (LOADS, RATIOS))
    return m, float(rng.uniform(*LUBRICANTS)), d


def rises() -> Found:
    """Return errors of the rise of the mean film, over the square of the amplitude."""
    found = {}
    for kind in RISE_KINDS:
        data = load_atlas(shipped(KINDS[kind])).data
        judged = json.loads(data.attrs["rise_cross_validated"])
        found[f"rise.{kind}"] = (judged["95 %"], 0)
    return found


def heat() -> Found:
    """Return errors of friction: 95 % of contacts held out are within."""
    warm = pd.read_csv(RECORD / "heat/laws.csv").set_index("law").loc["friction"]
    light = pd.read_csv(RECORD / "heat/ends_law.csv").iloc[0]
    return {
        "heat.friction": (math.expm1(warm["within_95"]), int(warm["contacts"])),
        "light_lines.friction": (light["within_95"], int(light["contacts"])),
    }


def two_waves() -> Found:
    """Return errors of the law of the two waves: twice the rms error held out."""
    table = pd.read_csv(RECORD / "two_waves/errors.csv").set_index("points")
    found = {}
    for name, points in (("ree-eyring", "Ree-Eyring"), ("newtonian", "of them Newtonian")):
        row = table.loc[points]
        found[f"two_waves.{name}"] = (2 * row["rms of a + c"], int(row["number"]))
    return found


def profiles() -> Found:
    """Return the error of Rq over the square of the amplitude: 95 % of marched maps are within."""
    maps = changes_of_maps()
    return {
        "profile.second_order": (
            float(np.quantile(maps["rq_change"].abs() / maps["square"], 0.95)),
            len(maps),
        )
    }


def changes_of_maps() -> pd.DataFrame:
    """Return the converged marches of ``record/lambda`` with the errors of their predictions."""
    table = pd.read_csv(RECORD / "lambda/marches.csv")
    table = table[table["status"].isin(("converged", "unresolved"))].copy()
    table["square"] = 2 * table["rq_over_film"] ** 2
    table["rq_error"] = table["rq_predicted"] / table["rq_marched"] - 1
    small = table[table["level"] == SMALL].set_index(["contact", "motion", "lay", "seed"])
    same = pd.MultiIndex.from_frame(table[list(small.index.names)])
    base = small["rq_error"].reindex(same).to_numpy()
    table["rq_change"] = (1 + table["rq_error"]) / (1 + base) - 1
    mean = table["mean_linear"] + table["rise"]
    table["mean_change"] = table["mean_marched"] - mean
    ratio = mean / table["mean_marched"] / (1 + table["rq_error"])
    table["lambda_error"] = ratio - 1
    return table[table["level"] > SMALL]


LAWS: tuple[Callable[[], Found], ...] = (formulas, rises, heat, two_waves, profiles)


def rounded_up(value: float) -> float:
    """Return a value with two digits, rounded up."""
    digits = 1 - math.floor(math.log10(value))
    return round(math.ceil(round(value * 10**digits, 6)) / 10**digits, digits)


def main() -> int:
    """Write the rows that follow from records."""
    rows = {name: dict(row) for name, row in bars().items()}
    for law in LAWS:
        for name, (value, count) in law().items():
            print(f"{name}: {value:.4g} of {count}, was {rows[name]['value']}")
            rows[name] |= {"value": f"{rounded_up(value):g}", "count": str(count or "")}
    file = io.StringIO(newline="")
    writer = csv.DictWriter(file, next(iter(rows.values())), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows.values())
    Writer(overwrite=True).text(ROOT / "postprocess" / "src" / "ehlwave" / TABLE, file.getvalue())
    return 0


if __name__ == "__main__":
    sys.exit(main())
