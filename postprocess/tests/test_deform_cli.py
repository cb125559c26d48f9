import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from contact import EXPERIMENT, experiment
from long_tests import IS_LONG
from synthetic import written_names

import ehlwave
from ehlwave.cli import main
from ehlwave.contact.formula import amplitude_ratio_formula, recommended_ratio

pytestmark = pytest.mark.usefixtures("legible_figures")

Capture = pytest.CaptureFixture[str]
CONDITIONS = ["--conditions", *(f"{key}={value}" for key, value in EXPERIMENT.items())]


def cosine_file(folder: Path) -> Path:
    x = np.arange(400) * 1.2
    table = np.column_stack((x, 20 * np.cos(2 * np.pi * x / 60)))
    np.savetxt(folder / "t.csv", table, delimiter=",", header="x_um,z_nm", comments="", fmt="%.15g")
    return folder / "t.csv"


def test_deform_writes_profile_spectrum_report_and_figures(tmp_path: Path, capsys: Capture) -> None:
    arguments = [
        "deform",
        str(cosine_file(tmp_path)),
        *CONDITIONS,
        "--form",
        "none",
        "--ends",
        "none",
        "--formula",
        "paper",
    ]
    output = tmp_path / "new" / "folder"
    assert main([*arguments, "--output", str(output)]) == 0
    figures = {
        f"{name}.{kind}" for name in ("deformed", "spectrum", "remove") for kind in ("png", "pdf")
    }
    assert written_names(output) == figures | {
        "deformed.csv",
        "deformed.h5",
        "deformed.json",
        "spectrum.csv",
    }
    assert "trace along rolling, 400 points, 480 um" in capsys.readouterr().out
    table = np.genfromtxt(output / "deformed.csv", delimiter=",", names=True)
    ratio = amplitude_ratio_formula(60e-6 * experiment().v_per_wavelength)
    np.testing.assert_allclose(table["deformed_um"], ratio * table["height_um"], atol=1e-9)
    film = ehlwave.Contact(**EXPERIMENT).film().central_m * 1e6
    np.testing.assert_allclose(table["film_um"], film - table["deformed_um"], atol=1e-8)
    spectrum = np.genfromtxt(
        output / "spectrum.csv", delimiter=",", names=True, dtype=None, encoding=None
    )
    (peak,) = spectrum[spectrum["mean_square_before_um2"] > 1e-9]
    assert peak["wavelength_um"] == pytest.approx(60)
    assert peak["mean_square_before_um2"] == pytest.approx(0.02**2 / 2)


def test_json_holds_the_statistics(tmp_path: Path, capsys: Capture) -> None:
    assert main(["deform", str(cosine_file(tmp_path)), *CONDITIONS, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["statistics"]["rq_before_m"] == pytest.approx(0.02e-6 / 2**0.5, rel=2e-2)
    assert document["conditions"]["m"] == pytest.approx(experiment().m)
    assert document["not_judged"] == [] or document["not_judged"][0]["share_before"] < 0.1


def test_across_rolling_a_trace_is_longitudinal(tmp_path: Path, capsys: Capture) -> None:
    arguments = ["deform", str(cosine_file(tmp_path)), *CONDITIONS, "--json"]
    ratios = []
    for axis in ("x", "y"):
        assert main([*arguments, "--rolling-axis", axis]) == 0
        statistics = json.loads(capsys.readouterr().out)["statistics"]
        ratios.append(statistics["rq_after_m"] / statistics["rq_before_m"])
    assert ratios[1] < ratios[0] - 0.1


@pytest.mark.parametrize(
    ("extra", "message"),
    [
        (["--refit", "absent.csv"], "absent.csv: no such file"),
        (["--table", "absent.csv"], "absent.csv: no such file"),
        (["--height-unit", "parsec"], "unknown unit of length 'parsec'"),
        (["--height-unit", "mm"], "--height-unit mm contradicts the file, whose unit is nm"),
    ],
)
def test_errors_are_one_line(
    tmp_path: Path, capsys: Capture, extra: list[str], message: str
) -> None:
    assert main(["deform", str(cosine_file(tmp_path)), *CONDITIONS, *extra]) == 2
    captured = capsys.readouterr()
    assert message in captured.err
    assert captured.err.count("\n") == 1
    assert captured.out == ""


def test_a_large_map_stays_within_memory(tmp_path: Path) -> None:
    # A quarter of 4096 x 4096 points, within a quarter of 4 GiB; daily half as many rows.
    size, most_kib = (2048, 2**20) if IS_LONG else (1024, 2**19)
    heights = np.random.default_rng(1).standard_normal((size, size)).astype(np.float32)
    np.save(tmp_path / "m.npy", 1e-2 * heights)
    arguments = ["deform", str(tmp_path / "m.npy"), *CONDITIONS, "--step", "2"]
    arguments += ["--length-unit", "um", "--height-unit", "um", "--output", str(tmp_path / "out")]
    # ru_maxrss would include the memory of the process that started this one.
    start = "import sys; from ehlwave.cli import main; status = main(); "
    start += "lines = open('/proc/self/status').read().split('VmHWM:')[1]; "
    start += "print(lines.split()[0]); sys.exit(status)"
    done = subprocess.run(
        [sys.executable, "-c", start, *arguments], check=True, capture_output=True, text=True
    )
    assert int(done.stdout.split()[-1]) < most_kib
    assert (tmp_path / "out" / "deformed.h5").stat().st_size > 2 * 4 * size**2


def test_the_formula_can_be_chosen(tmp_path: Path, capsys: Capture) -> None:
    surface = str(cosine_file(tmp_path))
    ends = ["--form", "none", "--ends", "none", "--json"]
    after = {}
    for name in ("paper", "recommended"):
        assert main(["deform", surface, *CONDITIONS, *ends, "--formula", name]) == 0
        after[name] = json.loads(capsys.readouterr().out)
    assert main(["deform", surface, *CONDITIONS, *ends]) == 0
    by_default = json.loads(capsys.readouterr().out)
    assert by_default["transfer"].startswith("atlas")
    assert by_default["error_m"] < 0.05 * by_default["statistics"]["rq_before_m"]
    assert after["paper"]["error_m"] is None
    contact = experiment()
    wave = 60e-6 / contact.semi_axis_a_m
    expected = recommended_ratio(contact.m, contact.l, contact.gamma, wave, 0)
    found = after["recommended"]["statistics"]
    assert found["rq_after_m"] / found["rq_before_m"] == pytest.approx(float(expected), rel=1e-6)
