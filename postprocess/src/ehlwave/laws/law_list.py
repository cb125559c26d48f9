"""The list of laws: which source answers for a contact, and why the others do not.

Every door of the package asks here: films, responses, surfaces, stresses, commands and the page.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from ehlwave.choices import LAWS, chosen
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.hints import see
from ehlwave.inputs.slip import RATIO, ratio_of
from ehlwave.laws.answers import Film
from ehlwave.laws.asked import Asked
from ehlwave.laws.atlas.ranges import SLIDING_RANGES
from ehlwave.laws.atlas_transfer import AtlasTransfer, with_atlas_film
from ehlwave.laws.computed_film import computed_film
from ehlwave.laws.computed_transfer import ComputedTransfer
from ehlwave.laws.film_answer import film_of
from ehlwave.laws.standing_waves import StandingRidges
from ehlwave.laws.starved_transfer import StarvedTransfer
from ehlwave.laws.transfer import FormulaTransfer, LawBasis, RecommendedTransfer, Transfer
from ehlwave.laws.two_wave_transfer import TwoWaveTransfer
from ehlwave.laws.warm_waves import WarmWaves
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
    if c.has_sliding_atlas:  # outside it: the film of rolling stands for it
        c = replace(with_atlas_film(replace(c, slip_parameter=1.0)), slip_parameter=slip)
    else:
        c = with_atlas_film(c, asked.atlas())
    return holding(TwoWaveTransfer(c))


def holding(transfer: Transfer) -> Transfer:
    """Return a transfer whose law holds; RangeError with the reasons otherwise."""
    if isinstance(transfer, LawBasis) and (reasons := transfer.reasons()):
        raise RangeError("; ".join(reasons))
    return transfer


def _computed(asked: Asked) -> Transfer:
    return ComputedTransfer(asked.conditions, asked.heat)


LIST = (
    Law("starved", _starved, is_for_starved=True),
    Law("atlas", _atlas),
    Law("two-waves", _two_waves),
    Law("computed", _computed, is_for_starved=True, is_isothermal=False),
    Law("recommended", lambda asked: RecommendedTransfer(asked.conditions), is_unasked=False),
    Law("paper", lambda asked: FormulaTransfer(asked.conditions), is_unasked=False),
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
        asked = replace(asked, conditions=replace(asked.conditions, semi_axis_a_m=1.0))
    if by not in (None, "laws"):
        return _named(asked, chosen(by, "by", LAWS))
    reasons: list[str] = []
    is_starved = asked.conditions.is_starved
    for law in LIST:
        is_wanted = law.is_unasked and (law.is_for_starved or not is_starved)
        if law.name == "starved" and not is_starved:
            continue
        if law.name == "computed" and (by == "laws" or not has_programs()):
            continue
        if not is_wanted:
            continue
        try:
            return _with_ridges(asked, law, by)
        except SurfaceError as error:
            reasons.append(str(error))
    raise RangeError("; or ".join(dict.fromkeys(reasons)) + _advice(asked, by))


def _with_ridges(asked: Asked, law: Law, by: str | None) -> Transfer:
    """Return a law's transfer; ridges along rolling of a Newtonian oil do not feel slip."""
    found = law.transfer(asked)
    c = asked.conditions
    if law.is_isothermal and asked.heat is not None:
        found = WarmWaves(found, asked)
    slides = c.slip_parameter != 1 and not c.is_line
    if slides and c.oil.name == "Newtonian" and law.name != "computed":
        try:
            return StandingRidges(found, transfer_for(asked.at_slip(1.0), "laws"))
        except RangeError:
            return found
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
    return _with_ridges(asked, law, name)


def _advice(asked: Asked, by: str | None) -> str:
    """Return the end of a refusal: which laws answer when named, and how to compute."""
    c = asked.conditions
    law = "recommended" if c.slip_parameter == 1 else "two-waves"
    named = "" if c.is_starved or c.is_line else f" A law is used when named: by={law!r}."
    compute = "" if by == "laws" else " Computed answers need the programs (ehlwave-case)."
    return f".{named}{compute}{see('atlas')}"


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
    if by == "computed":
        return computed_film(asked.conditions, asked.heat)
    c = asked.conditions
    try:
        return film_of(c, asked.chart, asked.heat, asked.eyring_stress_pa)
    except RangeError:
        if by == "laws" or not has_programs():
            raise
    return computed_film(asked.conditions, asked.heat)
