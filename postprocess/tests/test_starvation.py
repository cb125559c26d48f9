import itertools
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from ehlwave.contact.formula import power_ratio
from ehlwave.contact.starvation import (
    FILM_BAR,
    FILM_COEFFICIENTS,
    FILM_RANGES,
    WAVE_BAR,
    WAVE_COEFFICIENTS,
    WAVE_RANGES,
    film_over_flooded,
    starved_ratio,
)
from ehlwave.errors import RangeError
from studies.starvation import OIL_OF_WAVES, WAVES, contacts, film_law, fit, main, usable

# R of M = 100, L = 12.05, D = 1 at 64 cells per a, tests/verification/test_starvation.py.
COMPUTED = {2: 0.944, 1: 0.797, 0.7: 0.642, 0.5: 0.484}


def test_film_law_beside_computed_films() -> None:
    law = film_over_flooded(list(COMPUTED), 100, 12.05, 1)
    assert np.abs(law - list(COMPUTED.values())).max() < 0.03


def test_film_law_at_its_limits() -> None:
    for corner in itertools.product(*(FILM_RANGES[name] for name in "MLD")):
        r = np.linspace(*FILM_RANGES["r"], 200)
        ratio = film_over_flooded(r, *corner)
        assert np.all(np.diff(ratio) > 0)
        assert np.all((ratio < 1) & (ratio <= r))
        assert ratio[0] > 0.94 * r[0]


def test_less_oil_reduces_waves_more() -> None:
    film = np.linspace(*WAVE_RANGES["R"], 20)
    for wave_x, wave_y in ((0.5, 0), (1, 1), (0, 1)):
        ratio = starved_ratio(film, 200, 10, 0.8, wave_x, wave_y)
        assert np.all(np.diff(ratio) > -0.002)  # short waves have a flat top
        assert ratio[0] < ratio[-1] - 0.1


@pytest.mark.parametrize("values", [(0.1, 100, 10, 1), (1, 10, 10, 1), (1, 100, 10, 0.05)])
def test_outside_the_range(values: tuple[float, ...]) -> None:
    with pytest.raises(RangeError, match="outside"):
        film_over_flooded(*values)


def test_outside_the_range_of_waves() -> None:
    with pytest.raises(RangeError, match=r"R = 0\.2 is outside"):
        starved_ratio(0.2, 100, 10, 1, 1, 0)


def test_fit_finds_the_law_it_was_made_of() -> None:
    rows = [
        contact | {"oil_over_flooded": r}
        for contact in contacts(8, (20, 2, 0.1), (1000, 20, 1))
        for r in (0.3, 0.6, 1, 2, 4)
    ]
    columns = {name: np.array([row[name] for row in rows], dtype=float) for name in rows[0]}
    law = film_law(columns)
    films = law(np.array(FILM_COEFFICIENTS))
    contact = columns["load_parameter_m"].astype(str)
    row = fit("R", law, films, contact, (1.0, 0, 0, 0, 0))
    assert [row[f"c{k}"] for k in range(5)] == pytest.approx(FILM_COEFFICIENTS, abs=1e-4)
    assert row["rms_held_out"] < 1e-6
    assert power_ratio(1 / 0.3, 3.0) == pytest.approx(0.3 / (1 + 0.3**3) ** (1 / 3))


def test_cases(tmp_path: Path) -> None:
    assert main(["cases", str(tmp_path), "--contacts", "4"]) == 0
    waves = pd.read_csv(tmp_path / "waves.csv")
    assert len(waves) == 2 * (1 + len(OIL_OF_WAVES)) * len(WAVES)
    assert waves["oil_over_flooded"].isna().sum() == 2 * len(WAVES)
    assert "flooded" in (tmp_path / "films.nml").read_text()


def test_contacts_that_fill_at_the_edge_do_not_count() -> None:
    inside = {"status": "converged", "meniscus_x": -1.5, "domain_x_min": -4.5, "gamma": 1.0}
    rows = [inside, inside | {"meniscus_x": -4.4}, inside | {"status": "stalled"}]
    rows += [inside | {"meniscus_x": float("nan")}]
    rows = [row | {"oil_offered": 1.0} for row in rows]
    rows += [inside | {"meniscus_x": float("nan"), "oil_offered": float("nan")}]
    assert len(usable(rows)["gamma"]) == 1
    assert usable(rows, is_flooded=True)["film_over_flooded"].tolist() == [1.0]


def test_record_has_the_coefficients_and_errors_of_the_laws() -> None:
    place = Path(__file__).parents[1] / "record/starvation/laws.csv"
    rows = pd.read_csv(place).set_index("law")
    for name, known, bar in (
        ("R", FILM_COEFFICIENTS, FILM_BAR),
        ("Ad/Ai", WAVE_COEFFICIENTS, WAVE_BAR),
    ):
        found = [rows.loc[name, f"c{k}"] for k in range(len(known))]
        assert found == pytest.approx(known, abs=6e-4)
        assert bar / 4 < rows.loc[name, "rms_held_out"] < bar / 2
    assert rows.loc["R", "rms_held_out"] < rows.loc["R, one g", "rms_held_out"] / 3


def test_record_of_tracks() -> None:
    place = Path(__file__).parents[1] / "record/starvation/tracks.csv"
    rows = pd.read_csv(place)
    assert (rows["mass_balance_largest"] < 1e-6).all()
    assert (rows["closed_form_largest"] < 0.05).all()
    thin = rows[rows["overrollings"] == 60].iloc[0]
    both = thin["loss_first_inlet"] + thin["loss_first_sides"]
    assert thin["loss_first"] == pytest.approx(both, rel=0.2)


def test_record_of_the_other_solver() -> None:
    place = Path(__file__).parents[1] / "record/starvation/other_solver.csv"
    rows = pd.read_csv(place)
    apart = rows["ratio"] - rows["ratio_other"]
    assert apart.to_numpy() == pytest.approx(rows["difference"], abs=2e-4)
    assert apart.abs().max() < 0.0241
    left = (apart - rows["by_film"]).abs().groupby(rows["r"]).max()
    assert left[1.0] < 0.0071
    assert left[0.7] < 0.0101
    assert left[0.5] < 0.0165
