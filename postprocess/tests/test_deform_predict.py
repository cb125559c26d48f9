import dataclasses

import numpy as np
import pytest
from contact import experiment

from ehlwave.contact.formula import amplitude_ratio_formula, f_of_r, recommended_ratio
from ehlwave.errors import SurfaceError
from ehlwave.surface import (
    FormulaTransfer,
    RecommendedTransfer,
    Surface,
    deform_surface,
    map_surface,
    trace_surface,
)
from ehlwave.surface.amplitude import lowest_film

CONTACT = experiment()
ELLIPTIC = experiment(radius_y_m=0.12)
WAVE = 60e-6


def cosine_trace(points: int = 512, waves: int = 8, axis: str = "x") -> Surface:
    phase = 2 * np.pi * waves * np.arange(points) / points + 0.3
    return trace_surface(2e-8 * np.cos(phase), WAVE * waves / points, axis)


def random_map(nx: int, ny: int, seed: int = 3) -> Surface:
    heights = np.random.default_rng(seed).standard_normal((nx, ny))
    return map_surface(2e-8 * heights, 3e-6, 4e-6)


@pytest.mark.parametrize("contact", [CONTACT, ELLIPTIC])
@pytest.mark.parametrize(("axis", "r"), [("x", 0.0), ("y", np.inf)])
def test_a_cosine_is_reduced_by_formula_18_to_rounding(contact, axis: str, r: float) -> None:  # noqa: ANN001
    surface = cosine_trace(axis=axis)
    result = deform_surface(surface, contact, form="none", window="none")
    v = WAVE / contact.semi_axis_a_m * np.sqrt(contact.gamma * contact.m / contact.l)
    expected = surface.height * amplitude_ratio_formula(f_of_r(r) * v)
    np.testing.assert_allclose(result.height, expected, rtol=0, atol=1e-14 * 2e-8)


@pytest.mark.parametrize(("waves_x", "waves_y"), [(6, 2), (4, 4), (2, 7)])
def test_products_and_oblique_waves_are_judged_by_r(waves_x: int, waves_y: int) -> None:
    nx, ny = 96, 64
    x, y = np.meshgrid(np.arange(nx) * 5e-6, np.arange(ny) * 6e-6, indexing="ij")
    wave_x, wave_y = nx * 5e-6 / waves_x, ny * 6e-6 / waves_y
    kx, ky = 2 * np.pi / wave_x, 2 * np.pi / wave_y
    f_v = f_of_r(wave_x / wave_y) * min(wave_x, wave_y) * CONTACT.v_per_wavelength
    for heights in (np.cos(kx * x) * np.cos(ky * y), np.cos(kx * x - ky * y + 1)):
        surface = map_surface(1e-8 * heights, 5e-6, 6e-6)
        result = deform_surface(surface, CONTACT, form="none", window="none")
        expected = 1e-8 * heights * amplitude_ratio_formula(f_v)
        np.testing.assert_allclose(result.height, expected, rtol=0, atol=1e-13 * 1e-8)


@pytest.mark.parametrize("shape", [(60, 80), (61, 80), (60, 81), (61, 81)])
def test_parseval(shape: tuple[int, int]) -> None:
    result = deform_surface(random_map(*shape), CONTACT, window="none")
    before, after = np.mean(result.surface.height**2), np.mean(result.height**2)
    for name in ("x", "y"):
        assert result.spectra[name].before.sum() == pytest.approx(before, rel=1e-12)
        assert result.spectra[name].after.sum() == pytest.approx(after, rel=1e-12)
    assert after < before


def test_parseval_of_traces_and_mirrored_surfaces() -> None:
    for axis in ("x", "y"):
        result = deform_surface(cosine_trace(511, 8, axis), CONTACT, form="none", window="none")
        assert result.spectra["x"].before.sum() == pytest.approx(2e-16, rel=1e-12)
    result = deform_surface(random_map(30, 20), CONTACT)  # a mirror image has the same mean square
    assert result.spectra["y"].before.sum() == pytest.approx(np.mean(result.surface.height**2))


@pytest.mark.parametrize("window", ["none", "taper", "mirror"])
@pytest.mark.parametrize("form", ["none", "mean", "plane", "quadratic"])
def test_a_map_and_its_transpose_with_exchanged_axes_agree(window, form) -> None:  # noqa: ANN001
    surface = random_map(40, 30)
    result = deform_surface(surface, ELLIPTIC, form=form, window=window)

    class Exchanged(FormulaTransfer):
        def ratio(self, per_length_x, per_length_y):  # noqa: ANN001, ANN202
            return super().ratio(per_length_y, per_length_x)

    turned = map_surface(surface.height.T, surface.step_y_m, surface.step_x_m)
    again = deform_surface(turned, ELLIPTIC, Exchanged(ELLIPTIC), form, window)
    np.testing.assert_allclose(again.height, result.height.T, rtol=0, atol=1e-13 * 1e-8)
    np.testing.assert_allclose(
        again.spectra["y"].after, result.spectra["x"].after, rtol=1e-9, atol=1e-30
    )


def test_single_precision_agrees_with_double() -> None:
    surface = random_map(300, 200)
    single = dataclasses.replace(surface, height=surface.height.astype(np.float32))
    double, low = deform_surface(surface, CONTACT), deform_surface(single, CONTACT)
    assert low.height.dtype == np.float32
    np.testing.assert_allclose(low.height, double.height, rtol=0, atol=3e-6 * 2e-8)
    assert low.statistics.rq_after_m == pytest.approx(double.statistics.rq_after_m, rel=1e-5)


def test_mirrored_ends_do_not_leak_and_a_mean_is_not_kept() -> None:
    surface = cosine_trace()
    cut = dataclasses.replace(surface, height=surface.height[: 512 - 23] + 5e-8)
    whole = deform_surface(surface, CONTACT, form="none", window="none").height
    part = deform_surface(cut, CONTACT, form="none", window="mirror").height
    jump = deform_surface(cut, CONTACT, form="none", window="none").height
    middle = slice(200, 260)
    assert np.abs(part - whole[: 512 - 23])[middle].max() < 0.03 * 2e-8
    # mirrored or not, the offset is gone; the jump of the unmirrored ends is felt near them
    ends = [np.abs(h - whole[: 512 - 23])[:10].max() for h in (part, jump)]
    assert ends[0] < ends[1]


def test_statistics_and_lambda_ratios() -> None:
    result = deform_surface(cosine_trace(), CONTACT, form="none", window="none")
    s = result.statistics
    ratio = amplitude_ratio_formula(WAVE * CONTACT.v_per_wavelength)
    assert s.rq_before_m == pytest.approx(2e-8 / np.sqrt(2), rel=1e-12)
    assert s.rq_after_m == pytest.approx(ratio * 2e-8 / np.sqrt(2), rel=1e-12)
    assert s.lambda_ratio_before == pytest.approx(CONTACT.central_film_m / s.rq_before_m)
    assert s.lambda_ratio_after == pytest.approx(CONTACT.central_film_m / s.rq_after_m)
    film = CONTACT.central_film_m
    assert s.minimum_film_m == pytest.approx(film * lowest_film(1 - result.height.max() / film))
    assert result.warnings == []


def test_components_that_cannot_be_judged_are_named() -> None:
    short = deform_surface(cosine_trace(), CONTACT, form="none", window="none")
    assert short.unjudged == []
    long_wave = 4 * CONTACT.semi_axis_a_m
    phase = 2 * np.pi * np.arange(512) / 512
    heights = 3e-8 * np.cos(phase) + 1e-8 * np.cos(16 * phase)
    result = deform_surface(
        trace_surface(heights, long_wave / 512), CONTACT, window="none", form="none"
    )
    (group,) = result.unjudged
    assert "longer than the contact" in group.reason
    assert group.components == 1
    assert group.share_before == pytest.approx(0.9, rel=1e-12)
    assert group.largest[0].wavelength_x_m == pytest.approx(long_wave)
    assert group.largest[0].amplitude_before_m == pytest.approx(3e-8, rel=1e-12)
    # long along y only: judged, its other wavelength fits
    x, y = np.meshgrid(phase[::8], phase[::8], indexing="ij")
    both = map_surface(1e-8 * np.cos(8 * x) * np.cos(y), long_wave / 64, long_wave / 64)
    assert deform_surface(both, CONTACT, window="none", form="none").unjudged == []


def test_slip_makes_every_component_unjudged() -> None:
    result = deform_surface(
        cosine_trace(), experiment(slip_parameter=1.1), form="none", window="none"
    )
    (group,) = result.unjudged
    assert "slip" in group.reason
    assert group.share_before == pytest.approx(1)
    assert any("slip" in warning for warning in result.warnings)


def test_large_amplitudes_and_contact_are_warned_of() -> None:
    surface = cosine_trace()
    high = dataclasses.replace(surface, height=20 * surface.height)
    found = deform_surface(high, CONTACT, form="none", window="none")
    warnings = " ".join(found.warnings)
    assert "extrapolated: the amplitude" in warnings
    assert "the surfaces touch" in warnings
    assert found.statistics.surfaces_touch is True
    assert found.statistics.minimum_film_m is None
    half = dataclasses.replace(surface, height=4 * surface.height)
    found = deform_surface(half, CONTACT, form="none", window="none")
    assert "linear in the amplitude" in " ".join(found.warnings)
    assert (found.statistics.extrapolated, found.statistics.surfaces_touch) == (False, False)


def test_coefficients_with_a_pole_are_refused() -> None:
    FormulaTransfer(CONTACT, -0.1, 0.03)
    for pair in ((0.1, -0.01), (-0.5, 0.01), (0.1, 0.0)):
        with pytest.raises(SurfaceError, match="must be"):
            FormulaTransfer(CONTACT, *pair)


def test_lengths_that_cannot_belong_to_the_contact_are_refused() -> None:
    heights = 1e-9 * np.cos(np.arange(100.0))
    with pytest.raises(SurfaceError, match="no component inside the contact is resolved"):
        deform_surface(trace_surface(heights, 1e-3), CONTACT)
    with pytest.raises(SurfaceError, match="less than a tenth"):
        deform_surface(trace_surface(heights, 1e-8), CONTACT)


def test_form_removal_takes_out_what_it_names_and_nothing_else() -> None:
    nx, ny = 40, 30
    x, y = np.meshgrid(np.linspace(0, 1, nx), np.linspace(-1, 2, ny), indexing="ij")
    tilt, bowl = 1 + 2 * x - 3 * y, x**2 - 2 * x * y + 0.5 * y**2
    rough = random_map(nx, ny).height
    for form, shape in (("plane", tilt), ("quadratic", tilt + bowl)):
        plain = deform_surface(map_surface(rough, 3e-6, 4e-6), CONTACT, form=form)
        formed = deform_surface(map_surface(rough + 1e-8 * shape, 3e-6, 4e-6), CONTACT, form=form)
        np.testing.assert_allclose(
            formed.surface.height, plain.surface.height, rtol=0, atol=1e-12 * 1e-8 * 10
        )
    left = deform_surface(map_surface(1e-8 * bowl, 3e-6, 4e-6), CONTACT, form="plane")
    assert np.abs(left.surface.height).max() > 0.1e-8


def test_recommended_transfer_is_the_recommended_formula() -> None:
    contact = experiment(mean_speed_m_per_s=0.03, radius_y_m=0.12)
    transfer = RecommendedTransfer(contact)
    a = contact.semi_axis_a_m
    qx, qy = np.array([0, -2, 0, 3]) / a, np.array([0, 0, 4, 5]) / a
    waves = np.array([[2, 0], [0, 4], [3, 5]])
    wave_x, wave_y = np.where(waves == 0, 0, 1 / np.maximum(waves, 1)).T
    expected = recommended_ratio(contact.m, contact.l, contact.gamma, wave_x, wave_y)
    np.testing.assert_allclose(transfer.ratio(qx, qy), [0, *expected], rtol=1e-12)
    grid = transfer.ratio(qx[:, None], qy[None, :])
    assert grid.shape == (4, 4)
    assert grid[0, 0] == 0
    assert transfer.covers_all


def test_recommended_transfer_says_what_it_was_not_fitted_to() -> None:
    contact = dataclasses.replace(experiment(), m=20.0, slip_parameter=1.2)
    transfer = RecommendedTransfer(contact)
    assert not transfer.is_covered(np.ones(3), np.ones(3)).any()
    assert "M = 20: the formula was fitted to 50 to 2000" in transfer.outside_reason
    assert "slip" in transfer.outside_reason
