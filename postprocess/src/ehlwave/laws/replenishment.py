"""Film of a starved track over time, where no oil comes back: overrollings and slow side flow.

Equation numbers refer to ``src/theory.md``. Two losses are included: oil that the inlet pushes
aside at every overrolling (C5), and oil that the pressure in the contact drives to the sides (C6),
(C7). Films of contacts in series follow both together (C9).

Not in here: oil that comes back, by bleeding of the grease or by flow into the track.
"""

from dataclasses import dataclass

import numpy as np
import pandas as pd
import scipy
from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.formula import power_ratio
from ehlwave.contact.oils import DENSITY_LIMIT, DENSITY_PA, Oil, log_viscosity
from ehlwave.contact.starvation import FILM_RANGES, film_sharpness
from ehlwave.error_bars import bar
from ehlwave.errors import SurfaceError
from ehlwave.laws.starved_transfer import check_starved

Floats = NDArray[np.float64]

SHARPNESS_ERROR = bar("replenishment.sharpness")
"""Relative error of g. R at r = 1 is then off by more than its error bar."""
TIME_FACTOR = bar("replenishment.time")
"""Measured films decay that much faster or slower than by (C6)."""
POINTS = 61
PIECES = 2000
"""Pieces of a track, at most, on each of which g and the film behind are constant."""
MOST_OVERROLLINGS = 1e12
FILMS = ("inlet", "side_flow", "film_over_flooded")
"""Columns of films over the flooded one: by either loss alone, and by both."""


@dataclass(frozen=True)
class Track:
    """Parameters of films over time besides r."""

    conditions: Conditions
    """Conditions of the starved contact, from dimensional data."""
    length_m: float
    """Length of the tracks of both bodies together, m."""

    def __post_init__(self) -> None:
        """Refuse contacts without film in metres or viscosity, or with another oil."""
        c = self.conditions
        if not c.is_starved:
            raise SurfaceError(
                "oil_over_flooded is missing: give the oil of the first overrolling over the oil "
                "that the flooded contact passes, such as 0.5"
            )
        check_starved(c)
        if "viscosity_pa_s" not in dict(c.given) or c.central_film_m is None:
            raise SurfaceError(
                "films over time need dimensional conditions (viscosity_pa_s, ...), not M, L and D"
            )
        if c.oil.other_laws:
            laws = ", ".join(c.oil.other_laws)
            raise SurfaceError(f"{laws}: films over time are known with Roelands' oil alone")
        if not (np.isfinite(self.length_m) and self.length_m > 2 * c.semi_axis_a_m):
            raise SurfaceError(
                f"track length = {self.length_m:g} m must exceed the contact's, "
                f"{2 * c.semi_axis_a_m:.3g} m: give both tracks together"
            )

    @property
    def period_s(self) -> float:
        """Mean time between overrollings, s: half of the length over the mean speed."""
        return self.length_m / (2 * float(dict(self.conditions.given)["mean_speed_m_per_s"]))

    @property
    def flooded_film_m(self) -> float:
        """Central film of the flooded contact, m."""
        c = self.conditions
        return float(c.central_film_m or np.nan) / c.film_ratio

    @property
    def side_flow_per_s(self) -> float:
        """Return k of R^-2 = R0^-2 + k t, 1/s: (C6) in units of the flooded film."""
        c = self.conditions
        layer = float(density(c.hertz_pa)) * self.flooded_film_m
        across = c.hertz_pa / c.semi_axis_b_m**2 * c.semi_axis_a_m
        fluidity = fluidity_integral(c.oil, c.hertz_pa) / float(dict(c.given)["viscosity_pa_s"])
        return 2 / self.length_m * across * fluidity * layer**2 / 6


def density(pressure_pa: ArrayLike) -> Floats:
    """Return the density over that at ambient pressure, by Dowson and Higginson."""
    p = np.asarray(pressure_pa, dtype=np.float64)
    return np.asarray((DENSITY_PA + DENSITY_LIMIT * p) / (DENSITY_PA + p))


def fluidity_integral(oil: Oil, hertz_pa: float) -> float:
    """Return the integral of 1/(rho^2 eta) over theta from 0 to pi at P = ph sin(theta), (C7).

    rho and eta are over those at ambient pressure; pi of an oil that pressure does not change.

    Examples
    --------
    >>> from ehlwave.contact import Oil
    >>> from ehlwave.laws.replenishment import fluidity_integral
    >>> f"{fluidity_integral(Oil(), 1e3):.3f}, {fluidity_integral(Oil(), 1e9):.3f}"
    '3.142, 0.093'
    """

    def integrand(theta: float) -> float:
        p = hertz_pa * np.sin(theta)
        log_eta = log_viscosity(oil.pressure_viscosity_per_pa, oil.roelands_index, p)
        return float(np.exp(-log_eta) / density(p) ** 2)

    end = min(np.pi / 2, 200 / max(oil.pressure_viscosity_per_pa * hertz_pa, 1e-9))
    ends, middle = (
        scipy.integrate.quad(integrand, 0, end)[0],
        scipy.integrate.quad(integrand, end, np.pi / 2)[0],
    )
    return float(2 * (ends + middle))


def after_overrollings(start: ArrayLike, overrollings: ArrayLike, sharpness: float) -> Floats:
    """Return r of n overrollings without replenishment, (r0^-g + n)^(-1/g), (C5), g constant.

    Parameters
    ----------
    start, overrollings : array_like
        r0, and n.
    sharpness : float
        g.

    Examples
    --------
    >>> from ehlwave.laws.replenishment import after_overrollings
    >>> after_overrollings(0.5, [0, 10, 1000], 4).round(3).tolist()
    [0.5, 0.443, 0.177]
    """
    r, n = np.asarray(start, dtype=np.float64), np.asarray(overrollings, dtype=np.float64)
    return np.asarray((r**-sharpness + n) ** (-1 / sharpness))


def overrolled(conditions: Conditions, overrollings: NDArray[np.int64], factor: float) -> Floats:
    """Return r of overrollings, each by the law for R with `factor` times its g.

    Below the range of the law the closed form goes on, with g of its end.
    """
    c, least = conditions, FILM_RANGES["r"][0]
    r, n, known = float(c.oil_over_flooded or 1), 0, [float(c.oil_over_flooded or 1)]
    while r >= least and n < overrollings.max():
        r, n = float(power_ratio(1 / r, factor * film_sharpness(r, c.m, c.l, c.d))), n + 1
        known.append(r)
    beyond = np.maximum(overrollings - n, 0)
    g = float(factor * film_sharpness(least, c.m, c.l, c.d))
    return np.where(
        overrollings <= n,
        np.array(known)[np.minimum(overrollings, n)],
        after_overrollings(r, beyond, g),
    )


def side_flow(film: ArrayLike, growth: ArrayLike) -> Floats:
    """Return R after a side flow by which R^-2 grows, (C6).

    Parameters
    ----------
    film : array_like
        R before.
    growth : array_like
        Of R^-2.

    Examples
    --------
    >>> from ehlwave.laws.replenishment import side_flow
    >>> side_flow(0.5, [0, 12]).tolist()
    [0.5, 0.25]
    """
    return np.asarray((np.asarray(film, dtype=np.float64) ** -2 + np.asarray(growth)) ** -0.5)


def by_both_losses(
    conditions: Conditions, overrollings: NDArray[np.int64], growth: float, factor: float = 1.0
) -> Floats:
    """Return R of overrollings by both losses, (C9).

    Half of the side flow is upstream of the centre. The inlet and this half remove oil there; the
    law for R has both, and the larger loss counts; the other half follows. Many overrollings are
    taken at once where little changes.

    Parameters
    ----------
    conditions : Conditions
        With ``oil_over_flooded``at the first overrolling.
    overrollings : array_like
        Which, in order, from 1.
    growth : float
        Of R^-2 by the side flow in an overrolling.
    factor : float
        Of g of the law for R.
    """
    c, film, done = conditions, float(conditions.film_ratio), 1
    most = int(np.max(overrollings))
    steps = np.unique(np.geomspace(1, most, PIECES).round().astype(np.int64))
    known = {}
    for n in np.union1d(steps, overrollings):
        left = int(n) - done
        if left > 0:
            behind = float(side_flow(film, growth / 2 * left))
            r = min(max(behind, FILM_RANGES["r"][0]), FILM_RANGES["r"][1])
            g = float(factor * film_sharpness(r, c.m, c.l, c.d))
            sides = float(side_flow(behind, growth / 2 * left))
            film = min(float(after_overrollings(behind, left, g)), sides)
            done = int(n)
        known[int(n)] = film
    return np.array([known[int(n)] for n in overrollings])


def replenish(conditions: Conditions, track_length_m: float, overrollings: float) -> pd.DataFrame:
    """Return films over overrollings and time where no oil comes back to the track.

    Parameters
    ----------
    conditions : Conditions
        Dimensional, with ``oil_over_flooded``at the first overrolling.
    track_length_m : float
        Length of the tracks of both bodies together, of a contact, m.
    overrollings : float
        How many, at least 2.

    Returns
    -------
    pandas.DataFrame
        ``overrollings``, ``time_s`` since the first; film over the flooded film by overrollings
        alone (``inlet``), by side flow alone (``side_flow``) and by both losses
        (``film_over_flooded``), each with ``_low`` and ``_high``; ``film_m``; ``is_inside``:
        whether films by the inlet and by both are in the range of r of the law for R.

    Raises
    ------
    SurfaceError
        If the conditions have no film in metres, or something makes no sense.

    Examples
    --------
    >>> import ehlwave
    >>> from ehlwave.laws.replenishment import replenish
    >>> contact = ehlwave.Contact(radius_x_m=0.0127, radius_y_m=0.0127,
    ...     reduced_modulus_pa=2.26e11, load_n=120,
    ...     mean_speed_m_per_s=4, viscosity_pa_s=0.05, oil_over_flooded=0.5)
    >>> table = replenish(contact.conditions, track_length_m=0.3, overrollings=100)
    >>> table[["overrollings", "inlet"]].iloc[[0, -1]].round(2).to_numpy().tolist()
    [[1.0, 0.48], [100.0, 0.26]]
    """
    if not 2 <= overrollings <= MOST_OVERROLLINGS:
        raise SurfaceError(
            f"overrollings = {overrollings:g} must lie in 2 to {MOST_OVERROLLINGS:g}"
        )
    track = Track(conditions, track_length_m)
    n = np.unique(np.geomspace(1, overrollings, POINTS).round().astype(np.int64))
    time = (n - 1) * track.period_s
    columns: dict[str, NDArray[np.generic]] = {"overrollings": n, "time_s": time}
    for end, g, t in (
        ("", 1.0, 1.0),
        ("_low", 1 - SHARPNESS_ERROR, TIME_FACTOR),
        ("_high", 1 + SHARPNESS_ERROR, 1 / TIME_FACTOR),
    ):
        columns[f"inlet{end}"] = overrolled(conditions, n, g)
        spent = track.side_flow_per_s * t * time
        columns[f"side_flow{end}"] = side_flow(conditions.film_ratio, spent)
        growth = track.side_flow_per_s * t * track.period_s
        columns[f"film_over_flooded{end}"] = by_both_losses(conditions, n, growth, g)
    table = pd.DataFrame(columns)
    for name in FILMS:  # none is known better than R of the first overrolling
        least, most = (table[name] * (1 + sign * conditions.starvation_error) for sign in (-1, 1))
        table[f"{name}_low"] = np.minimum(table[f"{name}_low"], least)
        table[f"{name}_high"] = np.maximum(table[f"{name}_high"], most)
    table["film_m"] = table["film_over_flooded"] * track.flooded_film_m
    table["is_inside"] = table[["inlet", "film_over_flooded"]].min(axis=1) >= FILM_RANGES["r"][0]
    return table
