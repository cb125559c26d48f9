"""The study of random elements: which contacts are computed, and the shares that it reports."""

import math
from pathlib import Path

import pytest

from studies.elements.__main__ import compared, refused, sample, summary, times
from studies.elements.answers import beyond, by_laws, own_errors
from studies.elements.draw import KINDS, places

KIND, POINT = "SpurGearPair", "BallOnDisc"
KNOWN, MISSING = {"central": 1.0, "friction": 0.0}, {"reason": "outside"}


def row(number: int, kind: str, *found: dict[str, object]) -> dict[str, object]:
    return {
        "number": number,
        "kind": kind,
        "places": [{"place": index} | one for index, one in enumerate(found)],
    }


ROWS = [
    row(0, POINT, KNOWN),
    row(1, KIND, KNOWN, MISSING),
    row(2, KIND, MISSING, MISSING),
    row(3, KIND, KNOWN),
    row(4, KIND, KNOWN, MISSING),
]


def test_contacts_to_compute_and_to_compare() -> None:
    assert refused(ROWS) == [101, 200, 201, 401]
    assert sample(ROWS, 2) == [100, 300, 0]  # lines first
    assert sample(ROWS, 0) == []
    ends = [*ROWS, row(5, POINT, KNOWN, KNOWN | {"beyond": "load_parameter_m"})]
    assert sample(ends, 1) == [100, 0, 501]


@pytest.mark.filterwarnings("ignore::ehlwave.errors.ExtrapolationWarning")
@pytest.mark.parametrize(
    ("number", "names"),
    [
        (0, set()),
        (2, set()),  # lines
        (20, {"load_parameter_m"}),
        (58, {"Peclet number of a surface"}),
        (90, {"lubricant_parameter_l"}),
        (267, {"film over Hertz approach"}),
    ],
)
def test_contacts_beyond_the_fit_are_named(number: int, names: set[str]) -> None:
    found = [beyond(place) for place in places(number)[1]]
    assert {one["beyond"] for one in found if one} == names


def test_errors_by_the_data_of_the_oil_are_left_out() -> None:
    case = {"central": 1.0, "central_error": 0.25, "friction": 0.1, "friction_error": 0.3}
    law = {"central_error": 0.02, "friction_error": 0.2}
    with_data = {"central_error": 0.25, "friction_error": 0.6}
    found = own_errors(case, law, with_data)
    assert found["central_error"] == pytest.approx(0.02)
    assert found["friction_error"] == 0.0
    assert found["central"] == 1.0


def test_contacts_that_were_not_computed_count_as_not_answered() -> None:
    found = {101: KNOWN, 200: KNOWN, 201: MISSING}
    gear = next(one for one in summary(ROWS, found) if one["element"] == KIND)
    assert gear["elements"] == 4
    assert (gear["contacts"], gear["contacts_by_law"]) == (7, 3)
    assert gear["elements_by_law"] == 0.25
    assert (gear["contacts_not_computed"], gear["elements_answered"]) == (1, 0.5)
    gear = next(one for one in summary(ROWS, {101: KNOWN, 401: KNOWN}) if one["element"] == KIND)
    assert (gear["contacts_not_computed"], gear["elements_answered"]) == (2, 0.75)


def test_errors_of_law_and_program_add() -> None:
    law = {"central": 1.1, "central_error": 0.05, "friction": 0.0, "friction_error": 0.0}
    case = {"central": 1.0, "central_error": 0.03}
    judged = {"kind": KIND, "slip": 0.0, "law": law, "case": case}
    assert times(judged, "central") == pytest.approx(0.1 / 0.08)
    assert math.isnan(times(judged, "friction"))
    assert [one["within"] for one in compared([judged])] == [0.0, 0.0]
    ends = compared([judged, judged | {"beyond": "load_parameter_m"}])
    assert [one["element"] for one in ends] == [KIND, "all", "load_parameter_m"]
    assert [one["compared"] for one in ends] == [1, 1, 1]


def test_an_element_of_each_kind_is_the_same_again() -> None:
    for number, kind in enumerate(KINDS):
        drawn, again = places(number)[1], places(number)[1]
        assert [one.load_n for one in drawn] == [one.load_n for one in again]
        assert places(number)[0] == kind
    found = by_laws(2, Path())
    assert found["kind"] == "CylindricalRollerBearing"
    assert len(found["places"]) == 4
