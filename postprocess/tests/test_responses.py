"""Responses of a contact to many waves: each equals a single response, with error and range."""

import numpy as np
import pytest
import xarray

import ehlwave

MOES = {"load_parameter_m": 100, "lubricant_parameter_l": 10, "radius_ratio_d": 1}
LINE = {"load_parameter_m": 20, "lubricant_parameter_l": 10, "radius_ratio_d": 0}
EYRING = MOES | {"slip_parameter": 1.2, "eyring_stress_pa": 5e6, "reduced_modulus_pa": 2.26e11}


@pytest.mark.parametrize("keys", [MOES, EYRING, MOES | {"slip_parameter": 1.3}])
def test_each_response_is_that_of_one_wave(keys: dict[str, float]) -> None:
    contact = ehlwave.Contact(**keys)
    found = contact.responses([0.3, 1.0], angle_deg=[0, 30, 90])
    assert found["film_real"].dims == ("wavelength", "angle")
    for wave in (0.3, 1.0):
        for angle in (0, 30, 90):
            one, cell = contact.response(wave, angle), found.sel(wavelength=wave, angle=angle)
            assert complex(cell["film_real"], cell["film_imag"]) == one.film
            assert float(cell["film_amplitude"]) == abs(one.film)
            assert float(cell["film_phase"]) == pytest.approx(np.angle(one.film))
            assert float(cell["film_error"]) == one.error
            assert one.source in found.attrs["source"]
            np.testing.assert_equal(
                [float(cell["pressure_real"]), float(cell["pressure_imag"])],
                [one.pressure.real, one.pressure.imag],
            )
    assert found.attrs["slip_parameter"] == contact.conditions.slip_parameter


def test_what_lies_outside_is_flagged_and_not_a_number() -> None:
    found = ehlwave.Contact(**MOES).responses([0.05, 0.1, 4, 4.1], angle_deg=[0, 91])
    assert found["is_inside"].values.tolist() == [
        [False] * 2,
        [True, False],
        [True, False],
        [False] * 2,
    ]
    assert (np.isfinite(found["film_error"]) == found["is_inside"]).all()
    line = ehlwave.Contact(**LINE).responses([1.0], angle_deg=[0, 10])
    assert line["is_inside"].values.tolist() == [[True, False]]
    assert ehlwave.Contact(**LINE).responses().sizes["angle"] == 1


def test_a_contact_outside_the_atlas_is_an_error_and_no_table_of_nothing() -> None:
    with pytest.raises(ehlwave.RangeError, match="load_parameter_m"):
        ehlwave.Contact(**MOES | {"load_parameter_m": 2e5}).responses([1.0])
    with pytest.raises(ehlwave.RangeError, match="slip_parameter"):
        ehlwave.Contact(**MOES).responses([1.0], slip_parameter=1.9)
    for wrong in (True, [0.5, True]):
        with pytest.raises(ehlwave.SurfaceError, match=r"wavelength_over_a = .*: give numbers"):
            ehlwave.Contact(**MOES).responses(wrong)


def test_every_variable_has_units_and_a_name() -> None:
    found = ehlwave.Contact(**MOES).responses([1.0], 0)
    for name, variable in found.variables.items():
        assert variable.attrs["long_name"]
        assert name == "is_inside" or variable.attrs["units"]


def test_the_figure_has_a_curve_an_angle_and_errors_as_bands() -> None:
    contact = ehlwave.Contact(**MOES)
    amplitude, phase = contact.plot([0.2, 1, 4], angle_deg=[0, 60]).axes
    found = contact.responses([0.2, 1, 4], angle_deg=[0, 60])
    assert len(amplitude.lines) == len(phase.lines) == 2
    np.testing.assert_array_equal(
        amplitude.lines[1].get_ydata(), found["film_amplitude"].sel(angle=60)
    )
    band = amplitude.collections[0].get_paths()[0].vertices[:, 1]
    first = found.sel(angle=0)
    assert band.max() == pytest.approx(float((first["film_amplitude"] + first["film_error"]).max()))


def test_slip_has_either_of_its_names() -> None:
    contact = ehlwave.Contact(**EYRING)
    by_ratio = contact.responses([0.5, 1.0], [0], slide_to_roll_ratio=0.3)
    xarray.testing.assert_identical(
        by_ratio, contact.responses([0.5, 1.0], [0], slip_parameter=1.15)
    )
    assert contact.plot([0.5, 1.0], [0], slide_to_roll_ratio=0.3).axes
    with pytest.raises(ehlwave.EhlwaveError, match="slide_to_roll_ratio"):
        contact.responses([1.0], slip_parameter=1.15, slide_to_roll_ratio=0.3)
