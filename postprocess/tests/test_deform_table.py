import itertools
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from contact import EXPERIMENT, experiment
from synthetic import make_columns, write_results

import ehlwave
from ehlwave.cli import main
from ehlwave.contact.formula import amplitude_ratio_formula, f_of_r
from ehlwave.errors import SurfaceError
from ehlwave.results.points import select_points
from ehlwave.results.read import read_results
from ehlwave.surface import (
    Conditions,
    FormulaTransfer,
    TableTransfer,
    deform_surface,
    harmonic_table,
    map_surface,
    read_coefficients,
    read_table,
    trace_surface,
)
from ehlwave.surface.amplitude import lowest_film
from ehlwave.surface.report import report_text

CONTACT = experiment(radius_y_m=0.05)
WAVES = np.geomspace(0.05, 3, 25)
ORIENTATIONS = (0.0, 0.5, 1.0, 2.0, np.inf)


def table(phase: float = 0.0, ratios: tuple[float, ...] = ORIENTATIONS) -> pd.DataFrame:
    """Return a table of formula (18), with a phase in proportion to 1/lambda_x."""
    rows = []
    for r in ratios:
        for wave in WAVES:
            wave_x = wave if r <= 1 else wave * r
            wave_y = np.inf if r == 0 else wave_x / r if np.isfinite(r) else wave
            f_v = f_of_r(r) * wave * CONTACT.v_per_wavelength * CONTACT.semi_axis_a_m
            value = amplitude_ratio_formula(f_v) * np.exp(1j * phase / wave_x)
            rows.append(
                {
                    "M": CONTACT.m,
                    "L": CONTACT.l,
                    "D": CONTACT.d,
                    "lambda_x_over_a": wave_x if np.isfinite(wave_x) else 0,
                    "lambda_y_over_b": wave_y * CONTACT.kappa if np.isfinite(wave_y) else 0,
                    "transfer_real": value.real,
                    "transfer_imag": value.imag,
                }
            )
    return pd.DataFrame(rows)


def read(tmp_path: Path, rows: pd.DataFrame) -> pd.DataFrame:
    rows.to_csv(tmp_path / "table.csv", index=False)
    return read_table(tmp_path / "table.csv")


def test_a_table_of_the_formula_gives_the_formula(tmp_path: Path) -> None:
    transfer = TableTransfer(CONTACT, read(tmp_path, table()))
    exact = FormulaTransfer(CONTACT)
    a = CONTACT.semi_axis_a_m
    angle = np.linspace(-np.pi / 2, np.pi / 2, 41)[:, None]
    wave = np.geomspace(0.1, 1.2, 30)[None, :] * a
    qx, qy = np.cos(angle) / wave, np.sin(angle) / wave
    assert transfer.is_covered(qx, qy).all()
    np.testing.assert_allclose(transfer.ratio(qx, qy), exact.ratio(qx, qy), rtol=0, atol=2e-4)


def test_a_table_answers_at_every_door_with_its_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "table.csv"
    table().assign(transfer_error=0.01).to_csv(path, index=False)
    keys = EXPERIMENT | {"radius_y_m": 0.05}
    contact = ehlwave.Contact(**keys, table=path)
    response = contact.response(0.3)
    f_v = 0.3 * CONTACT.v_per_wavelength * CONTACT.semi_axis_a_m
    assert response.film.real == pytest.approx(amplitude_ratio_formula(f_v), abs=2e-4)
    assert 0.01 <= response.error < 0.012  # the waves, and the interpolation between them
    assert contact.responses([0.3, 0.5], [0, 45])["film_error"].max() < 0.03
    x = np.arange(600) * 1e-6
    trace = trace_surface(20e-9 * np.cos(2 * np.pi * x / 60e-6), 1e-6, "x", "waves")
    found = contact.deform(trace)
    assert found.transfer_name.startswith("harmonic table table.csv")
    assert 0.005 < found.error_m / found.statistics.rq_before_m < 0.015
    assert contact.stress(trace).surfaces[0].transfer_name == found.transfer_name
    np.savetxt(tmp_path / "t.csv", np.column_stack([x, trace.height[:, 0]]), delimiter=",")
    words = [f"{key}={value}" for key, value in keys.items()]
    words = [str(tmp_path / "t.csv"), "--conditions", *words, "--table", str(path), "--json"]
    for command in ("lambda", "stress"):
        assert main([command, *words, "--length-unit", "m", "--height-unit", "m"]) == 0
        assert "harmonic table table.csv" in capsys.readouterr().out
    pytest.importorskip("panel")
    from ehlwave.app.contacts import Given
    from ehlwave.app.task import Task, answered
    from ehlwave.app.uploads import Upload

    upload = Upload("table.csv", path.read_bytes())
    surface = Upload("t.csv", (tmp_path / "t.csv").read_bytes())
    reading = {"length_unit": "m", "height_unit": "m"}
    page = answered(Task(Given(keys), surface, reading, {}, upload))
    assert page.found is not None
    ratios = [one.statistics.lambda_ratio_after for one in (page.found, found)]
    assert ratios[0] == pytest.approx(ratios[1], rel=1e-6)
    without = path.with_name("without.csv")
    table().to_csv(without, index=False)
    assert np.isnan(ehlwave.Contact(**keys, table=without).response(0.3).error)
    with pytest.raises(ehlwave.RangeError, match="there is no harmonic table"):
        ehlwave.Contact(**keys).response(0.3, by="table")


def test_r_and_amplitude_columns_mean_the_same(tmp_path: Path) -> None:
    full = table()
    short = full[["M", "L", "D"]].copy()
    short["amplitude_ratio"] = full["transfer_real"]
    short["r"] = np.repeat(ORIENTATIONS, WAVES.size)
    short["lambda_over_a"] = np.tile(WAVES, len(ORIENTATIONS))
    one, two = (
        TableTransfer(CONTACT, read(tmp_path, full)),
        TableTransfer(CONTACT, read(tmp_path, short)),
    )
    q = np.array([3e3, 2e4, 6e4])
    np.testing.assert_allclose(
        one.ratio(q[:, None], q[None, :]), two.ratio(q[:, None], q[None, :]), atol=1e-9
    )


def test_phase_shifts_the_profile_and_leaves_it_real(tmp_path: Path) -> None:
    # exp(i phase a/lambda) is a shift by phase/(2 pi) a against the motion
    shift = 0.04
    transfer = TableTransfer(CONTACT, read(tmp_path, table(phase=2 * np.pi * shift)))
    wave, points = 0.3 * CONTACT.semi_axis_a_m, 256
    x = np.arange(points) * 8 * wave / points
    surface = trace_surface(1e-8 * np.cos(2 * np.pi * x / wave), x[1])
    result = deform_surface(surface, CONTACT, transfer, form="none", window="none")
    ratio = amplitude_ratio_formula(wave * CONTACT.v_per_wavelength)
    expected = 1e-8 * ratio * np.cos(2 * np.pi * (x + shift * CONTACT.semi_axis_a_m) / wave)
    np.testing.assert_allclose(result.height[:, 0], expected, rtol=0, atol=3e-3 * 1e-8)


@pytest.mark.parametrize("shape", [(48, 40), (47, 40), (48, 41)])
def test_maps_stay_real_and_keep_parseval_with_phases(
    tmp_path: Path, shape: tuple[int, int]
) -> None:
    transfer = TableTransfer(CONTACT, read(tmp_path, table(phase=0.4)))
    heights = 1e-8 * np.random.default_rng(5).standard_normal(shape)
    surface = map_surface(heights, 8e-6, 9e-6)
    result = deform_surface(surface, CONTACT, transfer, form="mean", window="none")
    slope_free = np.abs(np.fft.fft2(result.height)) ** 2 / heights.size**2
    inside = result.spectra["x"].after[:-1].sum() + result.spectra["x"].after[-1]
    # the shortest wave along x loses its imaginary part: a sampled wave cannot hold it
    loss = result.spectra["x"].after[-1] if shape[0] % 2 == 0 else 0.0
    assert slope_free.sum() <= inside * (1 + 1e-12)
    assert slope_free.sum() >= (inside - loss) * (1 - 1e-12)
    # the mirror image in y of the surface gives the mirror image of the result
    turned = map_surface(heights[:, ::-1], 8e-6, 9e-6)
    again = deform_surface(turned, CONTACT, transfer, form="mean", window="none")
    np.testing.assert_allclose(again.height[:, ::-1], result.height, rtol=0, atol=1e-20)


def test_waves_raise_the_mean_film_by_their_squares(tmp_path: Path) -> None:
    # a rise linear in log(wave) is interpolated without error
    rows = table()
    wave = np.where(rows["lambda_x_over_a"] > 0, rows["lambda_x_over_a"], 1.0)
    rows["mean_rise"] = 0.2 - 0.05 * np.log(wave)
    film, a = CONTACT.central_film_m, CONTACT.semi_axis_a_m
    transfer = TableTransfer(CONTACT, read(tmp_path, rows))
    points, period = 512, 4 * a
    x = np.arange(points) * period / points
    heights = 3e-8 * np.cos(16 * np.pi * x / period) + 2e-8 * np.sin(32 * np.pi * x / period)
    surface = trace_surface(heights + 7e-9, period / points)
    expected = sum(
        (0.2 - 0.05 * np.log(period / a / waves)) * amplitude**2 / film
        for waves, amplitude in ((8, 3e-8), (16, 2e-8))
    )
    for form, window in (("none", "none"), ("mean", "mirror")):
        result = deform_surface(surface, CONTACT, transfer, form, window)
        found = result.statistics
        assert found.mean_rise_m == pytest.approx(expected, rel=5e-3)
        assert found.mean_film_m == pytest.approx(film + expected, rel=1e-4)
        linear = (found.mean_film_m - result.height.max()) / film
        assert found.minimum_film_m == pytest.approx(film * lowest_film(linear))
        assert f"{1e6 * found.mean_rise_m:.3g} um of it by the roughness" in report_text(result)
    # twice the roughness, four times the rise; long waves raise nothing, as they leave nothing
    again = deform_surface(replace(surface, height=2 * surface.height), CONTACT, transfer, "none")
    once = deform_surface(surface, CONTACT, transfer, "none")
    assert again.statistics.mean_rise_m == pytest.approx(4 * once.statistics.mean_rise_m)
    assert transfer.rise(np.zeros(1), np.zeros(1)) == [0]
    assert 0 < transfer.rise(np.array([0.01 / a]), np.zeros(1))[0] < 1e-3


def test_the_rise_is_unknown_where_a_wave_has_none(tmp_path: Path) -> None:
    rows = table().assign(mean_rise=0.1)
    rows.loc[3, "mean_rise"] = np.nan
    for source in (rows, table()):
        transfer = TableTransfer(CONTACT, read(tmp_path, source))
        surface = trace_surface(3e-8 * np.cos(np.arange(512) / 8), 4e-6)
        found = deform_surface(surface, CONTACT, transfer, "none", "none")
        assert found.statistics.mean_rise_m is None
        assert found.statistics.mean_film_m == CONTACT.central_film_m
        assert "its rise by the roughness is not known" in report_text(found)


def test_what_lies_outside_is_continued_and_named(tmp_path: Path) -> None:
    rows = table()
    middle = rows["lambda_x_over_a"].between(0.2, 1) & (rows["lambda_y_over_b"] == 0)
    transfer = TableTransfer(CONTACT, read(tmp_path, rows[middle]), "t.csv")
    a = CONTACT.semi_axis_a_m
    waves = np.array([0.1, 0.5, 1.9, 20.0]) * a
    assert transfer.is_covered(1 / waves, np.zeros(4)).tolist() == [False, True, False, False]
    exact = FormulaTransfer(CONTACT)
    q = 1 / waves[2:]
    np.testing.assert_allclose(transfer.ratio(q, 0 * q), exact.ratio(q, 0 * q), rtol=1e-2)
    assert transfer.ratio(np.zeros(1), np.zeros(1))[0] == 0
    phase = 2 * np.pi * np.arange(256) / 256
    surface = trace_surface(1e-8 * np.cos(phase) + 2e-8 * np.cos(4 * phase), 1.9 * a / 256)
    (group,) = deform_surface(surface, CONTACT, transfer, form="none", window="none").unjudged
    assert "outside the wavelengths and orientations of t.csv" in group.reason
    assert group.share_before == pytest.approx(0.2, rel=1e-9)


def test_tables_of_other_conditions_and_bad_tables_are_refused(tmp_path: Path) -> None:
    rows = read(tmp_path, table())
    with pytest.raises(SurfaceError, match=r"M = 205.* does not lie among its 1 condition"):
        TableTransfer(experiment(radius_y_m=0.05, load_n=60), rows)
    with pytest.raises(SurfaceError, match=r"S = 1.2: its slip parameters are 1"):
        TableTransfer(experiment(radius_y_m=0.05, slip_parameter=1.2), rows)
    with pytest.raises(SurfaceError, match="two or more wavelengths"):
        TableTransfer(CONTACT, rows.iloc[:1])
    with pytest.raises(SurfaceError, match="needs the column lambda_y_over_b"):
        read(tmp_path, table().drop(columns="lambda_y_over_b"))
    with pytest.raises(SurfaceError, match="needs the column amplitude_ratio"):
        read(tmp_path, table().drop(columns="transfer_real"))
    with pytest.raises(SurfaceError, match="does not hold numbers"):
        read(tmp_path, table().assign(M="many"))
    with pytest.raises(SurfaceError, match="no such file"):
        read_table(tmp_path / "absent.csv")


def of_contact(contact: Conditions, change: float = 0.0) -> pd.DataFrame:
    """Return the table of the formula for another contact, c1 changed."""
    rows = []
    for wave in WAVES:
        f_v = wave * contact.v_per_wavelength * contact.semi_axis_a_m
        value = amplitude_ratio_formula(f_v, 0.15 + change)
        keys = {"M": contact.m, "L": contact.l, "D": contact.d, "r": 0.0, "lambda_over_a": wave}
        rows.append(keys | {"amplitude_ratio": value})
    return pd.DataFrame(rows)


@pytest.mark.parametrize(
    "names", [["mean_speed_m_per_s"], ["mean_speed_m_per_s", "load_n", "radius_y_m"]]
)
def test_conditions_are_interpolated_on_v(tmp_path: Path, names: list[str]) -> None:
    keys = {"mean_speed_m_per_s": (0.02, 0.05), "load_n": (30, 60), "radius_y_m": (0.03, 0.1)}
    corners = itertools.product(*(keys[name] for name in names))
    changes = [dict(zip(names, corner, strict=True)) for corner in corners]
    tables = [of_contact(experiment(**{"radius_y_m": 0.05} | change)) for change in changes]
    rows = read(tmp_path, pd.concat(tables))
    between = experiment(
        radius_y_m=0.05, mean_speed_m_per_s=0.03, load_n=40 if "load_n" in names else 39.2
    )
    transfer = TableTransfer(between, rows)
    q = 1 / (np.geomspace(0.2, 1.2, 9) * between.semi_axis_a_m)
    # Transfers that depend on f(r) V alone are exact, at every condition
    exact = FormulaTransfer(between).ratio(q, 0 * q)
    np.testing.assert_allclose(transfer.ratio(q, 0 * q), exact, rtol=0, atol=2e-4)
    with pytest.raises(SurfaceError, match="does not lie among its"):
        TableTransfer(experiment(radius_y_m=0.05, mean_speed_m_per_s=0.2), rows)


def test_what_differs_between_conditions_is_weighted(tmp_path: Path) -> None:
    slow, fast = (experiment(mean_speed_m_per_s=speed) for speed in (0.02, 0.08))
    rows = read(tmp_path, pd.concat([of_contact(slow, -0.05), of_contact(fast, 0.05)]))
    middle = experiment(mean_speed_m_per_s=0.04)  # halfway in every logarithm
    wave = 0.5 * middle.semi_axis_a_m
    f_v = wave * middle.v_per_wavelength
    expected = (amplitude_ratio_formula(f_v, 0.1) + amplitude_ratio_formula(f_v, 0.2)) / 2
    found = TableTransfer(middle, rows).ratio(np.array([1 / wave]), np.zeros(1))
    assert found[0].real == pytest.approx(float(expected), abs=2e-4)


def test_hdf5_tables_are_read(tmp_path: Path) -> None:
    rows = table()
    rows.to_xarray().to_netcdf(tmp_path / "table.h5", engine="h5netcdf")
    pd.testing.assert_frame_equal(read_table(tmp_path / "table.h5"), read(tmp_path, rows))


def test_sweeps_become_tables(tmp_path: Path) -> None:
    columns = make_columns()
    source = write_results(tmp_path / "r.h5", columns)
    assert main(["harmonics", str(source), "--csv", str(tmp_path / "h.csv")]) == 0
    rows = read_table(tmp_path / "h.csv")
    assert len(rows) == len(columns["f_r"])
    # every orientation of the paper is there, and the transfer is the ratio of the sweep
    assert sorted(set(np.round(rows["angle"], 6))) == pytest.approx(
        [0, np.pi / 4, np.pi / 2], abs=1e-6
    )
    ratios = np.sort(columns["amplitude_ratio_fit"])
    np.testing.assert_allclose(np.sort(rows["transfer_real"]), ratios, rtol=1e-9)


def test_linear_responses_and_phases_of_a_sweep_are_used(results_file: Path) -> None:
    points = select_points(read_results([results_file]))
    ratio = points["deformed_ratio"]
    plain = harmonic_table(points)
    assert (plain["transfer_imag"] == 0).all()
    phased = harmonic_table(points.assign(phase_fit=0 * ratio + 0.3))
    np.testing.assert_allclose(phased["transfer_imag"], plain["transfer_real"] * np.sin(0.3))
    real = ratio.where(points["load_parameter_m"] > points["load_parameter_m"].min())
    linear = harmonic_table(points.assign(harmonic_real=0.5 * real, harmonic_imaginary=0.1 * real))
    low = linear["M"] == linear["M"].min()
    np.testing.assert_allclose(linear["transfer_real"][low], plain["transfer_real"][low])
    np.testing.assert_allclose(linear["transfer_imag"][~low], 0.1 * plain["transfer_real"][~low])


def test_only_single_waves_have_a_rise(results_file: Path) -> None:
    points = select_points(read_results([results_file]))
    rise = 0.02 + 0 * points["deformed_ratio"]
    plain = harmonic_table(points.assign(mean_film_rise=rise))
    is_product = (plain["lambda_x_over_a"] > 0) & (plain["lambda_y_over_b"] > 0)
    assert is_product.any()
    assert plain["mean_rise"][is_product].isna().all()
    # 0.02 Ai at Ai = 0.2 of the film
    np.testing.assert_allclose(plain["mean_rise"][~is_product], 0.1)
    oblique = harmonic_table(points.assign(mean_film_rise=rise, oblique=1 + 0 * rise))
    np.testing.assert_allclose(oblique["mean_rise"], 0.1)


def test_coefficients_are_read_from_what_refit_writes(tmp_path: Path, results_file: Path) -> None:
    arguments = ["refit", str(results_file), "--output", str(tmp_path), "--replicates", "20"]
    assert main(arguments) == 0
    for name in ("refit.csv", "refit.json"):
        assert read_coefficients(tmp_path / name) == pytest.approx((0.2, 0.03), rel=1e-6)
    with pytest.raises(SurfaceError, match="no group 'round'"):
        read_coefficients(tmp_path / "refit.csv", "round")
    (tmp_path / "bad.csv").write_text("a,b\n1,2\n")
    with pytest.raises(SurfaceError, match="not a file of ehlwave refit"):
        read_coefficients(tmp_path / "bad.csv")
