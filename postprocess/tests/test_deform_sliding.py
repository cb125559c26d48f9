"""Surfaces under slip: the law as a transfer, the film at any place, two rough surfaces."""

import json
from pathlib import Path

import numpy as np
import pytest

from ehlwave.cli import main
from ehlwave.contact.rolling import rolling_transfer
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.laws.atlas_transfer import AtlasTransfer
from ehlwave.surface import (
    Conditions,
    Mover,
    Surface,
    TwoWaveTransfer,
    conditions_from_keys,
    deform_surface,
    film_of_two,
    film_profile,
    map_surface,
    read_conditions,
    second_conditions,
    trace_surface,
)
from studies.two_waves.shapes import CONTACT, STRESS_PA

KEYS = CONTACT | {"eyring_stress_pa": STRESS_PA}


def conditions(slip: float) -> Conditions:
    return conditions_from_keys(KEYS | {"slip_parameter": slip})


def rough_trace(seed: int = 1) -> Surface:
    heights = np.random.default_rng(seed).normal(size=384)
    smooth = np.fft.irfft(np.fft.rfft(heights)[:60], heights.size)
    return trace_surface(1e-8 * smooth, 2e-6, name=f"trace {seed}")


def rough_map() -> Surface:
    heights = np.random.default_rng(3).normal(size=(96, 33))
    spectrum = np.fft.fft2(heights)
    spectrum[16:-15], spectrum[:, 7:-6] = 0, 0
    return map_surface(1e-8 * np.fft.ifft2(spectrum).real, 4e-6, 6e-6, "map")


def test_without_slip_it_is_the_rolling_transfer() -> None:
    contact = conditions(1.0)
    transfer = TwoWaveTransfer(contact)
    a_m = contact.semi_axis_a_m
    along, across = np.array([2.0, -2.0, 0.0, 0.0]) / a_m, np.array([1.0, 1.0, 1.0, 0.0]) / a_m
    ratio = transfer.ratio(along, across)
    rolled = rolling_transfer(contact.m, contact.l, contact.gamma, [0.5, 0.0], 1.0)
    np.testing.assert_allclose(ratio[[0, 2]], rolled, atol=1e-12)
    assert ratio[1] == np.conj(ratio[0])
    assert ratio[3] == 0
    assert transfer.covers_all


@pytest.mark.parametrize("surface", [rough_trace(), rough_map()], ids=["trace", "map"])
@pytest.mark.parametrize("slip", [1.3, 0.7])
def test_profile_at_the_centre_is_the_deformed_surface(surface: Surface, slip: float) -> None:
    transfer = TwoWaveTransfer(conditions(slip))
    result = deform_surface(surface, conditions(slip), transfer, "none", "none")
    middle = result.height.shape[1] // 2
    film = conditions(slip).central_film_m
    assert film is not None
    for index in (0, 17, 60):
        mover = Mover(surface, transfer, index * surface.step_x_m)
        profile = film_profile([mover], [0.0], 0.0)
        assert profile[0] == pytest.approx(film - result.height[index, middle], abs=2e-14)


def test_both_waves_move_on() -> None:
    """The film at X = x after some rolling: phases of surface and oil, here a single harmonic."""
    slip, waves, count = 1.3, 8, 256
    contact = conditions(slip)
    a_m = contact.semi_axis_a_m
    step = waves * 0.5 * a_m / count
    x = np.arange(count) * step
    surface = trace_surface(1e-9 * np.cos(2 * np.pi * x / (0.5 * a_m)), step)
    transfer = TwoWaveTransfer(contact)
    both = transfer.waves(np.array([2 / a_m]), np.zeros(1))
    rolled, place = 0.37 * a_m, 0.21
    phase = np.exp(-1j * both.wave_number[0] * slip * 0.37)
    own = both.attenuated[0] * np.exp(1j * both.wave_number[0] * place)
    carried = both.complementary[0] * np.exp(1j * both.psi[0] * place)
    profile = film_profile([Mover(surface, transfer)], [place * a_m], rolled)
    assert contact.central_film_m is not None
    change = -1e-9 * ((own + carried) * phase).real
    assert profile[0] - contact.central_film_m == pytest.approx(change, abs=1e-15)


def test_two_surfaces_add_up() -> None:
    first, second = conditions(1.3), second_conditions(conditions(1.3))
    assert second.slip_parameter == pytest.approx(0.7)
    surfaces = rough_trace(1), rough_trace(2)
    movers = [
        Mover(surface, TwoWaveTransfer(contact))
        for surface, contact in zip(surfaces, (first, second), strict=True)
    ]
    place = np.linspace(-0.5, 0.5, 9) * first.semi_axis_a_m
    both = film_profile(movers, place, 3e-5)
    each = [film_profile([mover], place, 3e-5) - first.central_film_m for mover in movers]
    np.testing.assert_allclose(both - first.central_film_m, sum(each), atol=1e-16)

    results = [
        deform_surface(mover.surface, mover.transfer.conditions, mover.transfer, "none", "none")
        for mover in movers
    ]
    passing = film_of_two(*results)
    at = 40
    rolled = passing.rolled_m[at]
    length = 383 * 2e-6
    heights = [
        np.interp(length - slip * rolled, np.arange(384) * 2e-6, result.height[:, 0])
        for slip, result in zip((1.3, 0.7), results, strict=True)
    ]
    assert passing.film_m[at] == pytest.approx(first.central_film_m - sum(heights), abs=1e-15)
    # The faster surface passes first.
    assert passing.rolled_m[-1] == pytest.approx(length / 1.3, rel=0.01)


def test_a_surface_at_rest_is_refused() -> None:
    with pytest.raises(SurfaceError, match="stands still"):
        TwoWaveTransfer(conditions(0.0))


def test_conditions_outside_the_fit_are_named() -> None:
    transfer = TwoWaveTransfer(conditions(1.95))
    assert not transfer.covers_all
    assert "S = 1.95" in transfer.outside_reason


def test_laws_of_the_oil_in_a_file(tmp_path: Path) -> None:
    """Carreau's law is taken; laws of viscosity and density that the fit has not seen are named."""
    keys = {key: value for key, value in KEYS.items() if key != "eyring_stress_pa"}
    lines = "".join(f"  {key} = {value}\n" for key, value in keys.items())
    path = tmp_path / "contact.nml"
    carreau = "flow_law = 'carreau' carreau_modulus_pa = 1e6 carreau_exponent = 0.5"
    path.write_text(f"&conditions\n{lines}/\n&lubricant {carreau} /\n")
    contact = read_conditions([str(path), "slip_parameter=1.3"])
    assert contact.oil.name == "Carreau"
    assert TwoWaveTransfer(contact).covers_all
    path.write_text(f"&conditions\n{lines}/\n&lubricant viscosity_law = 'barus' {carreau} /\n")
    barus = read_conditions([str(path), "slip_parameter=1.3"])
    assert "viscosity_law = 'barus'" in TwoWaveTransfer(barus).outside_reason
    with pytest.raises(RangeError, match="barus"):
        AtlasTransfer(read_conditions([str(path)]))


def test_deform_takes_two_surfaces(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, seed in (("ball", 1), ("disc", 2)):
        np.savetxt(tmp_path / f"{name}.csv", rough_trace(seed).height * 1e9)
    words = [f"{key}={value}" for key, value in KEYS.items()]
    command = ["deform", str(tmp_path / "ball.csv"), "--second", str(tmp_path / "disc.csv")]
    command += ["--conditions", *words, "slip_parameter=1.3", "--formula", "two-waves"]
    command += ["--step", "2", "--length-unit", "um", "--height-unit", "nm"]
    assert main([*command, "--output", str(tmp_path / "out")]) == 0
    said = capsys.readouterr().out
    assert "S = 1.3" in said
    assert "S = 0.7" in said
    assert "Both         film at the centre" in said
    assert (tmp_path / "out" / "film.csv").is_file()
    assert (tmp_path / "out" / "second" / "deformed.csv").is_file()
    assert main([*command, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    shares = [found[one]["statistics"]["rq_after_m"] for one in ("first", "second")]
    # Over the length both share, so not exactly the sum of the squares.
    assert found["film"]["film_rq_m"] == pytest.approx(np.hypot(*shares), rel=0.15)
