"""Stresses of solved contacts: files of ehlwave-case, fields over time, and the command."""

import json
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from test_stress_rough import KEYS, contact, rough

from ehlwave import read_case
from ehlwave.cli import main
from ehlwave.errors import StressError
from ehlwave.results.case_figures import case_figure
from ehlwave.results.case_file import contact_figure
from ehlwave.stress import (
    COMPONENTS,
    hertz_circle_stress,
    line_stress_over_time,
    point_histories,
    stress_below,
    stress_of_case,
)

pytestmark = pytest.mark.usefixtures("legible_figures")

Capture = pytest.CaptureFixture[str]
A, PH = 2e-4, 1e9


def case_file(folder: Path, times: int = 0, half: bool = True, cells: int = 128) -> Path:
    """Write a circular contact with Hertz' pressure, a shear stress, and a wave that moves."""
    slip = 1.2
    x = np.linspace(-2.5, 1.5, cells + 1)
    y = np.linspace(0 if half else -2, 2, (cells // 2 if half else cells) + 1)
    pressure = np.sqrt(np.maximum(1 - x**2 - y[:, None] ** 2, 0))
    fields = {
        "pressure": (("y", "x"), pressure),
        "film": (("y", "x"), 0.1 + 0 * pressure),
        "mean_shear_stress_pa": (("y", "x"), 0.05 * PH * pressure),
        "central_film": ((), 0.1),
        "hertz_pressure_pa": ((), PH),
        "semi_axis_a_m": ((), A),
        "semi_axis_b_m": ((), A),
        "hertz_approach_c_m": ((), A**2 / 0.01),
    }
    coordinates = {"x": x, "y": y}
    if times:
        # The first is smooth; then a wave with the speed of the first surface.
        time = np.arange(times) * 0.05
        change = np.sin(4 * np.pi * (x - slip * time[:, None, None])) * pressure**2
        over = pressure + 0.1 * np.where(time[:, None, None] > 0, change, 0)
        fields["pressure_over_time"] = (("field_time", "y", "x"), over)
        fields["mean_shear_stress_over_time_pa"] = (("field_time", "y", "x"), 0.05 * PH * over)
        coordinates["field_time"] = time
    attributes = {"format": "ehlwave-case", "status": "converged"}
    attributes["effective_input"] = f"&conditions\n  slip_parameter = {slip}\n/"
    path = folder / "case.h5"
    xr.Dataset(fields, coordinates, attributes).to_netcdf(path, engine="h5netcdf")
    return path


@pytest.mark.parametrize("half", [True, False])
def test_stress_of_a_file_is_that_of_its_pressure(tmp_path: Path, half: bool) -> None:
    path = case_file(tmp_path, half=half)
    depths = np.array([0.3, 0.48, 1.0]) * A
    one, other = (stress_of_case(path, depths, body) for body in (1, 2))
    exact = hertz_circle_stress(0, 0, depths, A, PH)
    axis = one.sel(x=0, y=0, method="nearest")
    np.testing.assert_allclose(axis["szz"], exact["szz"], rtol=5e-3)
    # The oil drags the faster body back, and the slower body along.
    tops = [
        stress_of_case(path, 0.0, body).isel(z=0).sel(x=0, y=0, method="nearest") for body in (1, 2)
    ]
    assert float(tops[0]["sxz"]) == pytest.approx(0.05 * PH, rel=1e-3)
    assert float(tops[1]["sxz"]) == pytest.approx(-0.05 * PH, rel=1e-3)
    np.testing.assert_allclose(one["sxx"] + other["sxx"], 2 * stress_of_pressure(path, depths))


def stress_of_pressure(path: Path, depths: np.ndarray) -> np.ndarray:
    case = read_case(path)
    pressure = PH * case["pressure"]
    steps = tuple(A * float(case[letter][1] - case[letter][0]) for letter in "xy")
    return stress_below(pressure, steps, depths)["sxx"].values


def test_a_wave_stands_still_for_the_body_that_carries_it(tmp_path: Path) -> None:
    path = case_file(tmp_path, times=12)
    depths = np.array([0.0, 0.08]) * A
    over = line_stress_over_time(path, depths)
    assert over["sxx"].dims == ("time", "z", "x")
    first = stress_of_case(path, depths).isel(y=64)
    for name in COMPONENTS:
        np.testing.assert_allclose(over[name][0], over[f"{name}_smooth"], atol=1e-3)
    np.testing.assert_allclose(over["szz_smooth"], first["szz"], atol=1e-3 * PH)
    starts = np.array([-0.3, -0.27]) * A
    own, other = (point_histories(over, slip, starts) for slip in (1.2, 0.8))
    moved = over["time"].values[1:, None]
    smooth = [hertz_circle_stress(starts + s * moved, 0, 0, A, PH)["szz"] for s in (1.2, 0.8)]
    share = [
        (history["szz"].isel(z=0).values[1:] - part) / (PH * (part / PH) ** 2)
        for history, part in zip((own, other), smooth, strict=True)
    ]
    # The rest of the ripple over the square of the smooth pressure does not change.
    phases = np.sin(4 * np.pi * starts / A)
    np.testing.assert_allclose(share[0], np.broadcast_to(-0.1 * phases, (11, 2)), atol=4e-3)
    passing = np.sin(4 * np.pi * (starts - 0.4 * moved) / A)
    np.testing.assert_allclose(share[1], -0.1 * passing, atol=4e-3)


def test_a_case_without_lengths_counts_in_semi_axes(tmp_path: Path, capsys: Capture) -> None:
    with xr.open_dataset(case_file(tmp_path), engine="h5netcdf") as opened:
        case = opened.load()
    bare = case.drop_vars(
        ["semi_axis_a_m", "semi_axis_b_m", "hertz_pressure_pa", "mean_shear_stress_pa"]
    )
    bare["alphabar"], bare["kappa"] = 22.0, 1.0
    with pytest.raises(StressError, match="no pressure in Pa"):
        stress_of_case(bare, 0.5)
    text = bare.attrs["effective_input"] + "\n  pressure_viscosity_per_pa = 2.2E-8"
    bare.attrs["effective_input"] = text
    bare.to_netcdf(tmp_path / "bare.h5", engine="h5netcdf")
    found = stress_of_case(tmp_path / "bare.h5", 0.5)
    full = stress_of_case(case.drop_vars("mean_shear_stress_pa"), 0.5 * A)
    np.testing.assert_allclose(found["sxx"], full["sxx"], rtol=1e-6, atol=1e-3)
    assert main(["stress", str(tmp_path / "bare.h5"), "--depths", "0.3", "0.48", "0.7"]) == 0
    assert "depth a" in capsys.readouterr().out


def test_a_solved_smooth_contact_stands_for_hertz(tmp_path: Path) -> None:
    a = contact().conditions.semi_axis_a_m
    hertz = contact().conditions.alphabar / 2.2e-8
    path = case_file(tmp_path)
    with xr.open_dataset(path, engine="h5netcdf") as opened:
        case = opened.load()
    case["semi_axis_a_m"], case["semi_axis_b_m"], case["hertz_pressure_pa"] = a, a, hertz
    case = case.drop_vars("mean_shear_stress_pa")
    case.to_netcdf(tmp_path / "smooth.h5", engine="h5netcdf")
    options = {"form": "none", "ends": "none", "depths_m": np.array([0.1, 0.3, 0.5]) * a}
    closed = contact().stress(rough(), **options).bodies[0]
    solved = contact().stress(rough(), smooth=tmp_path / "smooth.h5", **options).bodies[0]
    assert solved.dang_van == pytest.approx(closed.dang_van, rel=5e-3)
    assert solved.dang_van != closed.dang_van
    assert solved.ripple_shear == closed.ripple_shear
    with pytest.raises(StressError, match="no lengths"):
        contact().stress(
            rough(), smooth=case.drop_vars(["semi_axis_a_m", "semi_axis_b_m"]), **options
        )


def test_a_file_without_fields_over_time_is_refused(tmp_path: Path) -> None:
    with pytest.raises(StressError, match="fields_every"):
        line_stress_over_time(case_file(tmp_path), 0.0)
    with pytest.raises(StressError, match="body = 3"):
        stress_of_case(case_file(tmp_path), 0.0, body=3)


def test_command_of_a_file(tmp_path: Path, capsys: Capture) -> None:
    path = case_file(tmp_path, times=60, cells=64)
    assert main(["stress", str(path), "--output", str(tmp_path / "out")]) == 0
    text = capsys.readouterr().out
    assert "Second body, S = 0.8" in text
    assert "e-0" not in text  # rounding of y = 0 gives 0
    assert "Dang Van's factor" in text
    names = {"stress.json", "stress.h5", "section.png", "section.pdf"}
    assert {one.name for one in (tmp_path / "out").glob("[!.]*")} == names
    with xr.open_dataset(tmp_path / "out" / "stress.h5", engine="h5netcdf") as data:
        assert data["sxx"].dims == ("z", "x", "y")
    assert main(["stress", str(path), "--json", "--depths", "40", "96", "160"]) == 0
    document = json.loads(capsys.readouterr().out)
    peak = document["bodies"][0]["peaks"]["von_mises"]
    assert peak["value"] == pytest.approx(0.62 * PH, rel=0.02)
    assert document["bodies"][0]["dang_van"] > document["bodies"][0]["dang_van_smooth"]


def test_command_of_a_surface(tmp_path: Path, capsys: Capture) -> None:
    surface = rough()
    table = np.column_stack((np.arange(256) * 3, surface.height[:, 0] * 1e6))
    np.savetxt(tmp_path / "t.csv", table, delimiter=",", header="x_um,z_um", comments="")
    words = [f"{key}={value}" for key, value in KEYS.items()]
    command = ["stress", str(tmp_path / "t.csv"), "--conditions", *words, "slip_parameter=1.2"]
    output = tmp_path / "new" / "out"
    assert main([*command, "--form", "none", "--ends", "none", "--output", str(output)]) == 0
    figures = {
        f"{n}.{kind}" for n in ("section", "depth", "ripple", "remove") for kind in ("png", "pdf")
    }
    assert {one.name for one in output.glob("[!.]*")} == figures | {"stress.json", "stress.h5"}
    document = json.loads((output / "stress.json").read_text())
    direct = contact(1.2).stress(surface, form="none", ends="none")
    assert document["bodies"][0]["dang_van"] == pytest.approx(direct.bodies[0].dang_van, rel=1e-3)
    assert "Second body, smooth" in capsys.readouterr().out
    assert main([*command, "--json", "--second", str(tmp_path / "t.csv"), "--cycles", "1e5"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["bodies"][1]["is_rough"]


def test_bad_input_of_the_command(tmp_path: Path, capsys: Capture) -> None:
    text = tmp_path / "t.csv"
    text.write_text("0,1\n1,2\n")
    for path, part in ((text, "--conditions"), (tmp_path / "none.h5", "no such file")):
        assert main(["stress", str(path)]) == 2
        assert part in capsys.readouterr().err
    case = str(case_file(tmp_path))
    for words in (["--friction", "0.1"], ["--second", str(text)], ["--rolling-axis", "y"]):
        assert main(["stress", case, *words]) == 2
        assert f"{words[0]} is for a measured surface" in capsys.readouterr().err
    assert main(["stress", case, "--cycles", "1e5"]) == 0
    assert "not known, cycles have no effect: it needs fields over time" in capsys.readouterr().out
    words = [f"{key}={value}" for key, value in KEYS.items()]
    assert main(["stress", str(text), "--conditions", *words, "--body", "2"]) == 2
    assert "--body is for a file of ehlwave-case" in capsys.readouterr().err


@pytest.mark.parametrize("share", [0.3, 1.0])
def test_solids_bear_and_rub_like_the_oil(tmp_path: Path, share: float) -> None:
    """Oil and solids with equal friction: stresses do not depend on the share of the solids."""
    oil = read_case(case_file(tmp_path))
    text = oil.attrs["effective_input"] + "\n&touching\n  solid_friction = 0.05\n/"
    both = oil.assign(
        pressure=(1 - share) * oil["pressure"],
        contact_pressure=share * oil["pressure"],
        mean_shear_stress_pa=(1 - share) * oil["mean_shear_stress_pa"],
    ).assign_attrs(effective_input=text)
    depths = [0.1 * A, 0.5 * A]
    for body in (1, 2):
        expected, found = (stress_of_case(case, depths, body) for case in (oil, both))
        for name in COMPONENTS:
            np.testing.assert_allclose(found[name], expected[name], rtol=1e-9, atol=1e-6 * PH)
    frictionless = both.assign_attrs(effective_input=text.replace("0.05", "0"))
    change = stress_of_case(frictionless, depths)["sxz"] - stress_of_case(oil, depths)["sxz"]
    assert abs(change).max() > 0.01 * share * PH


def test_pressure_of_solids_is_drawn(tmp_path: Path) -> None:
    """Where surfaces touch, figures show the pressure of oil and solids, and the touching area."""
    oil = read_case(case_file(tmp_path)).assign(minimum_film=0.1)
    solids = xr.where(oil["x"] > 0.5, oil["pressure"], 0.0)
    both = oil.assign(pressure=oil["pressure"] - solids, contact_pressure=solids)
    for draw in (case_figure, contact_figure):
        figures = draw(oil), draw(both)
        curves = [
            [line.get_ydata() for axes in figure.axes for line in axes.lines] for figure in figures
        ]
        for first, second in zip(*curves, strict=True):
            np.testing.assert_allclose(first, second, atol=1e-12)
    counts = [
        [len(axes.collections) for axes in case_figure(case).axes if axes.get_title()]
        for case in (oil, both)
    ]
    assert sum(counts[1]) > sum(counts[0])
    legends = [axes.get_legend() for axes in case_figure(both).axes]
    assert any(legend and legend.get_texts()[0].get_text() == "solids" for legend in legends)
