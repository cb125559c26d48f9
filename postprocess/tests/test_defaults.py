"""No default of a function replaces a value of an object or a file."""

import inspect
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from contact import EXPERIMENT

import ehlwave
import ehlwave.surface
from ehlwave.contact.oil_keys import OIL_KEYS
from ehlwave.errors import SurfaceError
from ehlwave.programs.programs import find_program
from ehlwave.surface import read_conditions, trace_surface

SLIDING = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
SLIDING |= {"slip_parameter": 1.5, "reduced_modulus_pa": 2.26e11, "eyring_stress_pa": 5e6}
LENGTHS = {"semi_axis_a_m": 0.2e-3, "radius_x_m": 15.5e-3}


def public() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Yield the functions and methods that users call, by their names."""
    for module in (ehlwave, ehlwave.surface):
        for name in module.__all__:
            one = getattr(module, name)
            if inspect.isfunction(one):
                yield name, one
            elif inspect.isclass(one):
                for method, function in inspect.getmembers(one, inspect.isfunction):
                    if not method.startswith("_"):
                        yield f"{name}.{method}", function


def keys_of_inputs() -> set[str]:
    """Return the keys of input files, as the tables of their pages list them."""
    pages = sorted((Path(__file__).parents[2] / "inputs/keys").glob("*.md"))
    text = "\n".join(page.read_text(encoding="utf-8") for page in pages)
    words = {line.split("`")[1] for line in text.splitlines() if line.startswith("| `")}
    return words | {"slip", "S", "wavelength_over_b"}


def test_keys_of_inputs_are_found() -> None:
    keys = keys_of_inputs()
    assert {"slip_parameter", "orientation", "edges", "eyring_stress_pa", "response"} <= keys


@pytest.mark.parametrize(("name", "function"), list(public()), ids=[n for n, _ in public()])
def test_keys_of_inputs_have_no_default_of_their_own(
    name: str, function: Callable[..., Any]
) -> None:
    given = inspect.signature(function).parameters.values()
    own = {
        one.name: one.default
        for one in given
        if one.name in keys_of_inputs() and one.default not in (inspect.Parameter.empty, None)
    }
    assert own == {}, f"{name}: {own}: None, and what the object or file says in its place"


def test_every_answer_of_a_contact_is_for_its_own_slip() -> None:
    """Against rolling contacts: the wave of the issue, amplitude, transfer, shape, friction."""
    sliding, rolling = (
        ehlwave.Contact(**SLIDING | LENGTHS | {"slip_parameter": slip}) for slip in (1.5, 1.0)
    )
    found = sliding.response(wavelength_over_a=1)
    assert found == sliding.response(wavelength_over_a=1, slip_parameter=1.5)
    assert abs(found.film) == pytest.approx(0.276, abs=found.error)
    assert abs(rolling.response(wavelength_over_a=1).film) == pytest.approx(0.699, abs=0.01)
    assert rolling.response(wavelength_over_a=1, slip_parameter=1.5).film == found.film
    assert sliding.film().friction is not None
    assert rolling.film().friction is None
    waves = np.array([1 / LENGTHS["semi_axis_a_m"]]), np.zeros(1)
    assert abs(sliding.transfer().ratio(*waves)[0]) == pytest.approx(abs(found.film), abs=2e-3)
    place = np.arange(800) * 2e-6
    height = 1e-9 * np.cos(2 * np.pi * place / LENGTHS["semi_axis_a_m"])
    surface = trace_surface(height, 2e-6)
    after = sliding.deform(surface, form="none", ends="none").statistics
    assert after.rq_after_m / after.rq_before_m == pytest.approx(abs(found.film), abs=5e-3)


def test_the_flow_law_of_a_file_is_not_passed_over(tmp_path: Path) -> None:
    oils = {key: value for key, value in EXPERIMENT.items() if key in OIL_KEYS}
    conditions, own = (
        "\n".join(f"{key} = {value}" for key, value in keys.items())
        for keys in ({key: EXPERIMENT[key] for key in EXPERIMENT if key not in oils}, oils)
    )
    for law, stress, fits in (
        ("eyring", "eyring_stress_pa = 5e6", True),
        ("eyring", "", False),
        ("newtonian", "eyring_stress_pa = 5e6", False),
        ("newtonian", "", True),
    ):
        file = tmp_path / "case.nml"
        oil = f"&lubricant flow_law = '{law}' {stress}\n{own} /\n"
        file.write_text(f"&conditions {conditions}\n/\n{oil}", encoding="utf-8")
        if fits:
            read_conditions([str(file)])
        else:
            with pytest.raises(SurfaceError, match=f"flow_law = '{law}'"):
                read_conditions([str(file)])


def has_programs() -> bool:
    try:
        find_program("ehlwave-case")
    except ehlwave.ProgramError:
        return False
    return True


@pytest.mark.skipif(not has_programs(), reason="the programs are not built")
def test_a_study_without_orientation_or_wave_says_what_is_missing(tmp_path: Path) -> None:
    study = ehlwave.Study(
        {"wavelength_over_a": [0.5, 1.0]},
        **{key: SLIDING[key] for key in list(SLIDING)[:3]},
        response="harmonic",
        cells_x=32,
        cells_y=32,
    )
    with pytest.raises(ehlwave.ProgramError, match="orientation"):
        study.run(tmp_path / "results.h5")
