"""Errors of predicted roughness in thin films, against recorded marches of traces and maps."""

import csv
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from contact import experiment

from ehlwave.surface import amplitude as amplitudes
from ehlwave.surface.amplitude import (
    VALIDATED_ROLLING,
    VALIDATED_SLIDING,
    expected_nonlinearity,
    lowest_film,
)
from studies.error_bars import changes_of_maps

RECORD = Path(__file__).parents[1] / "record"


def test_recorded_marches_keep_to_the_errors() -> None:
    """Rq marched and predicted (``record/microgeometry``), as the record has them."""
    with (RECORD / "microgeometry/table.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        amplitude = float(row["amplitude_over_film"])
        assert amplitude < VALIDATED_ROLLING
        contact = experiment(mean_speed_m_per_s=float(row["speed_m_per_s"]))
        allowed = expected_nonlinearity(contact, amplitude) + 0.03  # conditions of table and grid
        assert float(row["rq_table_nm"]) == pytest.approx(
            float(row["rq_simulated_nm"]), rel=allowed
        )


@pytest.fixture(scope="module")
def maps() -> pd.DataFrame:
    """Return the converged marches of ``record/lambda`` with the errors of their predictions."""
    return changes_of_maps()


def test_rough_maps_keep_to_the_factors_and_reach_the_validated_amplitudes(
    maps: pd.DataFrame,
) -> None:
    within = maps["rq_change"].abs() <= amplitudes.PROFILE_FACTOR * maps["square"]
    assert within.mean() >= 0.95
    for oil, part in maps.groupby(maps["motion"].str.split("-").str[0]):
        kind = "rolling" if oil == "rolling" else "sliding"
        allowed = 1.02 * amplitudes.RISE_ERRORS[kind] * part["square"]
        assert (part["mean_change"].abs() <= allowed).mean() >= 0.95, oil
        enough = VALIDATED_ROLLING if kind == "rolling" else VALIDATED_SLIDING
        assert (part["square"] >= enough**2).sum() >= 2, oil
    assert (maps["lambda_error"].abs() <= maps["stated_error"]).all()


def test_lowest_films_have_the_fitted_width(maps: pd.DataFrame) -> None:
    """The width is the best for all contacts but the ellipse, whose errors it halves."""
    held_out = maps["contact"] == "ellipse"

    def errors(part: pd.DataFrame, width: float) -> np.ndarray:
        films = [lowest_film(one, width) for one in part["lowest_predicted"]]
        return np.abs(np.array(films) - part["lowest_marched"])

    widths = np.arange(0.05, 0.8, 0.01)
    squares = [np.mean(errors(maps[~held_out], one) ** 2) for one in widths]
    assert widths[int(np.argmin(squares))] == pytest.approx(amplitudes.LOWEST_WIDTH)
    part = maps[held_out]
    linear = np.abs(part["lowest_predicted"] - part["lowest_marched"])
    corrected = errors(part, amplitudes.LOWEST_WIDTH)
    assert np.quantile(corrected, 0.95) < 0.5 * np.quantile(linear, 0.95)
