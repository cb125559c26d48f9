"""Numbers of a case against the same case on twice the cells.

The distance of a number v(h) from its limit is taken as 4/3 of its distance from v(h/2): that is
the distance from the value extrapolated with second order, and more where tolerances make it.
"""

import math
from dataclasses import dataclass
from typing import Any

Row = dict[str, Any]

FACTOR, SLACK = 1.5, 0.002
"""Allowed deviation of a number: so many times its declared error, and so much of it."""
LIMIT = 4 / 3
NOTHING = 1e-12
"""Numbers that are zero but for rounding, such as friction in pure rolling."""
MOST_WORK = 10
"""Largest work over the planned work,"""
FINER_RUNS = 3
"""and times as much with finer runs for an accuracy."""

# Parts shared by both runs are no part of their difference: the domain, and the size of the waves.
FILM_PARTS = ("film_error_mesh", "film_error_meniscus", "film_error_algebraic")
RATIO_PARTS = tuple(
    f"ratio_error_{part}" for part in ("mesh", "meniscus", "time", "settling", "algebraic")
)
DOMAIN_PARTS = {
    "smallest H": "minimum_film_error_domain",
    "friction": "friction_error_domain",
}
NUMBERS = {
    "H(0,0)": (("central_film",), FILM_PARTS),
    "smallest H": (("minimum_film",), ("minimum_film_error", "film_error_algebraic")),
    "Ad/Ai": (("amplitude_ratio_fit",), RATIO_PARTS),
    "response": (
        ("harmonic_real", "harmonic_imaginary"),
        ("harmonic_error", "ratio_error_meniscus", "response_tolerance"),
    ),
    "friction": (("friction_coefficient",), ("friction_error", "film_error_algebraic")),
}
"""Each number: its quantities, and the relative errors that are declared of it."""
FILMS = ("central_film", "minimum_film", "smallest_film", "mean_film")


@dataclass(frozen=True)
class Finding:
    """A number of a case."""

    number: str
    value: float
    finer: float
    off: float
    """Relative distance from the limit."""
    declared: float

    @property
    def is_offender(self) -> bool:
        """Whether its error exceeds the estimate; without estimate it counts as 0."""
        declared = self.declared if math.isfinite(self.declared) else 0.0
        return not self.off <= FACTOR * declared + SLACK


def findings(found: Row, finer: Row) -> list[Finding]:
    """Return the comparison of a converged case with the case on twice the cells."""
    result = []
    for number, (parts, errors) in NUMBERS.items():
        value = _complex(found, parts)
        other = _complex(finer, parts)
        if not (math.isfinite(abs(value)) and math.isfinite(abs(other))):
            continue
        if max(abs(value), abs(other)) < NOTHING:
            continue
        off = LIMIT * abs(value - other) / max(abs(value), 1e-300)
        declared = sum(_number(found[name]) for name in errors if name in found)
        declared -= _number(found.get(DOMAIN_PARTS.get(number, ""), 0.0))
        result.append(Finding(number, abs(value), abs(other), off, declared))
    return result


def negative_films(found: Row) -> list[str]:
    """Return the films of a result that are none."""
    return [name for name in FILMS if _number(found.get(name)) <= 0]


def work_over_plan(found: Row, plan: Row) -> float:
    """Return all the work of a case over the work of its plan, in operations."""
    done = _number(found["total_work_units"])
    expected = _number(plan["expected_total_work_units"])
    return done * _unit(found) / (expected * _unit(plan))


def _unit(row: Row) -> float:
    """Return the operations of a work unit, but for a factor: two padded transforms of the grid."""
    points = 4.0 * row["cells_x"] * row["cells_y"]
    return points * math.log2(points)


def _number(value: Any) -> float:  # noqa: ANN401 - of JSON
    return math.nan if value is None else float(value)


def _complex(row: Row, parts: tuple[str, ...]) -> complex:
    values = [_number(row.get(part)) for part in parts]
    return complex(*values) if all(map(math.isfinite, values)) else complex(math.nan)
