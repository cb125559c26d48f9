"""What became of a case, and whether its result is honest."""

import math
from dataclasses import dataclass, field
from typing import Any

from studies.programs import Outcome
from studies.stability.cases import Case

CONVERGED = "converged"
UNRESOLVED = "converged, unresolved"
UNSOLVED = "unresolved, not converged"
REFUSED = "refused"
FAILED = "failed"
OUTCOMES = (CONVERGED, UNRESOLVED, UNSOLVED, REFUSED, FAILED)
"""Of a case. Only the last is a fault; an unresolved case that does not converge says so."""

_FILMS = ("central_film", "minimum_film", "central_film_moes", "max_pressure")
_RATIOS = ("amplitude_ratio", "amplitude_ratio_fit", "mean_film")
_UNFINISHED = ("pending", "over_budget", "crashed")
# Steady states hold the first tolerance, time steps the second (defaults of &solver).
_LARGEST_RESIDUAL = 1e-3
_WIDEST_FACTOR = 2.0


@dataclass
class Row:
    """A case with its outcome; `faults` lists what makes a result dishonest or wrong."""

    case: Case
    outcome: str
    seconds: float = math.nan
    result: dict[str, Any] = field(default_factory=dict)
    message: str = ""
    faults: list[str] = field(default_factory=list)

    @property
    def is_bad(self) -> bool:
        """Whether the case failed, or its result claims what it should not."""
        return self.outcome == FAILED or bool(self.faults)


def judge(case: Case, result: dict[str, Any]) -> Row:
    """Return the row of a case of the sweep from the columns of its results."""
    row = Row(case, _outcome(result), float(result["seconds"]), result, str(result["message"]))
    if result["status"] in _UNFINISHED:
        row.message = row.message or f"status {result['status']}"
    else:
        row.faults = _faults(result)
    return row


def judge_refusal(case: Case, outcome: Outcome) -> Row:
    """Return the row of a case that must be refused, with a message, from what became of it."""
    said = outcome.stderr.strip()
    if outcome.returncode != 2:
        return Row(case, FAILED, message=f"taken, with exit status {outcome.returncode}: {said}")
    return Row(case, REFUSED, message=said, faults=[] if said else ["refused without a message"])


def _outcome(result: dict[str, Any]) -> str:
    status = result["status"]
    if status in ("converged", "unresolved"):
        return CONVERGED if status == "converged" else UNRESOLVED
    return FAILED if result["is_resolved"] or status in _UNFINISHED else UNSOLVED


def _faults(result: dict[str, Any]) -> list[str]:
    """Return what a result claims without right."""
    status = result["status"]
    faults = []
    if (status == "converged") != result["is_resolved"] and status in ("converged", "unresolved"):
        faults.append(f"status {status} with is_resolved {result['is_resolved']}")
    if status != "converged" and not result["message"]:
        faults.append("no message")
    if status in ("converged", "unresolved"):
        faults += _wrong_numbers(result)
    else:
        faults += [
            f"not converged, yet {name} given" for name in _RATIOS if _is_number(result[name])
        ]
        if "smooth surfaces" in result["message"]:
            faults += [
                f"no steady state, yet {name} given" for name in _FILMS if _is_number(result[name])
            ]
    return faults


def _wrong_numbers(result: dict[str, Any]) -> list[str]:
    """Return what cannot be true of a converged result."""
    faults = [
        f"{name} = {result[name]}"
        for name in _FILMS
        if not _is_number(result[name]) or result[name] <= 0
    ]
    faults += [
        f"{name} = {result[name]}"
        for name in ("residual", "load_error")
        if not _is_number(result[name]) or result[name] > _LARGEST_RESIDUAL
    ]
    if result["status"] == "converged" and not faults:
        expected = film_formula(
            result["load_parameter_m"], result["lubricant_parameter_l"], result["radius_ratio_d"]
        )
        ratio = result["central_film_moes"] / expected
        if not 1 / _WIDEST_FACTOR < ratio < _WIDEST_FACTOR:
            faults.append(f"film thickness is {ratio:.3g} of the formula's")
    return faults


def film_formula(m: float, l: float, d: float) -> float:
    """Return the central film thickness in the Moes scale, Nijenbanning, Venner and Moes (1994)."""
    rigid_isoviscous = 145 * (1 + 0.796 * d ** (14 / 15)) ** (-15 / 7) / d / m**2
    rigid_piezoviscous = 1.29 * (1 + 0.691 * d) ** (-2 / 3) * l ** (2 / 3)
    shape = 1 + 0.006 * math.log(d) + 0.63 * d ** (4 / 7)
    elastic_isoviscous = 3.18 * shape ** (-14 / 25) * d ** (-1 / 15) * m ** (-2 / 15)
    elastic_piezoviscous = 1.48 * shape ** (-7 / 20) * d ** (-1 / 24) * m ** (-1 / 12) * l**0.75
    limit = 1.8 / d
    ratio = elastic_isoviscous / elastic_piezoviscous if l > 0 else math.inf
    s = 1.5 * (1 + math.exp(-1.2 * ratio))
    left = rigid_isoviscous**1.5 + (elastic_isoviscous**-4 + limit**-4) ** (-3 / 8)
    right = (rigid_piezoviscous**-8 + elastic_piezoviscous**-8) ** (-s / 8) if l > 0 else 0.0
    return (left ** (2 * s / 3) + right) ** (1 / s)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and math.isfinite(value)
