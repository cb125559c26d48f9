"""The list of laws: which source answers for a contact, and why the others do not.

Every door of the package asks here: films, responses, surfaces, stresses, commands and the page.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from dataclasses import dataclass, replace

from ehlwave.choices import LAWS, chosen
from ehlwave.contact.conditions import Conditions
from ehlwave.duals import math
from ehlwave.errors import ProgramError, RangeError, SurfaceError, see
from ehlwave.inputs.slip import RATIO, ratio_of
from ehlwave.laws.answers import Film
from ehlwave.laws.asked import Asked
from ehlwave.laws.atlas.ranges import SLIDING_RANGES
from ehlwave.laws.atlas_transfer import AtlasTransfer
from ehlwave.laws.film_answer import film_of, with_film
from ehlwave.laws.notices import notices_of
from ehlwave.laws.sheared_ridges import ShearedRidges
from ehlwave.laws.standing_waves import StandingRidges
from ehlwave.laws.starved_transfer import StarvedTransfer
from ehlwave.laws.transfer import FormulaTransfer, RecommendedTransfer, Transfer
from ehlwave.laws.two_wave_transfer import TwoWaveTransfer
from ehlwave.laws.warm_waves import (
    BEYOND,
    MORE_ERROR,
    MOST_NEWTONIAN,
    WarmTransfer,
    thinner,
    warmth_of,
)
from ehlwave.programs.case_input import case_keys, case_text
from ehlwave.programs.programs import has_programs

SLIPS = SLIDING_RANGES["slip_parameter"]
"""Slip parameters for which the law of the two waves answers unasked."""


@dataclass(frozen=True)
class Law:
    """A source of responses: its name, its transfer, and whether it answers unasked."""

    name: str
    transfer: Callable[[Asked], Transfer]
    """Transfer for a contact; raises RangeError with the reasons where the law does not hold."""
    is_unasked: bool = True
    is_for_starved: bool = False
    is_isothermal: bool = True


def _table(asked: Asked) -> Transfer:
    if asked.table is None:
        raise RangeError("there is no harmonic table: give table=, the name of its file")
    from ehlwave.laws.table import TableTransfer

    return TableTransfer(asked.conditions, asked.table.rows, asked.table.name)


def _starved(asked: Asked) -> Transfer:
    return StarvedTransfer(asked.conditions)


def _atlas(asked: Asked) -> Transfer:
    return AtlasTransfer(asked.conditions, asked.atlas())


def _two_waves(asked: Asked) -> Transfer:
    """Return the law of the two waves about the film of the atlas."""
    c, (low, high) = asked.conditions, SLIPS
    slip = c.slip_parameter
    if slip == 1:
        raise RangeError("the law of the two waves is for contacts that slide")
    if not low <= slip <= high:
        raise RangeError(
            f"slip_parameter = {slip:g} ({RATIO} = {ratio_of(slip):g}) lies outside {low:g} to "
            f"{high:g}, where the law of the two waves is known to hold"
        )
    # The film without heat; outside the atlas of sliding contacts the film of rolling.
    own = asked.cold()
    film = film_for(own.at_slip(1.0) if c.has_sliding_atlas else own, "laws")
    c = with_film(c, film)
    transfer = TwoWaveTransfer(c)
    if reasons := transfer.reasons():
        raise RangeError("; ".join(reasons))
    return transfer


def _warm_computed(asked: Asked) -> Transfer:
    """Return the law of warm waves with the rises of the computed film.

    The isothermal responses are those of the first law that holds.
    """
    if asked.heat is None:
        raise RangeError("the law of warm waves is for contacts with heat")
    film, slip = film_for(asked), asked.conditions.slip_parameter
    if slip != 1 and (film.heated is None or film.heated.friction is None):
        film = film_for(asked, "computed")
    if film.heated is None:
        raise RangeError("the central film is given, without the rises of the oil")
    warmth = warmth_of(film, asked.heat, slip)
    thin = thinner(asked.conditions, film.heated.film_factor)
    is_judged = slip != 1 and asked.conditions.oil.name == "Newtonian"
    if is_judged and warmth > MOST_NEWTONIAN:
        raise RangeError(
            "a Newtonian oil under slip warms so far that its viscosity falls "
            f"{math.exp(warmth):.3g} times; the law of warm waves holds up to "
            f"{math.exp(MOST_NEWTONIAN):.2g} times"
        )
    doubts = (1.0, 0.0) if is_judged else (BEYOND, MORE_ERROR)
    cold = asked.cold()
    return WarmTransfer(transfer_for(cold), transfer_for(cold.of(thin)), warmth, *doubts)


def _computed(asked: Asked) -> Transfer:
    from ehlwave.laws.computed_transfer import ComputedTransfer

    return ComputedTransfer(asked.conditions, asked.heat)


def _paper(asked: Asked) -> Transfer:
    return FormulaTransfer(asked.conditions, *(asked.coefficients or ()))


WARM = "warm"
"""Law that cannot be named: the film is computed where no law has it."""

LIST = (
    Law("table", _table, is_for_starved=True),
    Law("starved", _starved, is_for_starved=True),
    Law("atlas", _atlas),
    Law("two-waves", _two_waves),
    Law(WARM, _warm_computed, is_for_starved=True, is_isothermal=False),
    Law("computed", _computed, is_for_starved=True, is_isothermal=False),
    Law("recommended", lambda asked: RecommendedTransfer(asked.conditions), is_unasked=False),
    Law("paper", _paper, is_unasked=False),
)
"""All laws, in the order in which they are asked."""


def transfer_for(asked: Asked, by: str | None = None) -> Transfer:
    """Return the transfer of the first law that holds, or of the law named.

    Parameters
    ----------
    asked : Asked
        The contact.
    by : str, optional
        A law's name; "laws": the first law that holds, nothing is computed. By default computed
        answers are taken where no law holds and the programs are installed.

    Raises
    ------
    RangeError
        If no law holds: all reasons.
    """
    if not math.isfinite(asked.conditions.semi_axis_a_m):
        asked = asked.of(replace(asked.conditions, semi_axis_a_m=1.0))
    if by in (None, "laws") and asked.table is not None:
        by = "table"  # a given table precedes all other laws
    if by not in (None, "laws"):
        return _named(asked, chosen(by, "by", LAWS))
    reasons: list[str] = []
    is_starved = asked.conditions.is_starved
    for law in LIST:
        if not law.is_unasked or (is_starved and not law.is_for_starved):
            continue
        if law.name == "table" or (law.name == "starved" and not is_starved):
            continue
        if law.name == WARM and asked.heat is None:
            continue
        if law.name in (WARM, "computed") and (by == "laws" or not has_programs()):
            continue
        try:
            return _warm(asked, law)
        except (RangeError, SurfaceError, ProgramError) as error:
            if law.name == "computed" and isinstance(error, ProgramError):
                raise
            reasons.append(str(error))
    raise RangeError("; or ".join(dict.fromkeys(reasons)) + _advice(asked, by))


def _warm(asked: Asked, law: Law) -> Transfer:
    """Return a law's transfer; of a warm contact with the law of warm waves, if it has no heat."""
    cold = _with_ridges(asked, law)
    if asked.heat is None or not law.is_isothermal:
        return cold
    film = film_for(asked, "laws")
    if film.heated is None:
        return cold
    warmth = warmth_of(film, asked.heat, asked.conditions.slip_parameter)
    thin = asked.cold().of(thinner(asked.conditions, film.heated.film_factor))
    return WarmTransfer(cold, _with_ridges(thin, law), warmth)


def _with_ridges(asked: Asked, law: Law) -> Transfer:
    """Return a law's transfer whose ridges along rolling are stationary.

    Slip does not change them in a Newtonian oil; in a shear-thinning oil it changes the flow across
    them.
    """
    found, c = law.transfer(asked), asked.conditions
    if law.name != "two-waves":  # the atlas of sliding contacts has ridges of its own
        return found
    try:
        rolling = _atlas(asked.at_slip(1.0))
    except RangeError:
        return found
    if c.oil.name == "Newtonian":
        return StandingRidges(found, rolling)
    if c.oil.name == "Carreau" and isinstance(found, TwoWaveTransfer):
        return StandingRidges(found, ShearedRidges(found.conditions, rolling, found))
    return found


def _named(asked: Asked, name: str) -> Transfer:
    """Return the transfer of a law by its name."""
    law = next(one for one in LIST if one.name == name)
    if asked.conditions.is_starved and not law.is_for_starved:
        raise RangeError(
            f"by = {name!r} is for flooded contacts, and oil_over_flooded is given: leave by "
            "out; the law of starved contacts answers"
        )
    if name == "two-waves":  # outside its range components are not judged, and marked so
        return TwoWaveTransfer(asked.conditions)
    if name in ("recommended", "paper"):
        return law.transfer(asked)
    return _warm(asked, law)


def others_of(conditions: Conditions) -> list[Transfer]:
    """Return the transfers of laws that are shown beside an answer, for comparison."""
    if conditions.is_starved:
        return []
    rolls = conditions.rolls
    found = []
    for name in ("atlas", *(("recommended", "paper") if rolls else ("two-waves",))):
        with contextlib.suppress(RangeError, SurfaceError):
            found.append(_named(Asked(conditions), name))
    return found


def _advice(asked: Asked, by: str | None) -> str:
    """Return the end of a refusal: which laws answer when named, and how to compute."""
    c = asked.conditions
    law = "recommended" if c.rolls else "two-waves"
    named = "" if c.is_starved or c.is_line else f" A law is used when named: by={law!r}."
    compute = "" if by == "laws" else _to_compute(asked)
    return f".{named}{compute}{see('atlas')}"


def _to_compute(asked: Asked) -> str:
    """Return the input file and the command that compute a contact, for users without programs."""
    try:
        text = case_text(case_keys(asked.conditions, asked.heat))
    except (RangeError, SurfaceError):
        return ""
    return (
        " The program ehlwave-case computes it and is not installed here: save the line `"
        f"{' '.join(text.split())}` as contact.nml and run: ehlwave-case contact.nml"
    )


def film_for(asked: Asked, by: str | None = None) -> Film:
    """Return films and friction of the smooth contact by the first law that holds.

    Parameters
    ----------
    asked : Asked
        The contact.
    by : {"laws", "computed"}, optional
        "laws": nothing is computed; "computed": ``ehlwave-case`` answers. By default it answers
        where no law holds and the programs are installed.

    Raises
    ------
    RangeError
        If no law holds.
    """
    if by not in asked.films:
        found = _film(asked, by)
        asked.films[by] = replace(found, warnings=tuple(notices_of(asked, found)))
    return asked.films[by]


def _film(asked: Asked, by: str | None) -> Film:
    if by != "computed":
        try:
            return film_of(asked.conditions, asked.chart, asked.heat, asked.eyring_stress_pa)
        except RangeError as error:
            if by == "laws":
                raise
            if not has_programs():
                raise RangeError(f"{error}.{_to_compute(asked)}") from error
    from ehlwave.laws.computed_film import computed_film

    return computed_film(asked.conditions, asked.heat)
