"""The outcome of a case, and whether its result is honest."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from ehlwave.contact.scales import moes_film
from ehlwave.results.schema import SETTLED
from studies.programs import Outcome
from studies.stability.cases import SLIDING, Case

CONVERGED = "converged"
UNRESOLVED = "converged, unresolved"
UNSOLVED = "unresolved, not converged"
REFUSED = "refused"
FAILED = "failed"
OUTCOMES = (CONVERGED, UNRESOLVED, UNSOLVED, REFUSED, FAILED)
"""Outcomes of a case. Only the last is a fault; an unresolved case that does not converge reports
it.
"""

_FILMS = ("central_film", "minimum_film", "central_film_moes", "max_pressure")
_RATIOS = ("amplitude_ratio", "amplitude_ratio_fit", "mean_film", "harmonic_ratio")
_UNFINISHED = ("pending", "over_budget", "crashed")
# Steady states hold the first tolerance, time steps the second (defaults of &solver).
_LARGEST_RESIDUAL = 1e-3
_WIDEST_FACTOR = 2.0
_LARGEST_HARMONIC_RATIO = 2.0
_LARGEST_DIFFERENCE = 1e-4


@dataclass
class Row:
    """A case with its outcome; `faults` lists false claims and wrong results."""

    case: Case
    outcome: str
    seconds: float = math.nan
    result: dict[str, Any] = field(default_factory=dict)
    message: str = ""
    faults: list[str] = field(default_factory=list)

    @property
    def is_bad(self) -> bool:
        """Whether the case failed, or its result makes a false claim."""
        return self.outcome == FAILED or bool(self.faults)


def judge(case: Case, result: dict[str, Any]) -> Row:
    """Return the row of a case of the sweep from the columns of its results."""
    row = Row(case, _outcome(result), float(result["seconds"]), result, str(result["message"]))
    if result["status"] in _UNFINISHED:
        row.message = row.message or f"status {result['status']}"
    else:
        row.faults = _faults(result)
    return row


def compare(rows: Sequence[Row]) -> None:
    """Add a fault to cases of a sliding oil that differ from another solution of the same problem.

    The same case solved again and, for the smooth film, the case with 2 - S in place of S.
    """
    sliding = [row for row in rows if row.case.family.startswith(SLIDING)]
    first: dict[tuple[object, ...], Row] = {}
    for row in sliding:
        if row.outcome not in (CONVERGED, UNRESOLVED):
            continue
        slip = row.case.value("slip_parameter")
        keys = ("load_parameter_m", "lubricant_parameter_l", "radius_ratio_d")
        condition = (row.case.family, *map(row.case.value, keys))
        for same, names in ((abs(slip - 1), _FILMS), (f"S {slip:g}", ("harmonic_ratio",))):
            other = first.setdefault((*condition, same), row)
            for name in names:
                here, there = row.result[name], other.result[name]
                if not abs(here - there) <= _LARGEST_DIFFERENCE * abs(there):
                    said = f"{name} = {here:.6g}, yet {there:.6g} with {other.case.variant}"
                    row.faults.append(said)


def judge_refusal(case: Case, outcome: Outcome) -> Row:
    """Return the row of a case that must be refused, with a message, from its outcome."""
    said = outcome.stderr.strip()
    if outcome.returncode != 2:
        return Row(case, FAILED, message=f"taken, with exit status {outcome.returncode}: {said}")
    return Row(case, REFUSED, message=said, faults=[] if said else ["refused without a message"])


def _outcome(result: dict[str, Any]) -> str:
    status = result["status"]
    if status in SETTLED:
        return CONVERGED if status == "converged" else UNRESOLVED
    return FAILED if result["is_resolved"] or status in _UNFINISHED else UNSOLVED


def _faults(result: dict[str, Any]) -> list[str]:
    """Return the false claims of a result."""
    status = result["status"]
    faults = []
    if (status == "converged") != result["is_resolved"] and status in SETTLED:
        faults.append(f"status {status} with is_resolved {result['is_resolved']}")
    if status != "converged" and not result["message"]:
        faults.append("no message")
    if status in SETTLED:
        faults += _wrong_numbers(result)
    else:
        claims = dict.fromkeys(_RATIOS, "not converged")
        if "smooth surfaces" in result["message"]:
            claims |= dict.fromkeys(_FILMS, "no steady state")
        given = (name for name in claims if math.isfinite(result.get(name, math.nan)))
        faults += [f"{claims[name]}, yet {name} given" for name in given]
    return faults


def _wrong_numbers(result: dict[str, Any]) -> list[str]:
    """Return the impossible values of a converged result."""
    allowed = dict.fromkeys(_FILMS, (0, math.inf))
    allowed |= dict.fromkeys(("residual", "load_error"), (-math.inf, _LARGEST_RESIDUAL))
    if result.get("response") == "harmonic":
        allowed["harmonic_ratio"] = (0, _LARGEST_HARMONIC_RATIO)
    faults = [
        f"{name} = {result[name]}"
        for name, (low, high) in allowed.items()
        if not (math.isfinite(result[name]) and low < result[name] <= high)
    ]
    if result["status"] == "converged" and not faults:
        expected = moes_film(
            result["load_parameter_m"], result["lubricant_parameter_l"], result["radius_ratio_d"]
        )
        starved = result.get("film_over_flooded", math.nan)
        flooded = result["central_film_moes"] / (starved if math.isfinite(starved) else 1)
        ratio = flooded / expected
        # No formula gives the thinning of a sliding Ree-Eyring oil.
        thinnest = 0 if result.get("eyring_stress_pa", 0) > 0 else 1 / _WIDEST_FACTOR
        if not thinnest < ratio < _WIDEST_FACTOR:
            faults.append(f"film thickness is {ratio:.3g} of the formula's")
    return faults
