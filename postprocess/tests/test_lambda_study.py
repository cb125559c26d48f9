"""``scripts/study lambda``: maps, comparisons of a made-up march, and errors on tiny tables."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from ehlwave import Contact
from ehlwave.surface.amplitude import LOWEST_WIDTH, lowest_film
from studies import sweeps
from studies.lambda_ratio import compare, judge, report, simulate
from studies.lambda_ratio.maps import STRETCH, rough_map

CONTACT = Contact(**simulate.CONTACTS["ball"]).conditions


def test_maps_have_their_rq_their_lay_and_waves_that_a_grid_resolves() -> None:
    for kind, (along, across) in STRETCH.items():
        surface = rough_map(kind, 1, 1e-7, CONTACT)
        inner = surface.height[20:-20]
        assert inner.std() == pytest.approx(1e-7, rel=0.25)
        assert abs(surface.height[[0, -1]]).max() < 1e-12
        slope_x, slope_y = (np.diff(inner, axis=one).std() for one in (0, 1))
        assert (slope_x < 0.6 * slope_y) == (along > across)
        assert (slope_y < 0.6 * slope_x) == (across > along)
    again = rough_map("isotropic", 1, 1e-7, CONTACT)
    assert (again.height == rough_map("isotropic", 1, 1e-7, CONTACT).height).all()
    assert (again.height != rough_map("isotropic", 2, 1e-7, CONTACT).height).any()


def test_nothing_that_is_sure_to_touch_is_marched(tmp_path: Path) -> None:
    few = list(simulate.marches("ball", (0.05, 3.0)))
    assert {one.level for one in few} == {0.05}
    assert {one.motion for one in few} == set(simulate.MOTIONS)
    path = simulate.write_marches(tmp_path, "ball", 64, (0.05,))
    assert "fields_every = 2" in path.read_text(encoding="utf-8")
    rows = (tmp_path / "ball.csv").read_text(encoding="utf-8").splitlines()
    assert len(rows) == 1 + len(few)
    assert all(sweeps.surface_file(tmp_path, one.surface).is_file() for one in few)


def linear_march(march: simulate.March, film_m: float) -> xr.Dataset:
    """Return fields of a march that does exactly as predicted, and touches at one instant."""
    surface, y = march.predicted(), np.linspace(-1, 1, 21)
    a_m = march.bodies.conditions.semi_axis_a_m
    nx, ny = surface.height.shape
    step = surface.surface.step_x_m
    position = np.arange(nx)[::-1] * step
    middle = 0.5 * (ny - 1)
    rows = np.round(middle + y * a_m / step).astype(int)
    heights = surface.height[::-1][:, rows] / film_m
    x = np.linspace(-1, 1, 21)
    film = 0.3 * (1 - heights[:, :, None] + 0 * x)
    film = np.concatenate((np.full((1, 21, 21), 0.3), film))
    film[nx // 2] = 0.001
    time = np.arange(nx + 1.0)
    return xr.Dataset(
        {
            "film_over_time": (("field_time", "y", "x"), film),
            "surface_position_m": ("time", np.concatenate(([position[0] + step], position))),
        },
        coords={"field_time": time, "time": time, "x": x, "y": y},
    )


def test_a_march_that_does_as_predicted_has_no_error(monkeypatch: pytest.MonkeyPatch) -> None:
    march = next(simulate.marches("ball", (0.05,)))
    film_m = 0.3 * CONTACT.hertz_approach_c_m
    row = {"central_film": 0.3, "status": "converged", "seconds": 1.0, "case_id": "A"}
    fields = linear_march(march, film_m)
    monkeypatch.setattr(compare, "read_contact", lambda _: fields)
    found = compare._compare(march, row, Path())
    assert found["share_below"] == pytest.approx(1 / 115, rel=0.05)
    fields["film_over_time"][72] = fields["film_over_time"][71]
    found = compare._compare(march, row, Path())
    assert found["rq_marched"] == pytest.approx(found["rq_predicted"], rel=0.02)
    assert found["profile_error"] < 0.1
    assert found["share_below"] == 0
    stalled = compare._compare(march, row | {"status": "stalled"}, Path())
    assert "rq_marched" not in stalled


def made_up(growth: float = 0.3) -> pd.DataFrame:
    """Return marches whose Rq is a grid's 2 % and `growth` (amplitude/film)^2 below predictions."""
    rows = []
    for contact in simulate.CONTACTS:
        for level in (simulate.SMALL, 0.35, 0.6, 1.0):
            lowest = 1 - 1.3 * level
            rq = 0.5 * level
            rows.append(
                {
                    "contact": contact,
                    "motion": "eyring-1.1",
                    "lay": "isotropic",
                    "seed": 1,
                    "level": level,
                    "rq_over_film": level,
                    "status": "stalled" if (level, contact) == (1.0, "ball") else "converged",
                    "touches": lowest < 0,
                    "predicted_to_touch": lowest < 0,
                    "highest_predicted": 1 - lowest,
                    "stated_error": 0.05 + 0.5 * level**2,
                    "rq_marched": rq / (1.02 * (1 + 2 * growth * level**2)),
                    "rq_predicted": rq,
                    "mean_marched": 1.0,
                    "mean_linear": 0.99,
                    "rise": 0.01,
                    "profile_error": 0.1,
                    "lowest_marched": lowest_film(lowest, 0.4),
                    "lowest_predicted": lowest,
                    "share_below": 0.0,
                    "seconds": 1.0,
                }
            )
    return pd.DataFrame(rows)


def test_errors_grow_as_they_were_made_to_and_the_grid_has_no_part_in_it() -> None:
    base = 1 + 2 * 0.3 * simulate.SMALL**2
    table = judge.with_errors(made_up())
    np.testing.assert_allclose(
        (1 + table["rq_change"]) * base, 1 + 0.6 * table["level"] ** 2, rtol=1e-12
    )
    (row,) = judge.factors(made_up()).to_dict("records")
    assert float(row["rq_95"]) == pytest.approx(0.3, abs=0.003)
    assert float(row["mean_95"]) == 0
    touching = judge.touching(made_up())
    assert touching["marched"].sum() == 12
    assert touching["touch_somewhere"].to_list() == [0, 0, 0, 3]
    trusted = judge.trusted_table(made_up())
    assert trusted["rq_over_film"].to_list() == ["0.35", "0.6", "1"]
    assert trusted["not_finished"].to_list() == [0, 0, 1]


def test_the_width_of_lowest_films_is_found_and_holds_on_what_was_held_out() -> None:
    assert judge.fitted_width(made_up()) == pytest.approx(0.4)
    fitted, held_out = judge.lowest_table(made_up()).to_dict("records")
    assert (fitted["marched"], held_out["marched"]) == (5, 3)
    assert float(held_out["corrected_largest"]) < 0.001 < float(held_out["linear_largest"])


def test_errors_that_are_stated_too_small_are_counted() -> None:
    assert judge.uncovered(made_up(0.1)) == (0, 8)
    assert judge.uncovered(made_up(0.6))[0] > 0


def test_the_report_writes_what_it_says(tmp_path: Path) -> None:
    said = report.write_report(made_up(), tmp_path)
    assert "sliding, Ree-Eyring" in said
    for name in ("marches", "trusted", "factors", "lowest", "touching"):
        assert (tmp_path / f"{name}.csv").is_file()
    assert (tmp_path / "lambda.png").is_file()
    again = pd.read_csv(tmp_path / "marches.csv")
    assert len(again) == 12
    judge.trusted_table(again)


def test_the_lowest_film_is_that_of_a_smooth_surface_and_never_0() -> None:
    assert lowest_film(1.0) == pytest.approx(1.0)
    below = [lowest_film(one) for one in np.linspace(-0.4, 1, 20)]
    assert below == sorted(below)
    assert below[0] > 0
    assert lowest_film(0.0) == pytest.approx(LOWEST_WIDTH * np.log(2), abs=0.03)
