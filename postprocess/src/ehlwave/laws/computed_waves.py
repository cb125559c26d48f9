"""Responses along a direction: computed waves, refined until their interpolation converges.

Waves lie evenly over ln wavelength. Those half-way between are computed next and compared with the
interpolation by the others, which gives its error; intervals with too large errors are halved.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from ehlwave.errors import ProgramError
from ehlwave.laws.atlas_transfer import SHORT_WAVE_POWER
from ehlwave.laws.transfer import Waves
from ehlwave.programs.computing import Result, is_usable

Complex = NDArray[np.complex128]
Rows = Callable[[Waves], Sequence[Result]]
"""Computes waves of one direction, by their wavelengths over a."""
Base = Callable[[Waves], Complex]
"""A law near the responses; only the differences are interpolated."""

FIRST = 7
"""Waves of the first set."""
MOST = 50
"""Waves along one direction."""
AMPLITUDE = 0.2
"""Ai over the film of the computed waves: only the rise of the mean film depends on it."""
HALVED = 4.0
"""Divisor of the error found half-way, for the interpolation through all waves. A cubic gains 16
where responses are smooth."""


@dataclass(frozen=True)
class Responses:
    """Responses along a direction, at computed waves.

    Attributes
    ----------
    log : array
        ln of the wavelengths over a, ascending.
    film, pressure : array of complex
        As of :class:`ehlwave.laws.answers.Response`.
    error : array
        Errors of the programs, absolute.
    between : array
        Errors of the interpolation in each interval.
    rise : array
        Rise of the mean film; NaN: not known.
    base : callable
        As of `Base`.
    """

    log: Waves
    film: Complex
    pressure: Complex
    error: Waves
    between: Waves
    rise: Waves
    base: Base

    def at(self, log: Waves) -> tuple[Complex, Complex, Waves, Waves]:
        """Return film, pressure, error and rise at ln wavelengths; ends are held outside."""
        inside = np.clip(log, self.log[0], self.log[-1])
        film = self.base(np.exp(inside)) + scipy.interpolate.CubicSpline(
            self.log, self.film - self._base
        )(inside)
        interval = np.clip(np.searchsorted(self.log, inside) - 1, 0, self.between.size - 1)
        error = np.interp(inside, self.log, self.error) + self.between[interval]
        pressure = np.full(inside.shape, complex(np.nan, np.nan))
        if np.all(np.isfinite(self.pressure)):  # marches do not have it
            pressure = scipy.interpolate.CubicSpline(self.log, self.pressure)(inside)
        return film, pressure, error, np.interp(inside, self.log, self.rise)

    @property
    def _base(self) -> Complex:
        return self.base(np.exp(self.log))


def no_base(waves: Waves) -> Complex:
    """Return 0."""
    return np.zeros(np.shape(waves), complex)


def refined(
    compute: Rows,
    ends: tuple[float, float],
    tolerance: float,
    bases: Sequence[Base] = (no_base,),
    most: int = MOST,
    first: int = FIRST,
) -> Responses:
    """Return responses with an interpolation error below a tolerance, where `most` waves do.

    Parameters
    ----------
    compute : callable
        As of `Rows`.
    ends : pair of float
        Shortest and longest wavelength, over a.
    tolerance : float
        Absolute error of the interpolation.
    bases : sequence of callable
        Of these the response with the smallest errors is taken.
    most : int
        Largest number of waves.
    first : int
        Number of waves of the first set.

    Raises
    ------
    ProgramError
        If waves inside the range cannot be computed.
    """
    log: Waves = np.linspace(np.log(ends[0]), np.log(ends[1]), first)
    rows = list(compute(np.exp(log)))
    between = np.full(first - 1, np.inf)
    base = bases[0]
    while log.size < most and np.any(between > tolerance):
        halves = np.flatnonzero(between > tolerance)[: most - log.size]
        middle = (log[halves] + log[halves + 1]) / 2
        new = list(compute(np.exp(middle)))
        values = np.array([film_of(row) for row in new])
        found = [abs(_between(log, rows, one, middle) - values) for one in bases]
        solved = np.isfinite(values)
        worst = [np.nan_to_num(one[solved], nan=np.inf).max(initial=0.0) for one in found]
        best = int(np.argmin(worst))
        base, errors = bases[best], found[best]
        log, rows, between = _merged(log, rows, between, middle, new, errors / HALVED, halves)
    return _known(log, rows, between, base)


def changed(found: Responses, change: Responses) -> Responses:
    """Return responses plus changes; beyond their waves the changes are continued.

    Shorter waves change less, with the power `SHORT_WAVE_POWER` of the wavelength. The error there
    is as large as the change.
    """
    log = np.union1d(
        found.log, change.log[(change.log > found.log[0]) & (change.log < found.log[-1])]
    )
    film, _, error, rise = found.at(log)
    add, _, more, _ = change.at(log)
    short, long = log < change.log[0] - 1e-9, log > change.log[-1] + 1e-9
    add = add * np.exp(np.minimum(log - change.log[0], 0.0) * SHORT_WAVE_POWER)
    return Responses(
        log=log,
        film=film + add,
        pressure=np.full(log.shape, complex(np.nan, np.nan)),
        error=error + np.where(short | long, np.abs(add), more),
        between=np.zeros(log.size - 1),
        rise=rise,
        base=found.base,
    )


def film_of(row: Result) -> complex:
    """Return the film response at mesh size 0, or on the grid itself without a coarser grid."""
    return _complex(row, "harmonic_extrapolated", "harmonic")


def _complex(row: Result, *names: str) -> complex:
    if not is_usable(row):
        return complex(np.nan, np.nan)
    for name in names:
        value = complex(_float(row, f"{name}_real"), _float(row, f"{name}_imaginary"))
        if np.isfinite(value):
            return value
    return complex(np.nan, np.nan)


def _float(row: Result, key: str) -> float:
    value = row.get(key)
    return np.nan if value is None else float(value)


def error_of(row: Result) -> float:
    """Return the error of a response by the program, absolute."""
    return _float(row, "error_estimate") * abs(film_of(row))


def _between(log: Waves, rows: Sequence[Result], base: Base, at: Waves) -> Complex:
    """Return the interpolation by the waves that could be computed."""
    film = np.array([film_of(row) for row in rows]) - base(np.exp(log))
    good = np.isfinite(film)
    if good.sum() < 4:
        return np.full(at.shape, np.nan, complex)
    return np.asarray(base(np.exp(at)) + scipy.interpolate.CubicSpline(log[good], film[good])(at))


def _merged(
    log: Waves,
    rows: list[Result],
    between: Waves,
    middle: Waves,
    new: list[Result],
    errors: Waves,
    halves: NDArray[np.intp],
) -> tuple[Waves, list[Result], Waves]:
    """Return waves, rows and errors of intervals with the halved intervals."""
    errors = np.nan_to_num(errors, nan=0.0)  # waves that cannot be computed are judged later
    between = between.copy()
    between[halves] = errors
    between = np.insert(between, halves, errors)
    order = np.argsort(np.append(log, middle), kind="stable")
    every = [*rows, *new]
    return np.append(log, middle)[order], [every[k] for k in order], between


def _known(log: Waves, rows: Sequence[Result], between: Waves, base: Base) -> Responses:
    """Return responses; waves at the ends that could not be computed are left out.

    Raises ProgramError for those inside.
    """
    film = np.array([film_of(row) for row in rows])
    good = np.isfinite(film)
    first, last = (0, -1) if not good.any() else np.flatnonzero(good)[[0, -1]]
    if good.sum() < 4 or not good[first : last + 1].all():
        worst = next(row for row in rows if not np.isfinite(film_of(row)))
        reason = worst.get("message") or f"{worst.get('status')}: not resolved"
        raise ProgramError(
            f"ehlwave-sweep: {int((~good).sum())} of {len(rows)} waves were not solved: {reason}"
        )
    part = slice(first, last + 1)
    kept = list(rows)[part]
    names = "harmonic_pressure_extrapolated", "harmonic_pressure"
    rise = [_float(row, "mean_film_rise") for row in kept]
    return Responses(
        log=log[part],
        film=film[part],
        pressure=np.array([_complex(row, *names) for row in kept]),
        error=np.array([error_of(row) for row in kept]),
        between=between[first:last],
        rise=np.array(rise) / AMPLITUDE,
        base=base,
    )
