"""The law of warm inlets: its record, its tables in both languages, its limits."""

import csv

import numpy as np
import pandas as pd
import pytest

import ehlwave
from ehlwave.contact import conditions_from_keys
from ehlwave.errors import SurfaceError
from ehlwave.laws.inlet_warming import inlet_factor, inlet_warming, loss_error
from studies.inlet_law import COLUMNS, fit
from studies.inlet_tables import HOMES, RECORD, tables

BALL = {"radius_x_m": 0.0127, "radius_y_m": 0.0127, "reduced_modulus_pa": 2.26e11, "load_n": 40}
BALL |= {"mean_speed_m_per_s": 4, "viscosity_pa_s": 0.05}


def contacts() -> pd.DataFrame:
    return pd.read_csv(RECORD.parent / "contacts.csv")


@pytest.mark.parametrize("name", HOMES)
def test_both_tables_are_made_from_the_record(name: str) -> None:
    assert (HOMES[name] / name).read_text() == tables()[name]


def test_the_record_is_the_fit_of_its_contacts() -> None:
    with RECORD.open() as file:
        kept = {row["name"]: float(row["value"]) for row in csv.DictReader(file)}
    for row in fit(contacts()):
        assert kept[row["name"]] == pytest.approx(row["value"], rel=2e-4), row["name"]


def test_the_error_covers_the_contacts() -> None:
    """95 % at any slide-to-roll ratio."""
    rows = contacts()
    loss = 1 - inlet_factor(*(rows[name] for name in COLUMNS))
    off = np.abs(1 - rows["inlet_factor"] - loss)
    slides = rows["slide_to_roll_ratio"].abs()
    error = np.array([loss_error(x, s) for x, s in zip(loss, slides, strict=True)])
    for low, high in ((-1, 0.2), (0.2, 1), (1, 2)):
        part = (slides > low) & (slides <= high)
        assert (off <= error)[part].mean() > 0.93


def test_losses_of_a_ball() -> None:
    """&heat computes 4.4 % between bodies of usual steel, with an oil that expands."""
    found = inlet_warming(conditions_from_keys(BALL))
    assert abs(found.loss - 0.044) < found.error < 0.012
    assert 1 < found.rise_k < 2
    heat = ehlwave.Heat(313.15, 0.04, 0.14, 2000, 870, body=ehlwave.BodyHeat(1.1, 2500, 840))
    glass = inlet_warming(conditions_from_keys(BALL), heat=heat)
    assert glass.loss > 1.5 * found.loss
    slow = inlet_warming(conditions_from_keys(BALL | {"mean_speed_m_per_s": 0.4}))
    assert slow.loss < 0.1 * found.loss


def test_beyond_the_law_comes_an_upper_estimate() -> None:
    fast = conditions_from_keys(BALL | {"mean_speed_m_per_s": 15})  # a thick film
    found = inlet_warming(fast)
    assert found.is_upper_estimate
    assert found.loss > inlet_warming(conditions_from_keys(BALL)).loss


def test_moes_parameters_alone_are_refused() -> None:
    keys = {"load_parameter_m": 100, "lubricant_parameter_l": 10, "radius_ratio_d": 1}
    with pytest.raises(SurfaceError, match="dimensional conditions"):
        inlet_warming(conditions_from_keys(keys | {"semi_axis_a_m": 1e-4}))
