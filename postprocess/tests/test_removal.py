"""Gradient of the lambda ratio by the spectrum, against surfaces without some of their waves."""

import numpy as np
import pytest

import ehlwave
from ehlwave.surface import removal_figure, trace_surface
from ehlwave.surface.removal import removal_text

CONTACT = ehlwave.Contact(
    radius_x_m=0.0127,
    radius_y_m=0.0127,
    reduced_modulus_pa=2.26e11,
    load_n=40,
    mean_speed_m_per_s=4,
    viscosity_pa_s=0.05,
)
LONG_M, SHORT_M = 2.4e-4, 2e-5


def waves(long_m: float, short_m: float) -> ehlwave.surface.Surface:
    """Return a trace of two waves with these amplitudes; whole periods."""
    x = np.arange(0, 2.4e-3, 1e-6)
    height = long_m * np.cos(2 * np.pi * x / LONG_M) + short_m * np.cos(2 * np.pi * x / SHORT_M)
    return trace_surface(height, step_m=1e-6, axis="x", name="waves")


def ratio(long_m: float, short_m: float) -> float:
    found = CONTACT.deform(waves(long_m, short_m), form="none", ends="none")
    return float(found.statistics.lambda_ratio_after)


def test_gradient_is_the_change_of_lambda() -> None:
    found = CONTACT.deform(waves(80e-9, 40e-9), form="none", ends="none")
    bands = {band.shortest_m < LONG_M / 2: band for band in found.bands if band.share_before > 0.01}
    step = 1e-3
    for is_short, change in ((False, (step, 0.0)), (True, (0.0, step))):
        up, down = (
            ratio(80e-9 * (1 + side * change[0]), 40e-9 * (1 + side * change[1]))
            for side in (1, -1)
        )
        expected = (np.log(up) - np.log(down)) / (2 * step)
        assert bands[is_short].gradient == pytest.approx(expected, rel=2e-3, abs=1e-4)
    assert bands[True].lambda_without == pytest.approx(ratio(80e-9, 0.0), rel=2e-3)
    assert bands[False].lambda_without == pytest.approx(ratio(0.0, 40e-9), rel=2e-3)
    total = sum(band.share_after for band in found.bands)
    assert total == pytest.approx(1)


def test_report_names_the_worst_band() -> None:
    """The contact flattens the long wave: the short one, of less amplitude, counts more."""
    found = CONTACT.deform(waves(40e-9, 38e-9), form="none", ends="none")
    assert found.bands[0].shortest_m < SHORT_M < found.bands[0].longest_m
    assert "transverse" in removal_text(found.bands)[0]


@pytest.mark.parametrize("ends", ["none", "mirror"])
def test_film_gradient_is_the_change_of_the_smallest_film(ends: str) -> None:
    """Waves whose crests meet: each lowers the smallest film by its deformed amplitude."""
    given = {"form": "none", "ends": ends}
    found = CONTACT.deform(waves(80e-9, 40e-9), **given)
    step = 1e-4
    for is_short, change in ((False, (step, 0.0)), (True, (0.0, step))):
        up, down = (
            CONTACT.deform(
                waves(80e-9 * (1 + side * change[0]), 40e-9 * (1 + side * change[1])), **given
            ).statistics.minimum_film_m
            for side in (1, -1)
        )
        expected = (np.log(up) - np.log(down)) / (2 * step)
        own = [band for band in found.bands if (band.shortest_m < LONG_M / 4) == is_short]
        total = sum(band.film_gradient for band in own)
        assert total == pytest.approx(expected, rel=5e-3, abs=2e-3)


def test_figure_has_the_bands() -> None:
    """The bars of all directions add up to the gradients."""
    found = CONTACT.deform(waves(80e-9, 40e-9), form="none", ends="none")
    ratios, films = removal_figure(found.bands).axes
    heights = [bar.get_height() for bar in ratios.patches]
    assert sum(heights) == pytest.approx(sum(band.gradient for band in found.bands))
    lowest = min(bar.get_height() for bar in films.patches)
    assert lowest == pytest.approx(min(band.film_gradient for band in found.bands))
    assert min(heights) == pytest.approx(found.bands[0].gradient)


def test_directions_of_a_map() -> None:
    x, y = np.arange(0, 4e-4, 4e-6)[None, :], np.arange(0, 4e-4, 4e-6)[:, None]
    height = 20e-9 * np.cos(2 * np.pi * x / 4e-5) + 40e-9 * np.cos(2 * np.pi * y / 4e-5)
    found = CONTACT.deform(height, form="none", ends="none", step=4e-6)
    shares = {band.direction: band.share_before for band in found.bands if band.share_before > 0.01}
    assert shares == pytest.approx({"transverse": 0.2, "longitudinal": 0.8}, abs=0.01)
