"""What became of a case, and whether its result is honest."""

import math
from dataclasses import dataclass, field
from typing import Any

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
_EXIT_CODES = {"converged": 0, "unresolved": 0, "stalled": 1, "diverged": 1, "not_finite": 1}
# Steady states hold the first tolerance, time steps the second (defaults of &solver).
_LARGEST_RESIDUAL = 1e-3
_WIDEST_FACTOR = 2.0


@dataclass
class Row:
    """A case with its outcome; `faults` lists what makes a result dishonest or wrong."""

    case: Case
    outcome: str
    seconds: float
    result: dict[str, Any] = field(default_factory=dict)
    message: str = ""
    faults: list[str] = field(default_factory=list)

    @property
    def is_bad(self) -> bool:
        """Whether the case failed, or its result claims what it should not."""
        return self.outcome == FAILED or bool(self.faults)


def judge(
    case: Case, exit_code: int | None, result: dict[str, Any] | None, message: str, seconds: float
) -> Row:
    """Return the row of a case that has ended.

    Parameters
    ----------
    case : Case
        What was run.
    exit_code : int or None
        Of ``ehlwave-case``, negative for a signal; None when it was stopped at the time limit.
    result : dict or None
        Its JSON object, None when it wrote none.
    message : str
        Its standard error, kept when it wrote no result.
    seconds : float
        Wall time.
    """
    if exit_code is None:
        return Row(case, FAILED, seconds, message="stopped at the time limit")
    if exit_code == 2 and result is None:
        row = Row(case, REFUSED, seconds, message=message)
        if not message:
            row.faults.append("refused without a message")
        return row
    if exit_code < 0 or result is None:
        text = f"ended with status {exit_code} and no result: {message}"
        return Row(case, FAILED, seconds, message=text)
    row = Row(case, _outcome(result), seconds, result, str(result.get("message", "")))
    row.faults = list(_faults(result, exit_code))
    return row


def _outcome(result: dict[str, Any]) -> str:
    if result["status"] == "converged":
        return CONVERGED
    if result["status"] == "unresolved":
        return UNRESOLVED
    return FAILED if result["is_resolved"] else UNSOLVED


def _faults(result: dict[str, Any], exit_code: int) -> list[str]:
    """Return what a result claims without right."""
    status = result["status"]
    faults = []
    if _EXIT_CODES.get(status) != exit_code:
        faults.append(f"exit status {exit_code} with status {status}")
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
