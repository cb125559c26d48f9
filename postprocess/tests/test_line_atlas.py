"""Line contacts: their scales, their atlas, and refusals."""

from pathlib import Path

import numpy as np
import pytest

import ehlwave
from ehlwave.cli import main
from ehlwave.laws.atlas.atlas import load_atlas, shipped
from ehlwave.laws.atlas.kinds import LINE
from ehlwave.surface import map_surface, trace_surface
from studies.atlas.design import contact_at, uncertain_contacts
from studies.atlas.line_design import CONTACTS, case, domain, write_batch

MOES = {"load_parameter_m": 100, "lubricant_parameter_l": 11, "radius_ratio_d": 0}
LIGHT = {"load_parameter_m": 1, "lubricant_parameter_l": 12, "radius_ratio_d": 0}
ROLLER = {
    "radius_x_m": 5e-3,
    "reduced_modulus_pa": 2.26e11,
    "load_n_per_m": 1.5e5,
    "mean_speed_m_per_s": 2,
    "viscosity_pa_s": 0.03,
    "pressure_viscosity_per_pa": 2e-8,
    "roelands_index": 0.6,
}
HEIGHT = 1e-8 * np.cos(2 * np.pi * np.arange(200) / 20)


def test_scales_and_films_are_those_of_the_program() -> None:
    contact = ehlwave.Contact(**ROLLER)
    c, film = contact.conditions, contact.film()
    found = c.m, c.l, c.alphabar, c.lambdabar, c.gamma, c.v_per_wavelength * c.semi_axis_a_m
    computed = 12.88135, 14.50989, 20.775664, 0.089221224, 3.5890599, 1.78500318
    np.testing.assert_allclose(found, computed, rtol=1e-6)
    lengths = c.semi_axis_a_m, c.hertz_approach_c_m
    np.testing.assert_allclose(lengths, (0.091928e-3, 0.84507e-6), rtol=1e-4)
    assert film.central_m == pytest.approx(0.29034e-6, rel=film.central_error)
    assert film.minimum_m == pytest.approx(0.25418e-6, rel=film.minimum_error)
    assert film.central_error < 0.03
    slides = ehlwave.Contact(**ROLLER, slip_parameter=1.2)  # Newtonian: the film is the same
    assert slides.film().central_m == film.central_m


@pytest.mark.parametrize(
    ("keys", "wave", "film", "pressure"),
    [
        (MOES, 0.25, 0.60076 + 0.31211j, -5.0009 + 3.9169j),
        (MOES, 2.0, 0.05514 + 0.04458j, -1.5754 + 0.0744j),
        (ROLLER, 0.5, 0.94933 + 0.18386j, -0.3056 + 1.1702j),
        (LIGHT, 3.0, 1.09619 - 0.06038j, None),
        (
            LIGHT | {"load_parameter_m": 2, "lubricant_parameter_l": 20},
            2.0,
            1.02574 + 0.13245j,
            None,
        ),
    ],
)
def test_a_response_is_that_of_the_program(
    keys: dict[str, float], wave: float, film: complex, pressure: complex | None
) -> None:
    # ehlwave-case, 2048 to 8192 cells, flooded edges, extrapolated to mesh size 0
    found = ehlwave.Contact(**keys).response(wave)
    assert abs(found.film - film) < found.error < 0.03
    if pressure is not None:
        assert abs(found.pressure - pressure) < 0.2


def test_a_trace_is_deformed_by_its_responses_on_the_command_line_too(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    contact = ehlwave.Contact(**ROLLER)
    step = contact.conditions.semi_axis_a_m / 40
    surface = trace_surface(HEIGHT, step, "x", "cosine")
    found = contact.deform(surface, form="none", ends="none")
    response = contact.response(0.5).film
    rolled = np.exp(2j * np.pi * np.arange(200) / 20)
    np.testing.assert_allclose(found.height[:, 0], 1e-8 * np.real(response * rolled), atol=2e-11)
    assert found.statistics.mean_rise_m is not None
    table = np.column_stack((np.arange(200) * step, HEIGHT))
    np.savetxt(tmp_path / "t.csv", table, delimiter=",", header="x_m,z_m", comments="")
    command = ["deform", str(tmp_path / "t.csv"), "--form", "none", "--ends", "none"]
    assert main([*command, "--conditions", *(f"{k}={v}" for k, v in ROLLER.items())]) == 0
    said = capsys.readouterr().out
    assert f"{found.statistics.lambda_ratio_after:.4g} with the deformed one" in said
    assert "line contact" in said


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"angle_deg": 30}, "slender elliptical contact"),
        ({"slip_parameter": 1.8}, "slip_parameter = 1.8 .* 0.3 to 1.7"),
        ({"wavelength_over_a": 5}, "0.1 to 4"),
    ],
)
def test_waves_that_are_not_covered_are_refused(asked: dict[str, float], said: str) -> None:
    with pytest.raises(ehlwave.RangeError, match=said):
        ehlwave.Contact(**ROLLER).response(**{"wavelength_over_a": 1, **asked})


def test_surfaces_and_contacts_that_are_not_covered_are_refused() -> None:
    contact, sliding = ehlwave.Contact(**ROLLER), ehlwave.Contact(**ROLLER, slip_parameter=1.2)
    carreau = {"carreau_modulus_pa": 5e6, "carreau_exponent": 0.5, "slip_parameter": 1.2}
    thinned = ehlwave.Contact(**ROLLER, **carreau)
    trace = trace_surface(HEIGHT, 2e-6, "x")
    across = trace_surface(HEIGHT, 2e-6, "y")
    for surface in (across, map_surface(np.outer(HEIGHT, np.ones(40)), 2e-6, 2e-6)):
        for by in ("atlas", "paper"):
            with pytest.raises(ehlwave.SurfaceError, match="transverse waves alone"):
                contact.deform(surface, by=by)
    for slides, by in ((thinned, "atlas"), (thinned, "two-waves"), (sliding, "two-waves")):
        refused = ehlwave.SurfaceError, ehlwave.RangeError
        with pytest.raises(refused, match="Newtonian or Ree-Eyring oil alone"):
            slides.deform(trace, by=by)
    with pytest.raises(ehlwave.RangeError, match="Newtonian or Ree-Eyring oil alone"):
        thinned.film()
    with pytest.raises(ehlwave.RangeError, match=r"load_parameter_m = 0\.01 "):
        ehlwave.Contact(**{**MOES, "load_parameter_m": 0.01}).film()
    heavy = {**MOES, "load_parameter_m": 1900, "lubricant_parameter_l": 30}
    with pytest.raises(ehlwave.RangeError, match=r"alpha ph of 522 \(of at most 500\)"):
        ehlwave.Contact(**heavy).film()
    with pytest.raises(ehlwave.SurfaceError, match="load_n_per_m, of a line contact, and load_n"):
        ehlwave.Contact(**ROLLER, load_n=10)


def test_the_sweep_of_a_batch_fills_the_ranges_and_resolves_the_inlet(tmp_path: Path) -> None:
    table = write_batch(tmp_path, 1).with_suffix(".csv")
    rows = np.genfromtxt(table, names=True, delimiter=",")
    loads, waves = rows["load_parameter_m"], rows["wavelength_x_over_a"]
    assert loads.max() / loads.min() > 100
    assert waves.min() < 0.12
    assert waves.max() > 2
    light, heavy = (
        case({"load_parameter_m": m, "lubricant_parameter_l": 2.0}, 1.0) for m in (6.0, 1500.0)
    )
    assert light["x_min"] < heavy["x_min"]
    assert heavy["cells_x"] == 8192


def test_thick_films_have_larger_domains_with_meshes_as_fine() -> None:
    light = case({"load_parameter_m": 1.0, "lubricant_parameter_l": 12.0}, 1.0)
    assert (light["x_min"], light["x_max"], light["cells_x"]) == (-26, 6, 4096)
    for m, begins in ((0.4, -26), (3, -13), (20, -6.5), (100, -2.5)):
        assert domain(m, 12.0)[0] == begins


def test_later_batches_go_where_the_atlas_knows_least(tmp_path: Path) -> None:
    atlas = load_atlas(shipped(LINE))

    def bar(contacts: list[dict[str, float]]) -> float:
        return float(np.mean([atlas.at(one).responses([0.3, 1.0], 0.0).error for one in contacts]))

    shares = np.random.default_rng(1).random((48, 4)).tolist()
    anywhere = [contact_at(one, LINE.ranges) for one in shares]
    assert bar(uncertain_contacts(atlas, 3, 16, 64)) > 1.3 * bar(anywhere)
    table = np.genfromtxt(
        write_batch(tmp_path, 24, atlas).with_suffix(".csv"), names=True, delimiter=","
    )
    assert len(np.unique(table["load_parameter_m"])) == CONTACTS
