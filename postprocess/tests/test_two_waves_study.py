"""The study of two waves: its cases, its fit on points that follow the law, the recorded shapes."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from ehlwave.contact.rolling import rolling_transfer
from ehlwave.surface import Mover, TwoWaveTransfer, conditions_from_keys
from studies.two_waves.cases import cases
from studies.two_waves.computed_waves import ComputedWaves
from studies.two_waves.fit import PACKAGED, amplitude_error, fitted_launch, fitted_rolling
from studies.two_waves.passing import WINDOW
from studies.two_waves.points import Pairs, Rolling
from studies.two_waves.shapes import LENGTH, PLACE, SHARE, SIGNS, conditions_at, shape

RECORD = Path(__file__).parents[1] / "record" / "two_waves"


def synthetic(count: int) -> tuple[Rolling, Pairs]:
    """Points that follow the installed law, at conditions of the study."""
    rows = pd.DataFrame(list(cases(5, count)))
    sliding = rows[rows["slip_parameter"] != 1].reset_index(drop=True)
    moes = ["load_parameter_m", "lubricant_parameter_l", "radius_ratio_d"]
    contacts = [
        conditions_from_keys(row, needs_lengths=False) for row in sliding[moes].to_dict("records")
    ]
    random = np.random.default_rng(4)
    size = len(sliding)
    table = sliding.assign(
        m=sliding["load_parameter_m"],
        l=sliding["lubricant_parameter_l"],
        slip=sliding["slip_parameter"],
        gamma=[one.gamma for one in contacts],
        alphabar=[one.alphabar for one in contacts],
        along=random.uniform(0.1, 1, size),
        thinning=random.uniform(0, 0.2, size),
        condition=sliding[moes].astype(str).agg("|".join, axis=1),
    )
    table["load"] = table["gamma"] * table["m"]
    waves = (table["wavelength_x_over_a"].to_numpy(), table["wavelength_y_over_a"].to_numpy())
    moes_values = (table[name].to_numpy() for name in ("m", "l", "gamma"))
    rolled = rolling_transfer(*moes_values, *waves)
    attenuated = random.uniform(0, 1, size) * np.exp(1j * random.uniform(-1, 1, size))
    mismatch = random.uniform(-4, 4, size) + 1j * random.uniform(0, 1, size)
    none = np.zeros(size)
    waves = rolled, attenuated, mismatch, 0.3 * mismatch
    film = PACKAGED.film(Pairs(table, none.astype(complex), *waves, none))
    return Rolling(table, rolled, none), Pairs(table, film, *waves, none)


def test_each_wave_rolls_and_slides() -> None:
    rows = list(cases(5, 3))
    assert len(rows) == 60
    wave = ("load_parameter_m", "wavelength_x_over_a", "wavelength_y_over_a")
    for rolled, slid in zip(rows[::2], rows[1::2], strict=True):
        assert rolled["slip_parameter"] == 1
        assert 0.03 <= abs(slid["slip_parameter"] - 1) <= 0.8
        assert all(rolled[key] == slid[key] for key in wave)


def test_fits_find_the_law_that_made_the_points() -> None:
    rolling, pairs = synthetic(12)
    np.testing.assert_allclose(fitted_launch(pairs), PACKAGED.launch, rtol=1e-3)
    changed = pairs.film * 1.1
    assert amplitude_error(PACKAGED.film(pairs), changed) > 0.02
    amplitude, _ = fitted_rolling(rolling)
    np.testing.assert_allclose(amplitude, PACKAGED.amplitude, rtol=0.02, atol=0.005)


def test_computed_waves_are_those_of_the_table() -> None:
    """Both waves add up to the table's response; stationary waves have the table's response."""
    contact = conditions_at(1.3)
    lengths = (0.5, 1.0, 4.0)
    pairs = [(x, y) for x in (*lengths, 0.0) for y in (*lengths, 0.0) if x or y]
    table = pd.DataFrame(pairs, columns=["wavelength_x_over_a", "wavelength_y_over_a"])
    random = np.random.default_rng(8)
    for name in ("harmonic", "attenuated_formula", "psi_formula"):
        for part in ("real", "imaginary"):
            table[f"{name}_{part}"] = random.normal(size=len(table))
    transfer = ComputedWaves(contact, table.sample(frac=1, random_state=2))
    moving = table[table["wavelength_x_over_a"] > 0]
    per_y = [1 / y if y else 0.0 for y in moving["wavelength_y_over_a"]]
    per_metre = np.array([1 / moving["wavelength_x_over_a"], per_y]) / contact.semi_axis_a_m
    both = transfer.waves(*per_metre * (1 - 1e-12))
    response = (moving["harmonic_real"] + 1j * moving["harmonic_imaginary"]).to_numpy()
    np.testing.assert_allclose(both.at(0.0), response, atol=1e-9)
    standing = table[table["wavelength_x_over_a"] == 0]
    still = transfer.ratio(
        np.zeros(3), 1 / standing["wavelength_y_over_a"].to_numpy() / contact.semi_axis_a_m
    )
    np.testing.assert_allclose(still.real, standing["harmonic_real"], atol=1e-9)
    short = transfer.waves(np.array([3.0]) / contact.semi_axis_a_m, np.zeros(1))
    assert short.at(0.0) == 1


@pytest.mark.parametrize("slip", [1.3, 0.7])
@pytest.mark.parametrize("name", SIGNS)
def test_recorded_shapes(name: str, slip: float) -> None:
    """Both computed waves come within 5 per cent of Rq of the simulation, the law within 9."""
    rows = pd.read_csv(RECORD / "profiles.csv")
    rows = rows[rows["x"].abs() <= WINDOW]
    simulated = rows[f"{name}, S = {slip}, simulated"]
    rq = float(np.std(rows[f"{name}, surface"]))
    waves = rows[f"{name}, S = {slip}, computed waves"]
    assert np.sqrt(np.mean((waves - simulated) ** 2)) < 0.05 * rq
    contact = conditions_at(slip)
    film = contact.central_film_m
    assert film is not None
    mover = Mover(
        shape(name, film), TwoWaveTransfer(contact), (LENGTH / 2 - PLACE) * contact.semi_axis_a_m
    )
    change = mover.film_change(rows["x"].to_numpy() * contact.semi_axis_a_m, 0.0)
    left = change / (SHARE * film) - simulated.to_numpy()
    assert np.sqrt(np.mean(left**2)) < 0.09 * rq
