"""Identification of oils from synthetic measurements, whose parameters are known."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import ehlwave
from ehlwave.cli import main
from ehlwave.contact.alpha_estimates import ESTIMATES
from ehlwave.errors import ArgumentError, RangeError
from ehlwave.identify import identification_figure, identify, read_measurements
from studies import identified
from studies.identified import BALL, FAR, NOISE, SPEEDS, films, frictions
from studies.published.films import ALPHA_PER_PA, alpha_of_runs

RECORD = Path(__file__).parents[1] / "record" / "validation" / "identified.csv"


def test_intervals_hold_the_true_value() -> None:
    """95 % intervals of 25 fits hold alpha in at least 21: fewer have a probability of 0.7 %."""
    held = 0
    for seed in range(25):
        (alpha,) = identify(films(seed), FAR, ["alpha"], by="laws").parameters
        assert alpha.is_identified
        assert abs(alpha.value / 1.8e-8 - 1) < 0.08
        held += alpha.low <= 1.8e-8 <= alpha.high
    assert held >= 21


def test_recorded_draws() -> None:
    """Intervals of 93 to 97 % of 300 draws hold alpha and stress; two draws are fitted again."""
    record = pd.read_csv(identified.RECORD, index_col="draw")
    assert len(record) == identified.DRAWS
    assert record.index.is_unique
    for name in ("alpha_held", "stress_held"):
        assert 0.93 <= record[name].mean() <= 0.97
    for draw in (record.index[0], record.alpha_deviation.abs().idxmax()):
        row = identified.drawn(draw)
        for name, value in record.loc[draw].items():
            assert row[name] == pytest.approx(value, rel=0.01, abs=0.02), (draw, name)


def test_speed_and_temperature() -> None:
    table = films(1, decay=0.035, temperatures=(40.0, 60.0, 80.0))
    found = identify(table, FAR, ["alpha", "viscosity_temperature"], error=NOISE, by="laws")
    alpha, decay = found.parameters
    assert alpha.low < 1.8e-8 < alpha.high
    assert decay.low < 0.035 < decay.high
    assert found.reference_k == pytest.approx(333.15)
    assert found.rms == pytest.approx(NOISE, rel=0.5)
    with pytest.raises(ArgumentError, match="viscosity_temperature"):
        identify(table, FAR, ["alpha"], by="laws")


def test_traction_curve_and_figure() -> None:
    keys = BALL | {"mean_speed_m_per_s": 1.0}
    found = identify(frictions(2, 6e6), keys, ["eyring_stress"], by="laws")
    (stress,) = found.parameters
    assert stress.low < 6e6 < stress.high
    assert stress.error < 0.05
    assert len(identification_figure(found).axes) == 2


def test_published_films() -> None:
    """Films of FVA 3 imply the alpha of their thesis: together, and on each day at 40 C."""
    table = alpha_of_runs().set_index("run")
    published = 1e9 * ALPHA_PER_PA
    assert table.low["all"] < published < table.high["all"]
    assert table.low["40"] < published < table.high["40"]
    scatter = ESTIMATES["gold"].scatter
    assert abs(table.alpha_per_gpa["40 again"] / published - 1) < scatter
    record = pd.read_csv(RECORD, index_col="run")
    for name in ("alpha_per_gpa", "low", "high"):
        assert np.allclose(record[name], table[name], rtol=0.01), name


def test_what_films_do_not_determine() -> None:
    """Films know one combination of alpha and viscosity, and nothing of the Eyring stress."""
    found = identify(films(3), BALL, ["alpha", "viscosity", "eyring_stress"], by="laws")
    assert not any(one.is_identified for one in found.parameters)
    text = " ".join(found.notes)
    assert "eyring_stress_pa is not identified" in text
    assert "pressure_viscosity_per_pa and viscosity_pa_s cannot be told apart" in text


def test_friction_and_films_together() -> None:
    """A traction curve beside the films tells alpha and stress apart."""
    both = pd.concat([films(4), frictions(4, 6e6).assign(mean_speed_m_per_s=1.0)])
    found = identify(both, FAR, ["alpha", "eyring_stress"], error=NOISE, by="laws")
    assert all(one.is_identified for one in found.parameters)
    alpha, stress = found.parameters
    assert alpha.low < 1.8e-8 < alpha.high
    assert stress.low < 6e6 < stress.high


def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    films(5).to_csv(tmp_path / "films.csv", index=False)
    groups = "&conditions {} /\n&lubricant pressure_viscosity_per_pa = 2.4e-8 /\n".format(
        ", ".join(f"{key} = {BALL[key]}" for key in BALL if key != "pressure_viscosity_per_pa")
    )
    (tmp_path / "ball.nml").write_text(groups)
    words = ["identify", str(tmp_path / "films.csv"), "--conditions", str(tmp_path / "ball.nml")]
    assert main([*words, "--fit", "alpha", "--json", "--output", str(tmp_path / "out")]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["parameters"]["pressure_viscosity_per_pa"]["is_identified"] is True
    assert len(found["rows"]) == len(SPEEDS)
    assert {path.name for path in (tmp_path / "out").iterdir()} >= {"identify.csv", "identify.png"}
    assert main([*words, "--fit", "alfa"]) == 2
    assert "alpha" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"speed": [1], "central_film_um": [0.1]}, "speed"),
        ({"mean_speed_m_per_s": [1]}, "no measured result"),
        ({"mean_speed_m_per_s": [1], "central_film_um": [-0.1]}, "above 0"),
        ({"central_film_um": [0.1], "central_film_nm": [100]}, "two columns"),
        ({"SRR": [5], "Traction coefficient": [0.05]}, r"SRR has no unit: write one of .*\[%\]"),
        ({"Film thickness (in)": [1e-5]}, "has the unit in"),
    ],
)
def test_tables_that_are_refused(table: dict[str, list[float]], words: str) -> None:
    with pytest.raises(ArgumentError, match=words):
        read_measurements(pd.DataFrame(table))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "no such file|not a CSV table"),
        ("mean_speed_m_per_s\n1\n", "no measured result"),
        ("mean_speed_m_per_s,central_film_um\n", "no measured value"),
        ("mean_speed_m_per_s,central_film_um\n1,nan\n", "no measured value"),
        ("mean_speed_m_per_s,central_film_um\n1,0.3 um\n", "no numbers"),
        ("mean_speed_m_per_s,central_film_um\n1,0.3,5\n", "more cells than the heading"),
        ("mean_speed_m_per_s,central_film_um\n1,300\n", "at most 0.0001: check its unit"),
        ("slide_to_roll_ratio,friction_coefficient\n0.1,5\n", "at most 1: check its unit"),
        ("mean_speed_m_per_s,central_film_um\n1,inf\n2,0.5\n", "no numbers"),
        ("temperature_c,central_film_um\n-300,0.3\n", "below absolute zero"),
    ],
)
def test_files_that_are_refused(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "films.csv").write_text(text)
    with pytest.raises(ArgumentError, match=words):
        read_measurements(tmp_path / "films.csv")


def test_decimal_commas_and_spaces(tmp_path: Path) -> None:
    for text in (
        "mean_speed_m_per_s;central_film_um\n1;0,3\n",
        "mean_speed_m_per_s central_film_um\n1 0.3\n",
    ):
        (tmp_path / "films.csv").write_text(text)
        assert read_measurements(tmp_path / "films.csv").value == pytest.approx([0.3e-6])


@pytest.mark.parametrize("by", [None, "computed"])
def test_heat_beyond_its_laws_is_refused(by: str | None) -> None:
    """Computed contacts with heat have no derivatives: refused before anything is computed."""
    heat = ehlwave.Heat(313.15, 0.042, 0.14, 2000, 870)
    keys = BALL | {"load_n": 40.0 if by else 4e4}
    words = f"derivatives with heat.*leave out heat{'' if by else '.*The laws: load_n'}"
    with pytest.raises(ArgumentError, match=f"measured value 1, central_film_m: {words}"):
        identify(films(3), keys | heat.keys(), ["alpha"], by=by)
    contact = ehlwave.Contact(**keys, mean_speed_m_per_s=1, heat=heat)
    with pytest.raises(RangeError, match=words):
        contact.sensitivities(by)


def test_a_value_that_is_no_contact() -> None:
    table = pd.DataFrame({"mean_speed_m_per_s": [1.0, 0.0], "central_film_um": [0.3, 0.1]})
    with pytest.raises(ArgumentError, match=r"measured value 2.*mean_speed_m_per_s = 0"):
        identify(table, BALL, ["alpha"])
    table = pd.DataFrame({"slide_to_roll_ratio": [0.1, 0.0], "friction_coefficient": [0.03, 1e-3]})
    with pytest.raises(ArgumentError, match=r"measured value 2.* rolls has none"):
        identify(table, BALL | {"mean_speed_m_per_s": 1.0}, ["eyring_stress"])


def test_headings_of_rigs(tmp_path: Path) -> None:
    """Words with units, semicolons and tabs give the numbers of the keys."""
    (tmp_path / "film.csv").write_text(
        "Entrainment speed (mm/s);Temperature (\N{DEGREE SIGN}C);Film thickness (nm)\n"
        "500;60;213\n1000;60;338\n",
        encoding="utf-8",
    )
    (tmp_path / "traction.csv").write_text(
        "SRR [%]\tSpeed [m/s]\tLoad [N]\tTraction coefficient\n2\t1\t40\t0.031\n10\t1\t40\t0.052\n",
        encoding="utf-8",
    )
    film = read_measurements(tmp_path / "film.csv")
    assert film.result == ["central_film_m"] * 2
    assert np.allclose(film.value, [213e-9, 338e-9])
    assert film.conditions[0] == {"mean_speed_m_per_s": 0.5, "temperature_k": 333.15}
    traction = read_measurements(tmp_path / "traction.csv")
    assert np.allclose(traction.value, [0.031, 0.052])
    expected = {"slide_to_roll_ratio": 0.02, "mean_speed_m_per_s": 1.0, "load_n": 40.0}
    assert traction.conditions[0] == pytest.approx(expected)


def test_values_without_what_they_need() -> None:
    speed = {"mean_speed_m_per_s": [1.0, 2.0]}
    table = pd.DataFrame(speed | {"harmonic_ratio": [0.8, 0.7]})
    with pytest.raises(ArgumentError, match=r"value 1, harmonic_ratio: give its wavelength_over_a"):
        identify(table, BALL, ["alpha"])
    table = pd.DataFrame(speed | {"central_film_um": [0.3, 0.5], "central_film_error": [0.02, 5]})
    with pytest.raises(ArgumentError, match="outside 0 to 1: give relative standard errors"):
        identify(table, BALL, ["alpha"])


def test_equal_values(recwarn: pytest.WarningsRecorder) -> None:
    """A fit without residuals has no error by them, and no warning of a division by zero."""
    table = pd.DataFrame({"mean_speed_m_per_s": [1.0] * 3, "central_film_um": [0.3] * 3})
    (alpha,) = identify(table, BALL, ["alpha"], by="laws").parameters
    assert alpha.error == pytest.approx(0, abs=1e-6)
    assert not [one for one in recwarn if "divide" in str(one.message)]


def test_encodings(tmp_path: Path) -> None:
    """Tables of rigs in the encodings of Windows programs."""
    text = "Temperature (\N{DEGREE SIGN}C)\tFilm thickness (nm)\n60\t213\n"
    for encoding in ("cp1252", "utf-8", "utf-8-sig", "utf-16"):
        (tmp_path / "film.csv").write_text(text, encoding=encoding)
        assert read_measurements(tmp_path / "film.csv").value == pytest.approx([213e-9])


def test_more_parameters_than_values() -> None:
    table = pd.DataFrame({"mean_speed_m_per_s": [1.0], "central_film_um": [0.3]})
    with pytest.raises(ArgumentError, match="do not determine 2 parameters"):
        identify(table, BALL, ["alpha", "viscosity"])


@pytest.mark.parametrize("by", [None, "laws"])
def test_a_fit_that_leaves_the_range_of_the_laws(by: str | None) -> None:
    """Three films know one combination of two parameters: the fit ends at the edge of the atlas."""
    table = pd.DataFrame(
        {"mean_speed_m_per_s": [0.5, 1, 2], "central_film_um": [0.213, 0.338, 0.535]}
    )
    words = r"at pressure_viscosity_per_pa = 1e-08, viscosity_pa_s = .*: measured value 1, central"
    with pytest.raises(ArgumentError, match=words):
        identify(table, BALL, ["alpha", "viscosity"], by=by)


def test_a_fit_that_passes_an_edge_finds_its_minimum() -> None:
    """The first steps from far away lead outside the atlas; the fit returns."""
    table = films(6)
    found = identify(table, BALL | {"pressure_viscosity_per_pa": 2.95e-8}, ["alpha"], by="laws")
    usual = identify(table, FAR, ["alpha"], by="laws")
    assert found.parameters[0].value == pytest.approx(usual.parameters[0].value, rel=1e-5)
