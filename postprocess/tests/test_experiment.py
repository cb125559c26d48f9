import csv
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from synthetic import write_results

from ehlwave.errors import ResultsError
from ehlwave.results.schema import REQUIRED_COLUMNS
from ehlwave.surface import conditions_from_keys
from studies.experiment import FOLDER, section
from studies.experiment.__main__ import main
from studies.experiment.cases import (
    COSINE,
    GRIDS,
    PAPER_ML,
    PRINTED_L,
    PRINTED_M,
    SMOOTH,
    SPEEDS,
    TRACE,
    Run,
    all_runs,
    keys_of,
    read_input,
)
from studies.experiment.discussion import outcome
from studies.experiment.maps import RED_UM, REFRACTIVE_INDEX, fringes
from studies.experiment.measure import (
    extrapolated,
    half_range_um,
    line_amplitude_um,
    line_mean_um,
    line_transfer,
    read_solved,
    richardson,
    smooth_film_um,
    time_amplitude_um,
    time_mean_um,
)
from studies.experiment.trace import AMPLITUDE_UM
from studies.section import COMPARISON

INPUTS = Path(__file__).parents[2] / "inputs" / "full"
A_UM, C_UM = 184.6, 2.722
SMOOTH_UM = {0.024: 0.24, 0.048: 0.38, 0.096: 0.60}


def write_runs(
    folder: Path, surface: str, film_um: dict[float, float], amplitude_um: float, **columns: str
) -> None:
    """Write the results of a sweep: waves of 60 um on levels, with errors of second order."""
    runs = all_runs(surface)
    base = read_input(INPUTS / "experiment.nml")
    rows = []
    for number, run in enumerate(runs):
        error = (64 / run.cells_x) ** 2
        level = film_um[run.speed] * (1 - 0.2 * error)
        write_fields(folder, surface, number, run, level, amplitude_um * (1 + 0.5 * error))
        keys = keys_of(run, base, 0.24e-6)
        data = {name: keys.get(name, base["conditions"][name]) for name in base["conditions"]}
        moes = conditions_from_keys(data | {"pressure_viscosity_per_pa": 2.25e-8})
        row = {
            **dict.fromkeys(REQUIRED_COLUMNS, 0.0),
            "case_id": f"{number:02d}",
            "orientation": "none",
            "status": "converged",
            "central_film": level / C_UM,
            "central_film_um": level,
            "mean_film_rise": 0.01 / AMPLITUDE_UM,
            "load_parameter_m": moes.m,
            "lubricant_parameter_l": moes.l,
            "alphabar": 12.36,
            "lambdabar": 0.0159,
            "time_steps": 0,
            "residual": 1e-5,
            "points_per_wave_x": 0.0,
            "inlet_resolution": 0.07,
            "seconds": 1.0,
        }
        rows.append(row | columns)
    write_results(
        folder / f"{surface}.h5", {name: np.array([row[name] for row in rows]) for name in rows[0]}
    )


def write_fields(
    folder: Path, surface: str, number: int, run: Run, level: float, height: float
) -> None:
    """Write the fields and the history of a run: a wave of an amplitude on a level, um."""
    x, y = np.linspace(-2.5, 1.5, run.cells_x + 1), np.linspace(0, 2, 9)
    line = level + height * np.cos(2 * np.pi * x * A_UM / 60 + 0.7)
    film = np.broadcast_to(line, (y.size, x.size)) + 0.01 * y[:, None] ** 2
    fields = {"film": (("y", "x"), film / C_UM), "pressure": (("y", "x"), np.ones(film.shape))}
    lengths = {
        "semi_axis_a_m": A_UM * 1e-6,
        "hertz_approach_c_m": C_UM * 1e-6,
        "hertz_pressure_pa": 0.549e9,
    }
    contact = xr.Dataset({**fields, **lengths}, {"x": x, "y": y}, {"format": "ehlwave-case"})
    if surface != SMOOTH:
        time = np.arange(0, 4.5, 4 / run.cells_x)
        history = level + height * np.cos(2 * np.pi * time * A_UM / 60 + 0.3)
        contact = contact.assign_coords(time=time).assign(film_at_centre=("time", history / C_UM))
    path = folder / f"{surface}.store" / "fields" / f"{number:02d}.h5"
    path.parent.mkdir(parents=True, exist_ok=True)
    contact.to_netcdf(path, engine="h5netcdf")


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a study whose films are known: waves raise them by 10 nm."""
    folder = tmp_path_factory.mktemp("study")
    for step in (SMOOTH, TRACE, COSINE):
        assert main([step, str(folder)]) == 0
        raised = {speed: film + (step != SMOOTH) * 0.01 for speed, film in SMOOTH_UM.items()}
        write_runs(folder / FOLDER, step, raised, 0 if step == SMOOTH else 0.13)
    return folder


def test_measures_find_the_wave_and_the_level_on_both_grids(study: Path) -> None:
    for kind in (TRACE, COSINE):
        for measure, expected in (
            (line_mean_um, 0.25),
            (time_mean_um, 0.25),
            (line_amplitude_um, 0.13),
            (time_amplitude_um, 0.13),
        ):
            found = extrapolated(study / FOLDER, kind, 0.024, measure)
            assert found.value == pytest.approx(expected, rel=2e-4)
            assert 0.5 * abs(found.coarse - found.fine) < found.error < abs(found.value - 0.2)
    solved = read_solved(study / FOLDER, Run(TRACE, 0.024, *GRIDS[1]))
    assert np.angle(line_transfer(solved)) == pytest.approx(0.7, abs=1e-3)
    assert half_range_um(solved) == pytest.approx(0.13, rel=0.03)
    smooth = extrapolated(study / FOLDER, SMOOTH, 0.096, smooth_film_um)
    assert smooth.value == pytest.approx(0.60, rel=1e-10)


def test_richardson_is_exact_for_errors_of_second_order() -> None:
    found = richardson(3 + 0.9, 3 + 0.4, 1.5)
    assert (found.value, found.error) == pytest.approx((3, 0.4))


def test_section_compares_every_number_and_says_what_misses(study: Path) -> None:
    found = section(study)
    tables = {table.name: table for table in found.tables}
    films, printed = (
        {row[0]: row for row in tables[f"experiment-{name}"].data.itertuples(index=False)}
        for name in ("comparison", "conditions")
    )
    assert tuple(tables["experiment-comparison"].data.columns) == COMPARISON
    row = films["mean film, computed at 0.096 m/s"]
    assert row[2:5] == pytest.approx((0.62, 0.61, -0.01), abs=1e-4)
    assert films["smooth central film at 0.024 m/s"][3] == pytest.approx(0.24)
    assert films["rise of the mean film by the waves at 0.024 m/s"][3] == pytest.approx(
        0.01, abs=2e-4
    )
    # these fields' level is a "smooth" film of the cosine: 0.01 um are added to it
    assert films["mean film, second order at 0.048 m/s"][3] == pytest.approx(0.40)
    assert films["Ad/Ai, cosine at 0.048 m/s"][3] == pytest.approx(0.13 / 0.14, rel=1e-3)
    assert printed["V at 0.048 m/s"][3] == pytest.approx(1.035, abs=0.01)
    assert printed["W"][3] == pytest.approx(2.1374e-6, rel=1e-4)
    assert "0.2400 um beside 0.24 um (+0.0 %, within the target of 3 %)" in found.text[1]
    assert len(found.pictures) == 5


def test_a_run_that_did_not_converge_is_named(tmp_path: Path) -> None:
    write_runs(tmp_path, SMOOTH, SMOOTH_UM, 0, status="unresolved")
    run = Run(SMOOTH, 0.024, *GRIDS[0])
    with pytest.raises(ResultsError, match=r"smooth-0.024-256 has status unresolved"):
        read_solved(tmp_path, run)
    with pytest.raises(ResultsError, match="run the stage first"):
        section(tmp_path)


def test_outcome_says_when_a_target_is_missed() -> None:
    assert outcome(-0.02, 0.03) == "-2.0 %, within the target of 3 %"
    assert outcome(0.081, 0.08) == "+8.1 %, MISSES the target of 8 %"
    assert "MISSES" in outcome(float("nan"), 0.08)


def test_inputs_say_what_is_meant(study: Path) -> None:
    base = read_input(INPUTS / "experiment.nml")
    run = Run(COSINE, 0.048, 128, 64)
    keys = keys_of(run, base, 0.28e-6)
    assert keys["amplitude_over_film"] == pytest.approx(0.5)
    assert keys["wavelength_over_a"] == pytest.approx(60 / 184.614, rel=1e-4)
    assert (keys["cells_x"], keys["mean_speed_m_per_s"]) == (128, 0.048)
    with pytest.raises(ValueError, match="smooth contact"):
        keys_of(run, base)
    for speed in SPEEDS:
        printed = keys_of(Run(TRACE, speed, 128, 64, PAPER_ML), base)
        given = base["conditions"] | printed | {"pressure_viscosity_per_pa": 2.25e-8}
        moes = conditions_from_keys({k: v for k, v in given.items() if not k.startswith("cells")})
        assert (moes.m, moes.l) == pytest.approx((PRINTED_M[speed], PRINTED_L[speed]))
    with pytest.raises(ResultsError, match="no such file"):
        read_input(INPUTS / "none.nml")

    files = study / FOLDER
    groups = {kind: read_input(files / f"{kind}.nml") for kind in (SMOOTH, TRACE, COSINE)}
    surface = Path(groups[TRACE]["surface"]["file"])
    assert (surface.parent, surface.exists()) == (files, True)
    assert [kind for kind in groups if "dynamics" in groups[kind]] == [TRACE, COSINE]
    assert "surface" not in groups[COSINE] | groups[SMOOTH]
    with (files / f"{COSINE}.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    # counted in the film of the smooth contact on the same grid
    expected = 0.14 / (0.24 * (1 - 0.2 * (64 / 256) ** 2))
    assert float(rows[0]["amplitude_over_film"]) == pytest.approx(expected)


def test_fringes_are_dark_where_the_reflections_cancel() -> None:
    quarter = RED_UM / (4 * REFRACTIVE_INDEX)
    colours = fringes(np.array([0, quarter, 2 * quarter]))
    np.testing.assert_allclose(colours[:, 0], [0, 1, 0], atol=1e-12)
    assert colours[:, 2].max() == 0
