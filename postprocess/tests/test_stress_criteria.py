"""Criteria: invariants against eigenvalues, smallest balls, Dang Van, life."""

import numpy as np
import pytest
import xarray as xr
from scipy.optimize import minimize

from ehlwave.errors import StressError
from ehlwave.stress import (
    COMPONENTS,
    dang_van_factor,
    dang_van_path,
    fatigue_shear,
    hydrostatic,
    largest,
    largest_shear,
    life_integral_ratio,
    life_ratio,
    share_at_risk,
    von_mises,
)
from ehlwave.stress.enclosing import enclosing_balls


def random_stress(seed: int, shape: tuple[int, ...]) -> dict[str, np.ndarray]:
    values = np.random.default_rng(seed).normal(size=(6, *shape))
    return dict(zip(COMPONENTS, values, strict=True))


def eigenvalues(stress: dict[str, np.ndarray]) -> np.ndarray:
    xx, yy, zz, xy, yz, xz = (stress[name] for name in COMPONENTS)
    tensor = np.stack([xx, xy, xz, xy, yy, yz, xz, yz, zz], axis=-1)
    return np.linalg.eigvalsh(tensor.reshape(*xx.shape, 3, 3))


def test_invariants_are_those_of_the_principal_stresses() -> None:
    stress = random_stress(1, (500,))
    for name in COMPONENTS:  # among them: zero, hydrostatic, a single shear
        stress[name][:3] = 0
    for name in ("sxx", "syy", "szz"):
        stress[name][1] = 2
    stress["sxz"][2] = 3
    low, mid, high = eigenvalues(stress).T
    np.testing.assert_allclose(largest_shear(stress), (high - low) / 2, atol=1e-7)
    mises = np.sqrt(((high - mid) ** 2 + (mid - low) ** 2 + (high - low) ** 2) / 2)
    np.testing.assert_allclose(von_mises(stress), mises, atol=1e-12)
    np.testing.assert_allclose(hydrostatic(stress), (low + mid + high) / 3, atol=1e-12)


def test_the_largest_lies_between_points() -> None:
    z, x = np.array([0.0, 0.1, 0.3, 0.6]), np.linspace(-1, 1, 21)
    field = xr.DataArray(
        5 - 3 * (z[:, None] - 0.22) ** 2 - (x + 0.33) ** 2, coords={"z": z, "x": x}, dims=("z", "x")
    )
    found = largest(field)
    assert (found.value, found.depth_m, found.x_m) == pytest.approx((5, 0.22, -0.33))


@pytest.mark.parametrize("dimensions", [1, 2, 3, 5])
def test_balls_are_the_smallest(dimensions: int) -> None:
    points = np.random.default_rng(dimensions).normal(size=(12, 30, dimensions))
    found = enclosing_balls(points)
    away = np.linalg.norm(points - found.centre[:, None], axis=2)
    np.testing.assert_allclose(away.max(axis=1), found.radius, rtol=1e-9)
    for one, radius in zip(points, found.radius, strict=True):

        def room(v: np.ndarray, one: np.ndarray = one) -> np.ndarray:
            return v[-1] - np.sum((one - v[:-1]) ** 2, axis=1)

        start = np.append(one.mean(axis=0), 100.0)
        best = minimize(
            lambda v: v[-1],
            start,
            constraints={"type": "ineq", "fun": room},
            method="SLSQP",
            options={"ftol": 1e-12, "maxiter": 500},
        )
        assert radius == pytest.approx(np.sqrt(best.x[-1]), rel=1e-5)


def test_balls_of_circles_lines_and_single_points() -> None:
    turn = np.linspace(0, 2 * np.pi, 49)
    circle, line = np.zeros((2, 49, 5))
    circle[:, 0], circle[:, 3] = 3 + np.cos(turn), np.sin(turn)
    line[:, 2] = turn
    balls = enclosing_balls(np.stack([circle, line, np.ones((49, 5))]))
    np.testing.assert_allclose(balls.radius, [1, np.pi, 0], atol=1e-9)
    np.testing.assert_allclose(balls.centre[0], [3, 0, 0, 0, 0], atol=1e-9)
    np.testing.assert_allclose(balls.centre[1, 2], np.pi)
    assert enclosing_balls(np.ones((2, 1, 5))).radius.tolist() == [0, 0]


def closed_history(s: float, t: float, count: int = 2001) -> xr.Dataset:
    """Return sx = s (cos wt - 1), txy = t sin wt."""
    turn = np.linspace(0, 2 * np.pi, count)
    none = np.zeros(count)
    parts = (s * (np.cos(turn) - 1), none, none, t * np.sin(turn), none, none)
    return xr.Dataset({name: ("time", part) for name, part in zip(COMPONENTS, parts, strict=True)})


@pytest.mark.parametrize(("s", "t"), [(600e6, 0), (600e6, 250e6), (0, 300e6), (400e6, 500e6)])
def test_dang_van_of_the_closed_case(s: float, t: float) -> None:
    turn = np.linspace(0, 2 * np.pi, 2001)
    shear = 0.5 * np.sqrt(s**2 * np.cos(turn) ** 2 + 4 * t**2 * np.sin(turn) ** 2)
    pressure = s / 3 * (np.cos(turn) - 1)
    path = dang_van_path(closed_history(s, t))
    np.testing.assert_allclose(path.shear, shear, atol=1e3)
    np.testing.assert_allclose(path.hydrostatic, pressure, atol=1e-3)
    limit = float(fatigue_shear(1e8))
    expected = np.max(shear / (limit - 0.232 * pressure))
    assert float(dang_van_factor(closed_history(s, t), limit)) == pytest.approx(expected, rel=1e-5)


def test_a_path_has_no_direction_and_steady_stress_counts_by_its_pressure_alone() -> None:
    history = random_stress(4, (15, 6))
    turned = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
    xx, yy, zz, xy, yz, xz = (history[name] for name in COMPONENTS)
    tensor = np.stack([xx, xy, xz, xy, yy, yz, xz, yz, zz], axis=-1).reshape(15, 6, 3, 3)
    other = np.einsum("ai,...ij,bj->...ab", turned, tensor, turned)
    places = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
    rotated = {name: other[..., i, j] for name, (i, j) in zip(COMPONENTS, places, strict=True)}
    found = dang_van_factor(history, 4.0)
    np.testing.assert_allclose(found, dang_van_factor(rotated, 4.0), rtol=1e-7)
    steady = {name: np.repeat(history[name][:1], 4, axis=0) for name in COMPONENTS}
    np.testing.assert_allclose(dang_van_factor(steady, 4.0), 0, atol=1e-12)
    lasting = {name: history[name] + steady[name][:1] for name in COMPONENTS}
    np.testing.assert_allclose(
        dang_van_path(lasting).shear, dang_van_path(history).shear, atol=1e-9
    )


def test_dang_van_over_a_map_is_that_of_each_point() -> None:
    values = random_stress(8, (3, 4, 20))
    history = xr.Dataset({n: (("z", "x", "time"), v) for n, v in values.items()})
    found = dang_van_factor(history, 5.0)
    assert found.dims == ("z", "x")
    one = {name: values[name][2, 1] for name in COMPONENTS}
    assert float(found[2, 1]) == pytest.approx(float(dang_van_factor(one, 5.0)), rel=1e-12)
    limit = float(found.quantile(0.4))
    assert share_at_risk(found / limit) == float((found.max("z") >= limit).mean())


def test_tension_beyond_the_strength_is_infinite() -> None:
    pulled = {name: np.array([0.0, 10.0 if name == "sxx" else 0.0]) for name in COMPONENTS}
    assert dang_van_factor(pulled, 0.5) == np.inf


def test_bearing_steel_and_bad_input() -> None:
    assert float(fatigue_shear(1)) == pytest.approx(1220e6 / 3**0.5)
    assert float(fatigue_shear(1e8)) == pytest.approx((1220 - 43 * np.log(1e8)) * 1e6 / 3**0.5)
    for cycles in (0, 1e13):
        with pytest.raises(StressError, match="cycles"):
            fatigue_shear(cycles)
    with pytest.raises(StressError, match="no sxx"):
        dang_van_factor({}, 1.0)
    with pytest.raises(StressError, match="no dimension phase"):
        dang_van_factor(closed_history(1, 1), 1.0, dim="phase")


def test_life_follows_from_the_integral() -> None:
    z, x = np.linspace(0, 1, 101), np.arange(5.0)
    profile = np.where(z > 0, 1.0, 50.0)[:, None] * np.ones(5)
    smooth = xr.DataArray(profile, coords={"z": z, "x": x}, dims=("z", "x"))
    assert life_integral_ratio(1.1 * smooth, smooth) == pytest.approx(1.1 ** (31 / 3))
    assert life_ratio(2.0) == pytest.approx(2 ** (-9 / 10))
    # At half the depths, each stress weighs 2^h as much, over half the thickness.
    near = smooth.assign_coords(z=z / 2)
    assert life_integral_ratio(near, smooth) == pytest.approx(2 ** (7 / 3 - 1))
    half = xr.where(smooth["x"] < 2, smooth, 0.0).transpose("z", "x")
    assert life_integral_ratio(half, smooth) == pytest.approx(0.4)
    assert life_integral_ratio(smooth, 0.9 * smooth, limit_pa=0.95) == np.inf
    assert life_integral_ratio(smooth, smooth, limit_pa=60.0) == 1
