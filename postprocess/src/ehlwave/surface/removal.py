"""Gradient of the lambda ratio by the spectrum of a surface: which waves to remove first."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ehlwave.surface.amplitude import lowest_film_slope
from ehlwave.surface.statistics import FilmStatistics

Floats = NDArray[np.float64]

DIRECTIONS = ("transverse", "oblique", "longitudinal")
"""Angles between wave vector and rolling: 0 to 30, 30 to 60, 60 to 90 degrees."""
STEEPER = (math.tan(math.pi / 6), math.tan(math.pi / 3))
"""Ratio of the waves per metre along y and x at the ends of the first two."""
OCTAVE = 2.0
"""Longest over shortest wavelength of a band."""


@dataclass(frozen=True)
class Waves:
    """Waves of similar length and direction.

    Attributes
    ----------
    shortest_m, longest_m : float
        Wavelengths along the wave vector.
    direction : str
        ``"transverse"``: across rolling, ``"oblique"``, or ``"longitudinal"``: ridges along it.
    """

    shortest_m: float
    longest_m: float
    direction: str

    @property
    def text(self) -> str:
        """Return its lengths and direction for a report."""
        return f"{self.shortest_m * 1e6:.3g} to {self.longest_m * 1e6:.3g} um, {self.direction}"


@dataclass(frozen=True)
class Band(Waves):
    """Waves of similar length and direction, and their share in the film.

    Attributes
    ----------
    share_before, share_after : float
        Of the mean square of the heights before, and in the contact.
    gradient : float
        d ln(lambda ratio)/d ln(amplitude of these waves). Below 0: less of them raises lambda.
    lambda_without : float
        Lambda ratio without them.
    film_gradient : float or None
        d ln(smallest film)/d ln(amplitude of these waves), at the highest point of the deformed
        surface. None: there is no smallest film, or the map has more than 4 million points.
    """

    share_before: float
    share_after: float
    gradient: float
    lambda_without: float
    film_gradient: float | None = None


class Bands:
    """Mean squares before and after, and shares of the rise of the mean film, of all bands."""

    def __init__(self) -> None:
        """Begin with none."""
        self._sums: dict[tuple[int, int], Floats] = {}
        self._heights: dict[tuple[int, int], float] = {}

    def add(self, qx: Floats, qy: Floats, before: Floats, after: Floats, risen: Floats) -> None:
        """Add a block: waves per metre along x (rows) and y (columns), mean squares, m^2.

        Also the rises of the mean film times the film, m^2.
        """
        starts = _starts_of_bands(qx, qy)
        rows, columns = np.divmod(starts, qy.size)
        place, lowest = places_of_bands(qx[rows, 0], qy[0, columns])
        sums = [
            np.bincount(place, np.add.reduceat(part.ravel(), starts))
            for part in (before, after, risen)
        ]
        for one in np.flatnonzero(sums[0]):
            key = band_key(int(one), lowest)
            self._sums[key] = self._sums.get(key, np.zeros(3)) + [part[one] for part in sums]

    def add_heights(self, qx: Floats, qy: Floats, heights: Floats) -> None:
        """Add the heights of a block at the highest deformed point, m."""
        place, lowest = places_of_bands(qx, qy)
        sums = np.bincount(place, heights.ravel())
        for one in np.flatnonzero(sums):
            key = band_key(int(one), lowest)
            self._heights[key] = self._heights.get(key, 0.0) + float(sums[one])

    def gradients(self, statistics: FilmStatistics) -> list[Band]:
        """Return the bands, the one that lowers the lambda ratio most first.

        With the mean film h, smooth film plus rises, and the mean square m of the deformed heights,
        d ln(lambda)/d ln(A) = 2 rise/h - m_band/m. The smallest film is a function f of the mean
        film less the highest deformed point, :func:`ehlwave.surface.amplitude.lowest_film`; it
        changes by f' (2 rise - z_band).
        """
        ratio, film = statistics.lambda_ratio_after, statistics.mean_film_m
        sums = np.array(list(self._sums.values()))
        if ratio is None or film is None or not len(sums) or not sums[:, 1].sum() > 0:
            return []
        whole = sums.sum(axis=0)
        risen = 0.0  # averaged flow has no share of each band
        if statistics.mean_rise_by == "second order":
            risen = statistics.mean_rise_m or 0.0
        bands = []
        for (octave, turn), (before, after, rise) in self._sums.items():
            lift = risen * rise / whole[2] if whole[2] else 0.0
            rest = max(whole[1] - after, 0.0) / whole[1]
            without = (film - lift) / film / math.sqrt(rest) if rest > 0 else math.inf
            bands.append(
                Band(
                    shortest_m=OCTAVE**octave,
                    longest_m=OCTAVE ** (octave + 1),
                    direction=DIRECTIONS[turn],
                    share_before=float(before / whole[0]),
                    share_after=float(after / whole[1]),
                    gradient=float(2 * lift / film - after / whole[1]),
                    lambda_without=float(ratio * without),
                    film_gradient=self._film_gradient((octave, turn), lift, statistics),
                )
            )
        return sorted(bands, key=lambda band: band.gradient)

    def _film_gradient(
        self, key: tuple[int, int], lift: float, statistics: FilmStatistics
    ) -> float | None:
        smallest, mean = statistics.minimum_film_m, statistics.mean_film_m
        if smallest is None or mean is None or not self._heights:
            return None
        smooth = mean - (statistics.mean_rise_m or 0.0)
        slope = lowest_film_slope((mean - sum(self._heights.values())) / smooth)
        return slope * (2 * lift - self._heights.get(key, 0.0)) / smallest


def _starts_of_bands(qx: Floats, qy: Floats) -> NDArray[np.intp]:
    """Return the places in a block, row after row, where a band can begin; qy ascends from 0."""
    along, across = np.abs(qx), qy[0]
    longest, shortest = np.frexp([across[:2].max(), np.hypot(along.max(), across[-1])])[1]
    octaves = np.sqrt(np.maximum(OCTAVE ** (2.0 * np.arange(longest - 1, shortest)) - along**2, 0))
    columns = (
        np.zeros(along.shape, np.intp),
        np.searchsorted(across, octaves),
        np.searchsorted(across, along * STEEPER, side="right"),
    )
    starts = np.unique(np.concatenate(columns, 1) + np.arange(along.size)[:, None] * across.size)
    return starts[starts < along.size * across.size]


def places_of_bands(qx: Floats, qy: Floats) -> tuple[NDArray[np.intp], int]:
    """Return numbers of the bands of components, and the lowest octave, where they begin."""
    along, across = np.abs(qx), np.abs(qy)
    # Half the exponent of the square, rounded up; 2^octave: shortest wavelength.
    octave = -((np.frexp(along**2 + across**2)[1] + 1) >> 1)
    turn = sum((across > limit * along).astype(np.int8) for limit in STEEPER)
    lowest = int(octave.min())
    return (len(DIRECTIONS) * (octave - lowest) + turn).ravel(), lowest


def band_key(place: int, lowest: int) -> tuple[int, int]:
    """Return octave and direction of a band."""
    return place // len(DIRECTIONS) + lowest, place % len(DIRECTIONS)


def removal_text(bands: list[Band], most: int = 3, least: float = 0.02) -> list[str]:
    """Return lines of a report: the bands to remove first."""
    chosen = [band for band in bands[:most] if band.gradient < -least]
    return [
        f"{band.text}: 1 % less "
        f"amplitude gives {-band.gradient:.2g} % more lambda"
        + (
            f"; without them it is {band.lambda_without:.3g}"
            if math.isfinite(band.lambda_without) and band.lambda_without < 1e3
            else ""
        )
        for band in chosen
    ]


def film_text(bands: list[Band], least: float = 0.02) -> str:
    """Return a line of a report: the band that lowers the smallest film most; '' without any."""
    known = [band for band in bands if band.film_gradient is not None]
    if not known:
        return ""
    band = min(known, key=lambda one: one.film_gradient or 0.0)
    if not (band.film_gradient or 0.0) < -least:
        return ""
    return (
        f"{band.text}: 1 % less "
        f"amplitude gives {-(band.film_gradient or 0.0):.2g} % more smallest film"
    )
