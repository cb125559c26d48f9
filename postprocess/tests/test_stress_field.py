"""Stresses below loads: single waves, equilibrium, loads that end, axes and bad input."""

import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray

from ehlwave.errors import StressError
from ehlwave.stress import COMPONENTS, stress_below, wave_stress

Floats = NDArray[np.float64]

POINTS, STEPS = (48, 40), (0.5e-6, 0.8e-6)
DEPTHS = np.array([0.0, 0.4e-6, 2e-6, 9e-6])


def closed_wave(
    a: float, b: float, p: float, q: float, nu: float, grid: tuple[Floats, Floats, Floats]
) -> dict[str, Floats]:
    """Return the stresses below p cos(ax) cos(by) and traction q cos(ax) cos(by) along x."""
    x, y, z = grid
    k = np.hypot(a, b)
    decay = np.exp(-k * z)
    ca, sa, cb, sb = np.cos(a * x), np.sin(a * x), np.cos(b * y), np.sin(b * y)
    one = a**2 / k**2 - a**2 * z / k + 2 * nu * b**2 / k**2
    two = b**2 / k**2 - b**2 * z / k + 2 * nu * a**2 / k**2
    compression = {
        "sxx": p * one * ca * cb + q * a / k * (2 + 2 * nu * b**2 / k**2 - a**2 * z / k) * sa * cb,
        "syy": p * two * ca * cb + q * a / k * (2 * nu * a**2 / k**2 - b**2 * z / k) * sa * cb,
        "szz": p * (1 + k * z) * ca * cb + q * a * z * sa * cb,
        "sxy": -p * a * b / k**2 * (1 - 2 * nu - k * z) * sa * sb
        + q * b / k * (1 - 2 * nu * a**2 / k**2 - a**2 * z / k) * ca * sb,
        "syz": p * b * z * ca * sb + q * a * b / k * z * sa * sb,
        "sxz": p * a * z * sa * cb + q * (1 - a**2 * z / k) * ca * cb,
    }
    return {name: -value * decay for name, value in compression.items()}


def places() -> tuple[Floats, Floats]:
    x, y = (step * np.arange(n) for step, n in zip(STEPS, POINTS, strict=True))
    return x[:, None], y[None, :]


@pytest.mark.parametrize("waves", [(3, 0), (0, 2), (2, 5), (5, 1)])
@pytest.mark.parametrize(("friction", "nu"), [(0.0, 0.3), (0.12, 0.3), (-0.3, 0.22), (0.3, 0.5)])
def test_single_waves_are_the_closed_forms(
    waves: tuple[int, int], friction: float, nu: float
) -> None:
    x, y = places()
    a, b = (2 * np.pi * w / (n * h) for w, n, h in zip(waves, POINTS, STEPS, strict=True))
    pressure = 1e9 * np.cos(a * x) * np.cos(b * y)
    found = stress_below(
        pressure, STEPS, DEPTHS, traction_x_pa=friction * pressure, poisson_ratio=nu, periodic=True
    )
    exact = closed_wave(a, b, 1e9, friction * 1e9, nu, (x, y, DEPTHS[:, None, None]))
    for name in COMPONENTS:
        np.testing.assert_allclose(found[name].values, exact[name], atol=1e-12 * 1e9, err_msg=name)


def random_loads(seed: int) -> dict[str, Floats]:
    """Return loads without the shortest waves, whose derivatives are not on the grid."""
    loads = {}
    for kind in ("pressure_pa", "traction_x_pa", "traction_y_pa"):
        spectrum = np.fft.fft2(np.random.default_rng(seed).normal(size=POINTS))
        spectrum[16:-15], spectrum[:, 14:-13] = 0, 0
        loads[kind], seed = np.fft.ifft2(spectrum).real, seed + 1
    return loads


def test_the_field_is_in_equilibrium_by_spectral_derivatives() -> None:
    # Derivatives along z: of the polynomials through Chebyshev points.
    nodes = np.cos(np.pi * (np.arange(40) + 0.5) / 40)
    depth, half = 1e-6 * (1 + nodes), 1e-6
    order = np.argsort(depth)
    loads = random_loads(5)
    pressure = loads.pop("pressure_pa")
    found = stress_below(pressure, STEPS, depth[order], periodic=True, **loads)

    def along(name: str, axis: int) -> Floats:
        wave = 2j * np.pi * np.fft.fftfreq(POINTS[axis], STEPS[axis])
        shape = [1, 1, 1]
        shape[axis + 1] = -1
        spectrum = np.fft.fft(found[name].values, axis=axis + 1) * wave.reshape(shape)
        return np.fft.ifft(spectrum, axis=axis + 1).real

    def down(name: str) -> Floats:
        at = nodes[order]
        series = np.polynomial.chebyshev.chebfit(at, found[name].values.reshape(at.size, -1), 39)
        slope = np.polynomial.chebyshev.chebder(series)
        return np.polynomial.chebyshev.chebval(at, slope).T.reshape(found[name].shape) / half

    scale = np.abs(along("sxx", 0)).max()
    for axis in "xyz":
        names = ["s" + "".join(sorted(axis + other)) for other in "xyz"]
        balance = along(names[0], 0) + along(names[1], 1) + down(names[2])
        assert np.abs(balance).max() < 1e-9 * scale, axis


def test_the_surface_bears_the_loads() -> None:
    loads = random_loads(1)
    pressure = loads.pop("pressure_pa")
    for periodic in (True, False):
        top = stress_below(pressure, STEPS, 0.0, periodic=periodic, **loads).isel(z=0)
        # Images of a load that ends are removed by interpolation: to a share of 1e-4.
        close = 1e-12 if periodic else 1e-3
        np.testing.assert_allclose(top["szz"], -pressure, atol=close)
        np.testing.assert_allclose(top["sxz"], -loads["traction_x_pa"], atol=close)
        np.testing.assert_allclose(top["syz"], -loads["traction_y_pa"], atol=close)


def test_exchanging_the_axes_exchanges_the_stresses() -> None:
    loads = random_loads(9)
    here = stress_below(loads["pressure_pa"], STEPS, DEPTHS, traction_x_pa=loads["traction_x_pa"])
    there = stress_below(
        loads["pressure_pa"].T, STEPS[::-1], DEPTHS, traction_y_pa=loads["traction_x_pa"].T
    )
    other = {"sxx": "syy", "syy": "sxx", "szz": "szz", "sxy": "sxy", "syz": "sxz", "sxz": "syz"}
    for name, turned in other.items():
        np.testing.assert_allclose(here[name], there[turned].values.transpose(0, 2, 1), atol=1e-10)


def test_a_load_that_ends_does_not_feel_its_images() -> None:
    """Boussinesq: far below a patch the stress equals a point force's, on any grid."""
    for points in (16, 33, 96):
        pressure = np.zeros((points, points + 4))
        pressure[:3, :3] = 1.0  # in a corner: its nearest images are at its side
        h = 1e-6
        depth, force = 12e-6, 9 * h**2
        found = stress_below(pressure, (h, h), depth, poisson_ratio=0.3).isel(x=1, y=1, z=0)
        normal = -3 * force / (2 * np.pi * depth**2)
        lateral = (1 - 0.6) * force / (4 * np.pi * depth**2)
        # The force is spread: the next term of the series is 5 (w/z)^2 of a width w.
        assert float(found["szz"]) == pytest.approx(normal, rel=0.03)
        assert float(found["sxx"]) == pytest.approx(lateral, abs=0.03 * abs(normal))


def test_a_strip_is_a_plane_of_strain_and_may_repeat_along_y() -> None:
    x = np.linspace(-3, 3, 121) * 1e-4
    pressure = np.maximum(1 - (x / 1e-4) ** 2, 0) ** 1.5
    step = x[1] - x[0]
    depths = [0.0, 0.5e-4, 1e-4]
    one = stress_below(pressure, (step, np.nan), depths)
    repeated = stress_below(
        np.repeat(pressure[:, None], 12, axis=1), (step, 2e-5), depths, periodic=(False, True)
    )
    for name in COMPONENTS:
        np.testing.assert_allclose(one[name], repeated[name].isel(y=[5]), atol=1e-6)
    np.testing.assert_allclose(one["syy"], 0.3 * (one["sxx"] + one["szz"]), atol=1e-12)


def test_a_mean_that_repeats_is_borne_without_lateral_strain() -> None:
    found = stress_below(np.full((8, 6), 2e6), (1e-6, 1e-6), [0, 1e-5], periodic=True)
    np.testing.assert_allclose(found["szz"], -2e6)
    np.testing.assert_allclose(found["sxx"], -2e6 * 0.3 / 0.7)
    np.testing.assert_allclose(found["syy"], -2e6 * 0.3 / 0.7)


def test_data_arrays_go_by_the_names_of_their_dimensions() -> None:
    x, y = places()
    pressure = np.exp(-((x / 6e-6 - 2) ** 2) - (y / 9e-6 - 1) ** 2)
    coordinates = {"x": x[:, 0] - 3e-6, "y": y[0]}
    array = xr.DataArray(pressure.T, dims=("y", "x"), coords=coordinates)
    plain = stress_below(pressure, STEPS, DEPTHS, traction_x_pa=0.1 * pressure)
    named = stress_below(array, STEPS, DEPTHS, traction_x_pa=0.1 * array)
    assert named["sxx"].dims == ("z", "x", "y")
    for name in COMPONENTS:
        np.testing.assert_array_equal(named[name], plain[name])
    np.testing.assert_array_equal(named["x"], coordinates["x"])
    over_a = array.assign_coords(x=coordinates["x"] / 1e-4)
    np.testing.assert_array_equal(stress_below(over_a, STEPS, 0)["x"], plain["x"])


def test_waves_that_decay_along_the_surface_are_in_equilibrium() -> None:
    a, b, nu, depth = 2 + 0.7j, 1.3, 0.3, 0.4
    for load in ("pressure_pa", "traction_x_pa", "traction_y_pa"):
        step = 1e-5
        at, up, down = (wave_stress(load, a, b, depth + d, nu) for d in (0, step, -step))
        for axis in "xyz":
            names = ["s" + "".join(sorted(axis + other)) for other in "xyz"]
            slope = (up[names[2]] - down[names[2]]) / (2 * step)
            assert abs(1j * a * at[names[0]] + 1j * b * at[names[1]] + slope) < 1e-8


@pytest.mark.parametrize(
    ("change", "part"),
    [
        ({"pressure_pa": np.full((4, 4), np.nan)}, "pressure_pa: 16 of 16 values are not finite"),
        ({"pressure_pa": np.ones((4, 4, 2))}, "pressure_pa: has the shape"),
        ({"pressure_pa": np.ones((4, 4), complex)}, "pressure_pa: holds complex128"),
        ({"pressure_pa": None}, "give a pressure or a traction"),
        ({"pressure_pa": xr.DataArray(np.ones((2, 4, 4)), dims=("time", "y", "x"))}, "dimension t"),
        ({"traction_x_pa": np.ones((4, 5))}, "shapes differ"),
        ({"steps_m": (1e-6, 0)}, "step along y is 0"),
        ({"steps_m": (1, 2, 3)}, "give the steps"),
        ({"depths_m": [-1e-6]}, "depths_m"),
        ({"depths_m": []}, "depths_m"),
        ({"poisson_ratio": 0.7}, "poisson_ratio = 0.7"),
    ],
)
def test_bad_input_is_named(change: dict[str, object], part: str) -> None:
    arguments = {"pressure_pa": np.ones((4, 4)), "steps_m": (1e-6, 1e-6), "depths_m": [0.0]}
    with pytest.raises(StressError, match=part):
        stress_below(**(arguments | change))
