"""Two rough surfaces in a contact, each as deformed there: the film between them.

They pass each other, so their phases are free: mean squares of their heights add, and no product of
the two is left in the mean film.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from ehlwave.errors import SurfaceError
from ehlwave.shown import Shown, micrometres, within
from ehlwave.surface.amplitude import expected_nonlinearity, lowest_film, validated_amplitude
from ehlwave.surface.predict import Deformed
from ehlwave.surface.two_surfaces import FilmOfTwo, film_of_two


@dataclass(frozen=True)
class PairStatistics:
    """Roughness of both surfaces together, and the film between them, m.

    Attributes
    ----------
    rq_before_m, rq_after_m : float
        Root of the sum of both mean squares.
    mean_film_m : float
        The smooth central film and the rise by either surface, where that is used.
    minimum_film_m : float or None
        At the highest deformed points of both, by :func:`ehlwave.surface.amplitude.lowest_film`;
        None where these are above the mean film.
    surfaces_touch : bool
        Whether they are.
    lambda_ratio_before, lambda_ratio_after : float
        Mean film over Rq before and after.
    lambda_errors : dict of float or None
        Relative errors of `lambda_ratio_after` by name, as in
        :class:`ehlwave.surface.statistics.FilmStatistics`, as bounds: errors of a surface offset
        none of the other. None: a transfer has no errors.
    lambda_error : float or None
        Their sum.
    amplitude_over_film : float
        sqrt(2) Rq of both before, over the smooth film.
    extrapolated : bool
        Whether that is above the amplitudes that predictions were compared with.
    """

    rq_before_m: float
    rq_after_m: float
    mean_film_m: float
    minimum_film_m: float | None
    surfaces_touch: bool
    lambda_ratio_before: float
    lambda_ratio_after: float
    lambda_errors: dict[str, float] | None
    lambda_error: float | None
    amplitude_over_film: float
    extrapolated: bool


@dataclass(frozen=True, repr=False)
class DeformedPair(Shown):
    """Two surfaces inside a contact.

    Attributes
    ----------
    first, second : Deformed
        Each by itself; their slip parameters are S and 2 - S.
    """

    first: Deformed
    second: Deformed

    def _shown_rows(self) -> dict[str, str]:
        """Return the statistics of both."""
        s = self.statistics
        return {
            "surfaces": f"{self.first.surface.name}, {self.second.surface.name}",
            "lambda ratio": within(s.lambda_ratio_after, s.lambda_error),
            "mean film": micrometres(s.mean_film_m),
            "Rq": f"{micrometres(s.rq_before_m)} before, {micrometres(s.rq_after_m)} after",
        }

    @cached_property
    def statistics(self) -> PairStatistics:
        """Roughness and film of both together.

        Raises
        ------
        SurfaceError
            If the film thickness is not known.
        """
        return pair_statistics(self.first, self.second)

    @cached_property
    def film(self) -> FilmOfTwo:
        """Film at the contact centre while both pass, their leading ends together."""
        return film_of_two(self.first, self.second)

    @property
    def doubts(self) -> list[str]:
        """Return why numbers are extrapolated, or missing; reasons for both together at the end."""
        found = [doubt for one in (self.first, self.second) for doubt in one.doubts]
        if self.first.conditions.central_film_m is None:
            return found
        s = self.statistics
        if s.extrapolated and not any(doubt.startswith("extrapolated") for doubt in found):
            limit = validated_amplitude(self.first.conditions)
            found.append(
                f"extrapolated: the amplitude of both surfaces, sqrt(2) Rq, is "
                f"{s.amplitude_over_film:.2g} of the film, above {limit:g}, the largest that "
                "predictions were compared with; the mean film is the smooth one"
            )
        if s.surfaces_touch and not any(doubt.startswith("the surfaces touch") for doubt in found):
            found.append(
                "the surfaces touch: where the highest points of both meet no film is left; how "
                "they touch the prediction does not describe"
            )
        return found


def pair_statistics(first: Deformed, second: Deformed) -> PairStatistics:
    """Return the statistics of two deformed surfaces that pass each other.

    Raises
    ------
    SurfaceError
        If the film thickness is not known.
    """
    both = (first, second)
    film = first.conditions.central_film_m
    if film is None:
        raise SurfaceError("the film thickness is unknown: give central_film_m or radius_x_m")
    before, after = (
        math.hypot(*(getattr(one.statistics, name) for one in both))
        for name in ("rq_before_m", "rq_after_m")
    )
    amplitude = math.sqrt(2) * before / film
    extrapolated = any(amplitude > validated_amplitude(one.conditions) for one in both)
    rises = [one.statistics.mean_rise_m or 0.0 for one in both]
    mean = film if extrapolated else film + sum(rises)
    least = (mean - sum(float(one.height.max()) for one in both)) / film
    unused = sum(map(abs, rises)) / film if extrapolated else 0.0
    errors = _errors(both, amplitude, unused)
    return PairStatistics(
        rq_before_m=before,
        rq_after_m=after,
        mean_film_m=mean,
        minimum_film_m=lowest_film(least) * film if least > 0 else None,
        surfaces_touch=least <= 0,
        lambda_ratio_before=mean / before if before > 0 else math.inf,
        lambda_ratio_after=mean / after if after > 0 else math.inf,
        lambda_errors=errors,
        lambda_error=None if errors is None else sum(errors.values()),
        amplitude_over_film=amplitude,
        extrapolated=extrapolated,
    )


def _errors(both: Sequence[Deformed], amplitude: float, unused: float) -> dict[str, float] | None:
    """Return relative errors of the lambda ratio; `unused`: rises over the film, left out."""
    known = [one.statistics.lambda_errors for one in both]
    squares = [one.statistics.rq_after_m**2 for one in both]
    first, second = known
    if first is None or second is None:
        return None
    # d ln(Rq) is the mean of d ln(Rq) of either, weighed by its mean square.
    shares = [one / (sum(squares) or 1.0) for one in squares]
    responses = sum(
        share * errors["responses"]
        for share, errors in zip(shares, (first, second), strict=True)
        if share > 0
    )
    nonlinear = [expected_nonlinearity(one.conditions, amplitude) for one in both]
    return {
        "film": first["film"],
        "responses": responses,
        "amplitude": sum(a * b for a, b in zip(shares, nonlinear, strict=True)),
        "rise": first["rise"] + second["rise"] + unused,
    }
