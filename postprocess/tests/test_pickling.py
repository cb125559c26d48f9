"""Public objects go through pickle and come back from other processes, whatever they have done."""

import pickle
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from multiprocessing import get_context

import numpy as np
import pandas as pd
import pytest
from contact import BALL

import ehlwave
from ehlwave import Case, Study
from ehlwave.contact import Oil
from ehlwave.surface import (
    FormulaTransfer,
    Mover,
    ReadOptions,
    RecommendedTransfer,
    TwoWaveTransfer,
    deform_surface,
    film_of_two,
    map_surface,
    second_conditions,
    trace_surface,
)
from ehlwave.surface.surface import Surface

LEAST = 25


def contact(**more: float) -> ehlwave.Contact:
    return ehlwave.Contact(**BALL, **more)


def used_contact(**more: float) -> ehlwave.Contact:
    made = contact(**more)
    made.film()
    made.response(0.5, angle_deg=30)
    return made


@cache
def trace() -> Surface:
    x = np.arange(0, 2e-3, 4e-6)
    return trace_surface(50e-9 * np.cos(2 * np.pi * x / 1e-4), step_m=4e-6)


@cache
def deformed() -> ehlwave.surface.Deformed:
    return contact().deform(trace())


def both() -> ehlwave.surface.FilmOfTwo:
    first = contact(slip_parameter=1.2).conditions
    other = second_conditions(first)
    parts = (deform_surface(trace(), c, TwoWaveTransfer(c)) for c in (first, other))
    return film_of_two(*parts)


def sliding_map() -> ehlwave.surface.Deformed:
    x, y = np.meshgrid(np.arange(64), np.arange(48), indexing="ij")
    height = 1e-8 * np.cos(0.4 * x) * np.cos(0.3 * y)
    sliding = contact(slip_parameter=1.2, eyring_stress_pa=5e6)
    return sliding.deform(map_surface(height, 4e-6, 4e-6))


def refit_row() -> ehlwave.RefitRow:
    return ehlwave.RefitRow("all", "f_v", 15, 1, 0.1, c1=0.2, c2=0.03)


def unused(kind: type) -> Case | Study:
    """Return a case or study without a program, with its keys."""
    made = kind.__new__(kind)
    made.groups = {"conditions": {"load_parameter_m": 10}}
    if kind is Study:
        made.lists, made.options = {"slip_parameter": [1, 1.2]}, {}
        made.rows = pd.DataFrame({"load_parameter_m": [10.0]})
    return made


MAKERS: dict[str, Callable[[], object]] = {
    "Contact": contact,
    "Contact, used": used_contact,
    "Contact, sliding, used": lambda: used_contact(slip_parameter=1.2, eyring_stress_pa=5e6),
    "Contact, two waves": lambda: used_contact(slip_parameter=1.2),
    "Conditions": lambda: contact().conditions,
    "Oil": Oil,
    "Medium": lambda: contact().conditions.medium(1.1),
    "Film": lambda: contact().film(),
    "Response": lambda: contact().response(0.5),
    "responses": lambda: contact().responses([0.5, 1], [0, 90]),
    "Atlas": lambda: contact().atlas(),
    "Chart": lambda: contact().atlas().at(contact().conditions.atlas_keys()),
    "Surface": trace,
    "Deformed": deformed,
    "Deformed, a map under slip": sliding_map,
    "FilmStatistics": lambda: deformed().statistics,
    "Spectrum": lambda: deformed().spectra["x"],
    "AtlasTransfer": lambda: deformed().transfer,
    "TwoWaveTransfer": lambda: TwoWaveTransfer(contact(slip_parameter=1.2).conditions),
    "RecommendedTransfer": lambda: RecommendedTransfer(contact().conditions),
    "FormulaTransfer": lambda: FormulaTransfer(contact().conditions),
    "Mover": lambda: Mover(trace(), TwoWaveTransfer(contact(slip_parameter=1.2).conditions)),
    "FilmOfTwo": both,
    "RoughStress": lambda: contact().stress(trace()),
    "ReadOptions": lambda: ReadOptions(step=1, length_unit="um"),
    "RefitSettings": ehlwave.RefitSettings,
    "RefitRow": refit_row,
    "FormulaFit": lambda: ehlwave.fit_formula(np.geomspace(0.1, 20, 9), _curve()),
    "Case": lambda: unused(Case),
    "Study": lambda: unused(Study),
}


def _curve() -> np.ndarray:
    return ehlwave.amplitude_ratio_formula(np.geomspace(0.1, 20, 9), 0.2, 0.03)


ERRORS = [getattr(ehlwave, name) for name in ehlwave.__all__ if name.endswith("Error")]


def shown(item: object) -> str:
    return repr(item)


@pytest.fixture(scope="module")
def pool() -> Iterator[ProcessPoolExecutor]:
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as executor:
        yield executor


def test_enough_is_tried() -> None:
    assert len(MAKERS) >= LEAST


@pytest.mark.parametrize("name", MAKERS)
def test_objects_are_the_same_in_another_process(name: str, pool: ProcessPoolExecutor) -> None:
    item = MAKERS[name]()
    copy = pickle.loads(pickle.dumps(item))
    assert repr(copy) == repr(item) or " object at 0x" in repr(item)
    said = pool.submit(shown, item).result(timeout=120)
    assert said == repr(item) or " object at 0x" in said


def test_a_contact_answers_alike_in_a_pool(pool: ProcessPoolExecutor) -> None:
    made = used_contact()
    assert pool.submit(made.film).result(timeout=120) == made.film()
    own = made.deform(trace())
    there = pool.submit(made.deform, trace()).result(timeout=120)
    np.testing.assert_array_equal(there.height, own.height)
    assert there.statistics == own.statistics
    again = pickle.loads(pickle.dumps(own))
    np.testing.assert_array_equal(again.pressure_pa, own.pressure_pa)


@pytest.mark.parametrize("kind", ERRORS)
def test_errors_have_one_base_and_keep_their_text(kind: type[Exception]) -> None:
    assert issubclass(kind, ehlwave.EhlwaveError)
    copy = pickle.loads(pickle.dumps(kind("a text")))
    assert type(copy) is kind
    assert str(copy) == "a text"


@pytest.mark.parametrize("kind", [ehlwave.ArgumentError, ehlwave.RangeError, ehlwave.StressError])
def test_errors_of_arguments_are_value_errors(kind: type[Exception]) -> None:
    assert issubclass(kind, ValueError)


@pytest.mark.parametrize("name", MAKERS)
def test_no_object_shows_its_arrays(name: str) -> None:
    item = MAKERS[name]()
    if name != "responses":  # xarray shows a line of each
        assert "array(" not in repr(item)
        assert len(repr(item)) < 1200
    html = getattr(item, "_repr_html_", None)
    assert html is None or "<" in html()
