"""Film and pressure over a contact with rough surfaces."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave.errors import StressError
from ehlwave.stress.hertz import hertz_pressure
from ehlwave.stress.passage import edge_factor
from ehlwave.surface.predict import Deformed
from ehlwave.surface.ripple import hertz_pressure_of
from ehlwave.surface.rough_pressure import Ripple, ripple_of

Floats = NDArray[np.float64]


def contact_fields(
    surfaces: Sequence[Deformed],
    rolled_m: float = 0.0,
    points: tuple[int, int] = (257, 129),
    reach: float = 1.25,
) -> xr.Dataset:
    """Return film and pressure over the contact at one time: smooth fields and ripple.

    Parameters
    ----------
    surfaces : sequence of Deformed
        A rough surface, or both: from :meth:`ehlwave.Contact.deform`, the second of a contact with
        2 - S.
    rolled_m : float
        How far the mean speed has come since the first points of the surfaces were at the centre.
    points : pair of int
        Of the grid along x and y.
    reach : float
        Half of the grid, in semi-axes.

    Returns
    -------
    xarray.Dataset
        ``pressure_pa`` and ``film_m`` over (x, y) in m, 0 the contact centre: the pressure is the
        Hertz pressure plus the ripple, never below 0; the film is the mean film plus the ripple, of
        the inside of the contact (NaN outside).
    """
    conditions = surfaces[0].conditions
    film = conditions.central_film_m
    if film is None:
        raise StressError("the film thickness is unknown: give central_film_m or radius_x_m")
    a, b = conditions.semi_axis_a_m, conditions.semi_axis_b_m
    x = reach * a * np.linspace(-1, 1, points[0])
    y = np.zeros(1) if conditions.is_line else reach * b * np.linspace(-1, 1, points[1])
    inside = edge_factor(x[:, None] / a, y / b)
    pressure = hertz_pressure(x[:, None], y[None, :], a, b, hertz_pressure_of(conditions))
    gap = np.full(pressure.shape, film)
    for deformed in surfaces:
        of_pressure, of_film = _over_contact(ripple_of(deformed), x, y, rolled_m)
        pressure += inside * of_pressure
        gap += of_film
        gap += (deformed.statistics.mean_film_m or film) - film
    return xr.Dataset(
        {
            "pressure_pa": (("x", "y"), np.maximum(pressure, 0), {"units": "Pa"}),
            "film_m": (("x", "y"), np.where(inside > 0, gap, np.nan), {"units": "m"}),
        },
        coords={"x": ("x", x, {"units": "m"}), "y": ("y", y, {"units": "m"})},
    )


def _over_contact(ripple: Ripple, x: Floats, y: Floats, rolled_m: float) -> tuple[Floats, Floats]:
    """Return the ripple of pressure and of film over a grid, without its fall to the edge."""
    waves = ripple.waves
    twice = np.where(waves.number_x > 0, 2.0, 1.0)
    phase = ripple.amplitude * twice * np.exp(-1j * waves.number_x * ripple.slip * rolled_m)
    middle = ripple.lines_m[ripple.lines_m.size // 2]
    across = np.exp(1j * np.outer(waves.number_y[0], y + middle))
    pressure, film = np.empty((2, x.size, y.size))
    for i, place in enumerate(x):
        pressure[i] = ((waves.at(place) * phase).sum(axis=0) @ across).real
        film[i] = ((waves.film_at(place) * phase).sum(axis=0) @ across).real
    return pressure, film
