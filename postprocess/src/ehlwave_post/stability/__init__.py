"""The stability map: many contacts, mild to extreme, and what became of each."""

from ehlwave_post.stability.cases import (
    corner_cases,
    full_cases,
    quick_cases,
    steady_cases,
    wavy_cases,
)
from ehlwave_post.stability.figures import parameter_map, steady_map
from ehlwave_post.stability.outcome import FAILED, OUTCOMES, Row, judge
from ehlwave_post.stability.run import run_cases

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
