"""Stresses below Hertz contacts: transforms against closed forms, and the rows of the table."""

import csv
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from ehlwave.stress import (
    COMPONENTS,
    hertz_axis_stress,
    hertz_circle_stress,
    hertz_line_stress,
    hertz_pressure,
    largest,
    largest_shear,
    orthogonal_shear,
    stress_below,
    von_mises,
)

REFERENCE = Path(__file__).parents[2] / "tests" / "verification" / "reference" / "stress.csv"
POINTS = 256


def numbers(load: str) -> list[dict[str, float]]:
    with REFERENCE.open(newline="") as file:
        rows = [row for row in csv.DictReader(file) if row.pop("load") == load]
    return [{key: float(value) for key, value in row.items() if value} for row in rows]


def grid(half: float, points: int = POINTS) -> tuple[np.ndarray, float]:
    step = 2 * half / points
    return (np.arange(points) - points // 2) * step, step


@pytest.mark.parametrize("row", numbers("wave"), ids=str)
def test_waves_of_the_table(row: dict[str, float]) -> None:
    wave = np.cos(2 * np.pi * np.arange(128) / 128)
    below = stress_below(
        wave,
        (1 / 128, 1),
        np.linspace(0, 0.4, 161),
        traction_x_pa=row["friction"] * wave,
        periodic=True,
    )
    check(below, row)


@pytest.mark.parametrize("row", numbers("cross_waves"), ids=str)
def test_cross_waves_of_the_table(row: dict[str, float]) -> None:
    wave = np.cos(2 * np.pi * np.arange(64) / 64)
    pressure = wave[:, None] * wave
    below = stress_below(
        pressure,
        (1 / 64, 1 / 64),
        np.linspace(0, 0.2, 81),
        traction_x_pa=row["friction"] * pressure,
        periodic=True,
    )
    check(below, row)


def check(below: xr.Dataset, row: dict[str, float]) -> None:
    found = largest(von_mises(below))
    assert found.value == pytest.approx(row["von_mises"], abs=1e-3)
    assert found.depth_m == pytest.approx(row["depth"], abs=1e-3)
    assert largest(largest_shear(below)).value == pytest.approx(row["largest_shear"], abs=1e-3)


def test_line_of_the_table() -> None:
    (row,) = numbers("hertz_line")
    x, step = grid(2.0, 4096)
    pressure = xr.DataArray(hertz_pressure(x, 0, 1), coords={"x": x}, dims="x")
    below = stress_below(pressure, (step, 1), np.linspace(0.3, 1, 141))
    axis = below.isel(x=[x.size // 2])
    mises, shear = largest(von_mises(axis)), largest(largest_shear(axis))
    assert mises.value == pytest.approx(row["von_mises"], rel=1e-3)
    assert mises.depth_m == pytest.approx(row["depth"], rel=1e-3)
    assert shear.value == pytest.approx(row["largest_shear"], rel=1e-3)
    assert shear.depth_m == pytest.approx(row["shear_depth"], rel=1e-3)
    orthogonal = largest(orthogonal_shear(below))
    assert orthogonal.value == pytest.approx(row["orthogonal_shear"], rel=1e-3)
    assert abs(orthogonal.x_m) == pytest.approx(row["orthogonal_x"], abs=1e-3)
    assert orthogonal.depth_m == pytest.approx(row["orthogonal_depth"], rel=1e-3)


def test_circle_of_the_table() -> None:
    (row,) = numbers("hertz_circle")
    x, step = grid(1.5)
    pressure = hertz_pressure(x[:, None], x[None, :], 1, 1)
    axis = stress_below(pressure, (step, step), np.linspace(0.4, 0.56, 17)).isel(x=[128], y=[128])
    mises = largest(von_mises(axis))
    assert mises.value == pytest.approx(row["von_mises"], rel=1e-3)
    assert mises.depth_m == pytest.approx(row["depth"], abs=1e-3)
    assert largest(largest_shear(axis)).value == pytest.approx(row["largest_shear"], rel=1e-3)
    # A tip in the field: the grid has a point on the edge.
    x, step = grid(1.25, 320)
    assert x[np.argmin(np.abs(x - 1))] == pytest.approx(1)
    pressure = hertz_pressure(x[:, None], x[None, :], 1, 1)
    top = stress_below(pressure, (step, step), 0.0)["sxx"].isel(z=0, y=x.size // 2)
    assert float(top[np.argmin(np.abs(x - 1))]) == pytest.approx(row["tension"], abs=1e-3)


@pytest.mark.parametrize(("half", "nu"), [(1.5, 0.3), (2.0, 0.22), (2.5, 0.3)])
def test_circle(half: float, nu: float) -> None:
    x, step = grid(half)
    depths = np.array([0.1, 0.25, 0.48, 1, 2])
    pressure = hertz_pressure(x[:, None], x[None, :], 1, 1)
    found = stress_below(pressure, (step, step), depths, poisson_ratio=nu)
    exact = hertz_circle_stress(x[None, :, None], x[None, None], depths[:, None, None], 1, 1, nu)
    for name in COMPONENTS:
        np.testing.assert_allclose(found[name], exact[name], atol=5e-3, err_msg=name)
    np.testing.assert_allclose(
        von_mises(found)[:, 128, 128], von_mises(exact)[:, 128, 128], rtol=5e-3
    )


@pytest.mark.parametrize("friction", [0.0, 0.1, -0.3])
def test_line(friction: float) -> None:
    x, step = grid(2.0)
    depths = np.array([0.1, 0.3, 0.7, 1.5])
    pressure = hertz_pressure(x, 0, 1)
    found = stress_below(pressure, (step, 1), depths, traction_x_pa=friction * pressure)
    exact = hertz_line_stress(x[None, :], depths[:, None], 1, 1, friction)
    for name in COMPONENTS:
        np.testing.assert_allclose(found[name][:, :, 0], exact[name], atol=5e-3, err_msg=name)


@pytest.mark.parametrize("b", [3.0, 0.4, 1.00001])
def test_ellipse(b: float) -> None:
    x, step = grid(1.6)
    y = x * b
    depths = np.array([0.0, 0.1, 0.3, 0.6, 1, 2]) * min(1, b)
    found = stress_below(hertz_pressure(x[:, None], y[None, :], 1, b), (step, step * b), depths)
    exact = hertz_axis_stress(depths, 1, b)
    axis = found.isel(x=128, y=128)
    for name in COMPONENTS:
        np.testing.assert_allclose(axis[name], exact[name], atol=1e-3, err_msg=name)
    np.testing.assert_allclose(von_mises(axis), von_mises(exact), rtol=5e-3)


def test_closed_forms_agree_where_they_meet() -> None:
    depths = np.array([0.0, 0.2, 0.7, 2])
    circle = hertz_circle_stress(0, 0, depths, 1)
    nearly = hertz_axis_stress(depths, 1, 1.001)
    slender = hertz_axis_stress(depths, 1, 1e4)
    line = hertz_line_stress(0, depths, 1)
    for name in COMPONENTS:
        np.testing.assert_allclose(nearly[name], circle[name], atol=2e-3)
        np.testing.assert_allclose(slender[name], line[name], atol=1e-3)
