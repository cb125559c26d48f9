"""The atlas against computations of conditions that it has not seen."""

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave.laws.atlas import Atlas
from ehlwave.laws.atlas.chart import Chart
from studies.atlas.points import contact_of, film_numbers, waves_of
from studies.sweeps import Row

Floats = NDArray[np.float64]

FILMS = ("central film, relative", "smallest film, relative", "friction, relative")


@dataclass(frozen=True)
class Judged:
    """Errors and error bars: of film responses, units of Ai, and of films, relative.

    Films have shape (contacts, films).
    """

    response: Floats
    response_bar: Floats
    film: Floats
    film_bar: Floats
    load: Floats

    def text(self) -> str:
        """Return the summary for readers: shares within the bars, median, 95th percentile."""
        return "\n".join(
            f"{name}: {len(error)} conditions, {100 * np.mean(error <= bar):.1f} % within the bar, "
            f"median {np.median(error):.4f} (of the bar {np.median(bar):.4f}), "
            f"95 % {np.quantile(error, 0.95):.4f}, largest {error.max():.3f}"
            for name, error, bar in self._parts()
        )

    def rows(self, of: str) -> list[Row]:
        """Return the summary as rows of a table, `of` the judged quantity."""
        return [
            {
                "of": of,
                "what": name,
                "conditions": len(error),
                "within the bar [%]": round(100 * float(np.mean(error <= bar)), 1),
                "median": float(np.median(error)),
                "median bar": float(np.median(bar)),
                "95 %": float(np.quantile(error, 0.95)),
                "largest": float(error.max()),
            }
            for name, error, bar in self._parts()
        ]

    def _parts(self) -> list[tuple[str, Floats, Floats]]:
        heavy = self.load > 100
        parts = [
            ("film response, units of Ai", self.response, self.response_bar),
            ("film response, M > 100", self.response[heavy], self.response_bar[heavy]),
            *zip(FILMS, self.film.T, self.film_bar.T, strict=False),
        ]
        return [part for part in parts if len(part[1])]


def judge(atlas: Atlas, computed: xr.Dataset) -> Judged:
    """Return the errors of an atlas at points of :func:`studies.atlas.points.read_points`."""
    of_contact, (wave, angle) = contact_of(computed), waves_of(computed)
    response, films = computed["film"].values, film_numbers(computed, atlas.kind.films)
    error, bar = np.zeros(of_contact.size), np.zeros(of_contact.size)
    film_error, film_bar = [], []
    for contact in range(computed.sizes["contact"]):
        chart = atlas.at({key: float(computed[key].values[contact]) for key in atlas.kind.ranges})
        missed = chart.film_numbers - films[contact]
        film_error.append(_relative(missed)[: len(_bars(chart))])
        film_bar.append(_bars(chart))
        own = np.flatnonzero(of_contact == contact)
        found = chart.responses(wave[own], angle[own])
        error[own], bar[own] = np.abs(found.film - response[own]), found.error
    load = computed["load_parameter_m"].values[of_contact]
    return Judged(error, bar, np.array(film_error), np.array(film_bar), load)


def _relative(left: Floats) -> list[float]:
    """Return the relative errors of films from errors of logarithms, as a kind names them."""
    return [abs(float(np.expm1(log))) for log in (left[0], left[0] + left[1], *left[2:3])]


def _bars(chart: Chart) -> list[float]:
    film = chart.film()
    stress = [] if film.stress_error is None else [film.stress_error]
    return [film.central_error, film.minimum_error, *stress]
