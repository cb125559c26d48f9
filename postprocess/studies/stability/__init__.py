"""The stability map: many contacts, mild to extreme, and what became of each."""

from studies.stability.cases import (
    corner_cases,
    full_cases,
    quick_cases,
    steady_cases,
    wavy_cases,
)
from studies.stability.figures import parameter_map, steady_map
from studies.stability.outcome import FAILED, OUTCOMES, Row, judge
from studies.stability.run import run_cases

__all__ = [
    "FAILED",
    "OUTCOMES",
    "Row",
    "corner_cases",
    "full_cases",
    "judge",
    "parameter_map",
    "quick_cases",
    "run_cases",
    "steady_cases",
    "steady_map",
    "wavy_cases",
]
