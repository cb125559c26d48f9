"""The atlas against computations of conditions that it has not seen."""

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave.atlas import Atlas
from ehlwave.atlas.stored import contact_of, waves_of

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Judged:
    """Errors and error bars: of film responses, units of Ai, and of central films, relative."""

    response: Floats
    response_bar: Floats
    film: Floats
    film_bar: Floats
    load: Floats

    def text(self) -> str:
        """Return what a reader wants to know: shares within the bars, median, 95th percentile."""
        heavy = self.load > 100
        rows = [
            ("film response, units of Ai", self.response, self.response_bar),
            ("film response, M > 100", self.response[heavy], self.response_bar[heavy]),
            ("central film, relative", self.film, self.film_bar),
        ]
        return "\n".join(
            f"{name}: {len(error)} conditions, {100 * np.mean(error <= bar):.1f} % within the bar, "
            f"median {np.median(error):.4f} (of the bar {np.median(bar):.4f}), "
            f"95 % {np.quantile(error, 0.95):.4f}, largest {error.max():.3f}"
            for name, error, bar in rows
        )


def judge(atlas: Atlas, computed: xr.Dataset) -> Judged:
    """Return the errors of an atlas at points of :func:`studies.atlas.points.read_points`."""
    of_contact = contact_of(computed)
    error, bar = np.zeros(of_contact.size), np.zeros(of_contact.size)
    film_error, film_bar = [], []
    for contact in range(computed.sizes["contact"]):
        keys = {name: float(computed[name].values[contact]) for name in atlas.kind.ranges}
        chart = atlas.at(keys)
        film_error.append(
            abs(np.expm1(chart.film_numbers()[0] - computed["film_ratio"].values[contact]))
        )
        film_bar.append(chart.film().central_error)
        own = np.flatnonzero(of_contact == contact)
        part = computed.isel(point=own)
        found = chart.responses(*waves_of(part))
        response = part["film_real"].values + 1j * part["film_imaginary"].values
        error[own], bar[own] = np.abs(found.film - response), found.error
    load = computed["load_parameter_m"].values[of_contact]
    return Judged(error, bar, np.array(film_error), np.array(film_bar), load)
