"""Stresses of predicted contacts: pressure of rough surfaces, histories of both bodies, reports."""

import json

import numpy as np
import pytest

from ehlwave import Body, Contact
from ehlwave.errors import StressError
from ehlwave.stress import contact_fields, rough_stress, stress_below
from ehlwave.stress.figures import predicted_section
from ehlwave.stress.midplane import hertz_midplane_stress
from ehlwave.stress.passage import ripple_stresses
from ehlwave.stress.report import stress_dataset, stress_json, stress_text
from ehlwave.stress.waves import COMPONENTS
from ehlwave.surface import Surface, deform_surface, trace_surface
from ehlwave.surface.ripple import stiffness_pa
from ehlwave.surface.rough_pressure import ripple_of

KEYS = {
    "radius_x_m": 12.5e-3,
    "radius_y_m": 12.5e-3,
    "reduced_modulus_pa": 2.26e11,
    "load_n": 60,
    "mean_speed_m_per_s": 0.5,
    "viscosity_pa_s": 0.05,
    "eyring_stress_pa": 5e6,
}


def contact(slip: float = 1.0, **changes: float) -> Contact:
    return Contact(**(KEYS | changes), slip_parameter=slip)


def wave(slip: float = 1.0, over_a: float = 0.5, amplitude_m: float = 2e-8) -> Surface:
    a = contact(slip).conditions.semi_axis_a_m
    x = np.arange(64) / 16
    return trace_surface(amplitude_m * np.cos(2 * np.pi * x), over_a * a / 16, name="wave")


def rough(seed: int = 3, amplitude_m: float = 2e-8) -> Surface:
    spectrum = np.zeros(129, complex)
    random = np.random.default_rng(seed)
    spectrum[4:24] = np.exp(2j * np.pi * random.uniform(size=20))
    heights = np.fft.irfft(spectrum)
    return trace_surface(amplitude_m * heights / heights.std(), 3e-6, name=f"rough {seed}")


def test_stiffness_is_a_quarter_of_the_modulus() -> None:
    for changes in ({}, {"radius_y_m": 80e-3}):
        assert stiffness_pa(contact(**changes).conditions) == pytest.approx(2.26e11 / 4)
    line = {key: value for key, value in KEYS.items() if key not in ("radius_y_m", "load_n")}
    del line["eyring_stress_pa"]
    conditions = Contact(**line, load_n_per_m=2e5).conditions
    assert stiffness_pa(conditions) == pytest.approx(2.26e11 / 4, rel=1e-6)


@pytest.mark.parametrize("slip", [1.0, 1.2, 0.7])
def test_pressure_is_that_of_the_response(slip: float) -> None:
    """A peak carries more pressure; amplitude and phase match the atlas at the centre."""
    one = contact(slip)
    deformed = one.deform(wave(slip), form="none", ends="none")
    response = one.response(0.5, 0.0, slip)
    conditions = one.conditions
    unit = conditions.alphabar / 2.2e-8 / (conditions.hertz_approach_c_m or np.nan)
    turn = np.exp(2j * np.pi * np.arange(64) / 16)
    expected = -2e-8 * unit * (response.pressure * turn).real
    np.testing.assert_allclose(
        deformed.pressure_pa[:, 0], expected, atol=0.03 * np.abs(expected).max()
    )
    assert np.sum(deformed.pressure_pa * wave(slip).height) > 0


def test_stresses_in_rolling_are_those_below_the_pressure() -> None:
    deformed = contact().deform(rough(), form="none", ends="none")
    depths = np.array([0.0, 5e-6, 3e-5])
    below = stress_below(deformed.pressure_pa, (3e-6, 1), depths, periodic=True)
    ripple = ripple_of(deformed)
    for place in (0.0, 4e-5):
        (found,) = ripple_stresses(ripple, np.array([place]), depths, 1.0, 0.0, 0.3)
        for name in ("sxx", "syy", "szz", "sxz"):
            scale = np.abs(below[name]).max()
            np.testing.assert_allclose(found[name], below[name], atol=1e-3 * float(scale))


def test_points_of_the_other_body_meet_the_waves_as_they_pass() -> None:
    """With slip, of both waves: the same stress at the same place and time, whoever is there."""
    slip, ratio, depths = 1.2, 1.2 / 0.8, np.array([1e-5])
    ripple = ripple_of(contact(slip).deform(rough(), form="none", ends="none"))
    step = ripple.length_m / ripple.points
    place, index = 2e-5, 40
    (own,) = ripple_stresses(ripple, np.array([place]), depths, 1.0, 0.02, 0.3)
    (other,) = ripple_stresses(ripple, np.array([place]), depths, ratio, 0.02, 0.3)
    # At X = x the time is (x - xi)/S: the other body's point there has another xi.
    shift = (place - ratio * place) / step
    at = (index - shift) % ripple.points
    low, share = int(at), at % 1
    for name in own:
        line = other[name][0, :, 0]
        between = (1 - share) * line[low] + share * line[(low + 1) % ripple.points]
        scale = np.abs(own[name]).max()
        assert own[name][0, index, 0] == pytest.approx(between, abs=0.02 * scale)


def test_film_and_pressure_over_the_contact() -> None:
    one = contact(1.2)
    deformed = one.deform(rough(), form="none", ends="none")
    step = deformed.surface.step_x_m
    for index in (0, 50, 111):
        way = -index * step / 1.2
        fields = contact_fields([deformed], way, points=(65, 33))
        centre = fields.sel(x=0, y=0, method="nearest")
        mean = deformed.statistics.mean_film_m or np.nan
        expected = mean - deformed.height[index, 0]
        assert float(centre["film_m"]) == pytest.approx(expected, abs=2e-10)
        hertz = one.conditions.alphabar / 2.2e-8
        pressure = hertz + deformed.pressure_pa[index, 0]
        assert float(centre["pressure_pa"]) == pytest.approx(pressure, rel=2e-3)
    assert float(fields["pressure_pa"].min()) == 0
    assert np.isnan(fields["film_m"].values[0, 0])


def test_bodies_have_their_own_poisson_ratios() -> None:
    ball, disc = Body.ball(25e-3, material="glass"), Body(material="steel")
    keys = {"load_n": 60, "viscosity_pa_s": 0.05}
    one = Contact.from_bodies(ball, disc, speeds_m_per_s=(0.5, 0.5), **keys)
    depths = {"depths_m": [0, 5e-6, 3e-5], "form": "none", "ends": "none"}
    own = one.stress(rough(), **depths)
    assert own.poisson_ratio == (ball.poisson_ratio, disc.poisson_ratio)
    for body, nu in zip(range(2), own.poisson_ratio, strict=True):
        alone = one.stress(rough(), poisson_ratio=nu, **depths)
        assert alone.poisson_ratio == nu
        assert own.bodies[body].peaks == alone.bodies[body].peaks
    assert own.bodies[0].peaks != own.bodies[1].peaks
    assert predicted_section(own).axes


def test_in_rolling_both_bodies_bear_the_same() -> None:
    result = contact().stress(rough(), form="none", ends="none")
    first, second = result.bodies
    assert first.is_rough
    assert not second.is_rough
    assert first.dang_van == pytest.approx(second.dang_van, rel=1e-9)
    assert first.ripple_shear.value_pa == pytest.approx(second.ripple_shear.value_pa, rel=1e-9)
    assert 0 < first.life_ratio < 1


def test_which_body_is_called_the_first_does_not_matter() -> None:
    smooth = trace_surface(np.zeros(256), 3e-6, name="smooth")
    here = contact(1.2).stress(rough(), form="none", ends="none")
    there = contact(0.8).stress(smooth, rough(), form="none", ends="none")
    assert here.friction == pytest.approx(there.friction, rel=0.05)
    for one, other in ((here.bodies[0], there.bodies[1]), (here.bodies[1], there.bodies[0])):
        # Points of the smooth body are chosen elsewhere.
        shear = other.ripple_shear.value_pa
        assert one.ripple_shear.value_pa == pytest.approx(shear, rel=0.03)
        assert one.dang_van_near == pytest.approx(other.dang_van_near, rel=0.03)


def test_smooth_surfaces_leave_the_smooth_contact() -> None:
    smooth = trace_surface(np.zeros(64), 3e-6, name="smooth")
    for slip in (1.0, 1.1):
        body = contact(slip).stress(smooth, form="none").bodies[0]
        assert body.ripple_shear.value_pa == 0
        assert body.dang_van == body.dang_van_smooth
        assert body.life_ratio == pytest.approx(1)
        assert body.peaks["von_mises"].value_pa == body.peaks["von_mises"].smooth_pa


def test_ridges_along_rolling_stand_still_for_both() -> None:
    ridges = Surface(rough().height.T, 0.0, 3e-6, "ridges")
    result = contact(1.2).stress(ridges, form="none", ends="none", friction=0.0)
    first, second = result.bodies
    assert first.ripple_shear.value_pa == pytest.approx(second.ripple_shear.value_pa, rel=1e-9)
    assert first.dang_van == pytest.approx(second.dang_van, rel=1e-9)


def test_a_map_of_ridges_is_its_trace() -> None:
    trace = rough()
    ridges = Surface(np.repeat(trace.height, 16, axis=1), 3e-6, 4e-6, "ridges")
    options = {"form": "none", "ends": "none", "depths_m": [0, 1e-5, 5e-5]}
    one, other = (contact(1.2).stress(surface, **options) for surface in (trace, ridges))
    assert other.ripple_rq_pa == pytest.approx(one.ripple_rq_pa, rel=1e-3)
    for first, second in zip(one.bodies, other.bodies, strict=True):
        shear = second.ripple_shear.value_pa
        assert first.ripple_shear.value_pa == pytest.approx(shear, rel=0.05)


def test_line_contacts_and_ellipses() -> None:
    line = {key: value for key, value in KEYS.items() if key not in ("radius_y_m", "load_n")}
    del line["eyring_stress_pa"]
    for one in (Contact(**line, load_n_per_m=2e5), contact(radius_y_m=80e-3)):
        result = one.stress(rough(), form="none", ends="none")
        body = result.bodies[0]
        assert 0.5 < body.peaks["von_mises"].smooth_pa / result.hertz_pa < 0.65
        assert body.ripple_shear.value_pa > 0


@pytest.mark.parametrize(("b", "friction"), [(1.0, 0.1), (3.0, 0.0), (3.0, -0.1)])
def test_midplane_of_hertz_contacts(b: float, friction: float) -> None:
    x, z = np.linspace(-2, 2, 41), np.array([0.1, 0.3, 0.7, 1.2])
    found = hertz_midplane_stress(x, z, (1.0, b), 1.0, friction)
    step = 4 / 192
    places = (np.arange(192) - 96) * step
    inside = np.maximum(1 - places[:, None] ** 2 - places**2, 0) ** 0.5
    exact = stress_below(inside, (step, b * step), z, traction_x_pa=friction * inside)
    for name in COMPONENTS:
        line = exact[name].isel(y=96)
        expected = [np.interp(x[:-1], places, depth) for depth in line.values]
        np.testing.assert_allclose(found[name][:, :-1], expected, atol=8e-3, err_msg=name)


def test_errors_and_warnings_grow_with_the_amplitude() -> None:
    small = contact().stress(rough(amplitude_m=1e-9), form="none", ends="none")
    large = contact().stress(rough(amplitude_m=2e-7), form="none", ends="none")
    assert small.ripple_error < 0.1 < large.ripple_error
    assert not any("first estimate" in text for text in small.warnings)
    assert any("first estimate" in text for text in large.warnings)
    assert any("asperities" in text for text in large.warnings)
    assert 1 >= small.valid_within_a > large.valid_within_a >= 0
    half = rough(amplitude_m=1e-8)
    both = contact().stress(half, half, form="none", ends="none")
    whole = contact().stress(rough(amplitude_m=2**0.5 * 1e-8), form="none", ends="none")
    assert both.ripple_error == pytest.approx(whole.ripple_error, rel=1e-6)
    assert f"Valid        for |x| < {small.valid_within_a:.2f} a" in stress_text(small)
    assert any("cannot bear tension" in text for text in contact().stress(
        rough(amplitude_m=1e-6), form="none", ends="none").warnings)  # fmt: skip


def test_the_error_holds_a_march_at_a_quarter_of_the_film() -> None:
    """Ripple shear of ehlwave-case, 192 x 128 cells: the prediction is 1 % off at a fifth of it."""
    slender = Contact(
        radius_x_m=12.5e-3,
        radius_y_m=0.05,
        reduced_modulus_pa=2.26e11,
        load_n=100,
        mean_speed_m_per_s=2,
        viscosity_pa_s=0.05,
        eyring_stress_pa=8e6,
        slip_parameter=1.35,
    )
    x, random = np.arange(320) / 320, np.random.default_rng(41)
    waves = sum(
        np.cos(2 * np.pi * n * x + random.uniform(0, 2 * np.pi)) / n**0.7 for n in range(4, 12)
    )
    waves *= np.sin(0.5 * np.pi * np.clip(np.minimum(x, x[-1] - x) / 0.15, 0, 1)) ** 2
    height = 0.25 * (slender.film().central_m or 0) * waves / np.std(waves) / 2**0.5
    a = slender.conditions.semi_axis_a_m
    body = slender.stress(trace_surface(height, 4.5 * a / 320), form="none", ends="none").bodies[0]
    assert body.ripple_shear.value_pa == pytest.approx(127e6, abs=body.ripple_shear_error_pa)


def test_reports_say_the_same() -> None:
    result = contact(1.2).stress(rough(), form="none", ends="none", cycles=1e6)
    text, document = stress_text(result), json.loads(stress_json(result))
    assert "First body, rough, S = 1.2" in text
    assert "Second body, smooth, S = 0.8" in text
    assert document["cycles"] == 1e6
    body = document["bodies"][1]
    assert body["dang_van"] == result.bodies[1].dang_van
    assert f"{body['dang_van']:.3f}" in text
    data = stress_dataset(result)
    assert float(data["dang_van_1"].max()) <= result.bodies[0].dang_van
    assert data["path_shear_2_pa"].size == data["path_hydrostatic_2_pa"].size


def test_what_cannot_be_computed_is_said() -> None:
    moes = Contact(
        load_parameter_m=100, lubricant_parameter_l=10, radius_ratio_d=1, semi_axis_a_m=2e-4
    )
    with pytest.raises(StressError, match="radius_x_m"):
        moes.stress(rough(), form="none")
    first = contact(1.2).deform(rough(), form="none")
    with pytest.raises(StressError, match=r"not 0\.8"):
        rough_stress([first, first])
    with pytest.raises(StressError, match="cycles"):
        contact().stress(rough(), form="none", cycles=0)
    with pytest.raises(StressError, match="depths_m"):
        contact().stress(rough(), form="none", depths_m=[-1])
    newtonian = {key: value for key, value in KEYS.items() if key != "eyring_stress_pa"}
    found = Contact(**newtonian, slip_parameter=1.1).stress(rough(), form="none")
    assert any("friction is not known" in text for text in found.warnings)
    formula = deform_surface(rough(), contact().conditions)
    assert formula.pressure_pa.shape == (256, 1)
