"""Transfers of large maps by polynomials, against the transfers themselves."""

import numpy as np
import pytest

import ehlwave
from ehlwave.surface.removal import Bands, places_of_bands
from ehlwave.surface.sampled import NODES, Sampled

KEYS = {
    "radius_x_m": 0.0127,
    "radius_y_m": 0.0127,
    "reduced_modulus_pa": 2.26e11,
    "load_n": 40.0,
    "mean_speed_m_per_s": 1.0,
    "viscosity_pa_s": 0.05,
}
HEAT = ehlwave.Heat(313.15, 0.04, 0.14, 2000, 870)
SLIDING = {"slip_parameter": 1.3, "eyring_stress_pa": 5e6}
ROWS = [0, 1, 40, 150, 560, -3, -560]


@pytest.mark.parametrize("more", [{}, SLIDING, SLIDING | {"heat": HEAT}])
@pytest.mark.parametrize("count", [700, 2048])
def test_polynomials_are_as_near_as_the_table_of_responses(more: dict, count: int) -> None:
    transfer = ehlwave.Contact(**KEYS, **more).transfer()
    across = np.arange(count) / (2 * count * 1e-6)
    sampled = Sampled(transfer, across)
    for row in ROWS:
        along = np.full((1, 1), row / (2 * 2048e-6))
        for name in ("ratio", "error", "rise"):
            found = getattr(sampled, name)(along, across[None, :])
            expected = getattr(transfer, name)(along, across[None, :])
            np.testing.assert_allclose(found, expected, rtol=0, atol=3e-4 if more else 1e-5)
        found = sampled.is_covered(along, across[None, :])
        np.testing.assert_array_equal(found, transfer.is_covered(along, across[None, :]))


@pytest.mark.parametrize("inner", [1, NODES, NODES + 1])
def test_few_long_waves_are_evaluated_one_by_one(inner: int) -> None:
    transfer = ehlwave.Contact(**KEYS).transfer()
    across = (np.arange(20 * inner) + 0.5) * transfer.smooth_from / inner
    across[0] = 0.0
    along = np.full((1, 1), transfer.smooth_from / 3)
    sampled = Sampled(transfer, across)
    found = sampled.ratio(along, across[None, :])
    np.testing.assert_array_equal(
        found[:, :inner], transfer.ratio(along, across[None, :])[:, :inner]
    )
    np.testing.assert_allclose(found, transfer.ratio(along, across[None, :]), rtol=0, atol=1e-5)


@pytest.mark.parametrize("steps", [(1e-6, 1e-6), (3e-6, 0.7e-6)])
@pytest.mark.parametrize("shape", [(40, 300), (33, 1), (8, 8)])
def test_bands_have_the_sums_of_their_waves(shape: tuple, steps: tuple) -> None:
    along = np.fft.fftfreq(shape[0], steps[0])[:, None]
    across = np.fft.rfftfreq(2 * shape[1] - 1, steps[1])[None, :]
    values = np.random.default_rng(2).random((3, *shape))
    bands = Bands()
    bands.add(along, across, *values)
    place, lowest = places_of_bands(along, across)
    expected = [np.bincount(place, part.ravel()) for part in values]
    assert len(bands._sums) == np.count_nonzero(expected[0])
    for (octave, turn), sums in bands._sums.items():
        one = 3 * (octave - lowest) + turn
        np.testing.assert_allclose(sums, [part[one] for part in expected], rtol=1e-12)
