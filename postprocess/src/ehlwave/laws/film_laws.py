"""The list of laws of films without heat: the first that holds for a contact answers."""

from collections.abc import Callable
from dataclasses import dataclass

from ehlwave.contact.conditions import Conditions
from ehlwave.laws.atlas.chart import Chart, SmoothFilm
from ehlwave.laws.rigid_films import SOURCE as RIGID
from ehlwave.laws.rigid_films import is_rigid, rigid_film

ChartAt = Callable[[float], Chart]
"""Chart of a contact at a slip parameter; raises RangeError outside the atlas."""


@dataclass(frozen=True)
class FilmLaw:
    """A source of films: whether it holds at a slip parameter, and its films with their source."""

    name: str
    holds: Callable[[Conditions, float], bool]
    film: Callable[[Conditions, float, ChartAt], tuple[SmoothFilm, str]]


def _rigid(c: Conditions, _slip: float, _chart_at: ChartAt) -> tuple[SmoothFilm, str]:
    return rigid_film(c), RIGID


def _atlas(_c: Conditions, slip: float, chart_at: ChartAt) -> tuple[SmoothFilm, str]:
    chart = chart_at(slip)
    return chart.film(), chart.film_source


LIST = (
    FilmLaw("rigid", lambda c, slip: slip == 1 and is_rigid(c), _rigid),
    FilmLaw("atlas", lambda _c, _slip: True, _atlas),
)
"""All laws, in the order in which they are asked; the last refuses contacts outside its range."""


def smooth_film(c: Conditions, slip: float, chart_at: ChartAt) -> tuple[SmoothFilm, str]:
    """Return the films of the first law that holds, and its source.

    Parameters
    ----------
    c : Conditions
        Of the contact.
    slip : float
        Slip parameter of the film.
    chart_at : callable
        Chart of the atlas at a slip parameter.

    Raises
    ------
    RangeError
        If no law holds.
    """
    law = next(law for law in LIST if law.holds(c, slip))
    return law.film(c, slip, chart_at)
