"""The case files of the study: the dense sweep for formulas, and the way to the line contact."""

import csv
import io
import math
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.contact.formula import f_of_r
from ehlwave.writing import Writer

RADIUS_RATIOS = (1.0, 0.35, 0.12, 0.04)
PAPER_L = 12.05
LOADS_AT_PAPER_L = (50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0)
OTHER_L = (2.5, 5.0, 20.0)
LOADS_AT_OTHER_L = (50.0, 200.0, 1000.0)

# r = lambda_x / lambda_y: 0 is transverse, 1 isotropic, inf longitudinal.
DIRECTIONS = (0.0, 0.05, 0.2, 0.5, 1.0, 2.0, 5.0, 20.0, math.inf)
F_V = (0.1, 0.25, 0.6, 1.5, 4.0, 10.0, 25.0, 60.0)

# Conditions and directions of none of the dense cases, to try the formula on: every M with every L
# and every D once.
FRESH_LOADS = (80.0, 300.0, 1500.0)
FRESH_L = (3.5, 8.0, 16.0)
FRESH_RATIOS = (0.6, 0.2, 0.07)
FRESH_DIRECTIONS = (0.0, 0.3, 1.0, 3.0, math.inf)

# In units of a: a shorter wave needs more than 512 cells; a wave longer than twice the contact
# measures the contact more than the wave.
SHORTEST, LONGEST = 0.12, 4.0

# Towards the line contact: at equal gamma M and L the Hertz pressure is the same for all D.
SLENDER_RATIOS = (1.0, 0.35, 0.12, 0.04, 0.02, 0.01, 0.005)
GAMMA_M = (20.0, 100.0, 500.0)
LINE_WAVELENGTHS = (0.25, 0.5, 1.0, 2.0, 4.0)
# The line contact of Venner and others (1997) with M = W (2U)^(-1/2).
PUBLISHED_LINE = (100.0, 11.0)

COLUMNS = (
    "load_parameter_m",
    "lubricant_parameter_l",
    "radius_ratio_d",
    "orientation",
    "wavelength_over_a",
    "wavelength_x_over_a",
    "wavelength_y_over_a",
)


def dense_cases() -> Iterator[tuple[float, float, float, str, float, float, float]]:
    """Yield the cases of the dense sweep in the order of ``COLUMNS``, see :func:`waves_at`."""
    conditions = [(m, PAPER_L) for m in LOADS_AT_PAPER_L]
    conditions += [(m, l) for l in OTHER_L for m in LOADS_AT_OTHER_L]
    for d in RADIUS_RATIOS:
        for m, l in conditions:
            yield from waves_at(m, l, d, DIRECTIONS)


def fresh_cases() -> Iterator[tuple[float, float, float, str, float, float, float]]:
    """Yield waves at conditions and directions that the dense sweep does not have."""
    for i, m in enumerate(FRESH_LOADS):
        for j, l in enumerate(FRESH_L):
            yield from waves_at(m, l, FRESH_RATIOS[(i + j) % 3], FRESH_DIRECTIONS)


def waves_at(
    m: float, l: float, d: float, directions: Sequence[float]
) -> Iterator[tuple[float, float, float, str, float, float, float]]:
    """Yield the waves at a condition: the values ``F_V`` of f(r) V, eqs. (15), (17).

    Left out are waves whose shorter wavelength is not between ``SHORTEST`` and ``LONGEST``. A
    wavelength of 0 is infinite.
    """
    v_per_a = math.sqrt(contact_gamma(d) * m / l)
    for r in directions:
        for f_v in F_V:
            wave = f_v / (float(f_of_r(r)) * v_per_a)
            if SHORTEST <= wave <= LONGEST:
                yield (m, l, d, *_waves(r, wave))


def line_cases() -> Iterator[tuple[float, float, float, str, float, float, float]]:
    """Yield transverse waves in ever more slender contacts and in the line contact (D = 0).

    All contacts of one ``GAMMA_M`` have the same alpha ph, eq. (3): for a line contact it is L
    (M/(2 pi))^(1/2), so its M is 2 pi (alpha ph/L)^2.
    """
    for gamma_m in GAMMA_M:
        conditions = [(gamma_m / contact_gamma(d), d) for d in SLENDER_RATIOS]
        conditions.append((2 / math.pi * (1.5 * gamma_m) ** (2 / 3), 0.0))
        for m, d in conditions:
            for wave in LINE_WAVELENGTHS:
                yield (m, PAPER_L, d, "transverse", wave, 0.0, 0.0)
    for wave in LINE_WAVELENGTHS:
        yield (*PUBLISHED_LINE, 0.0, "transverse", wave, 0.0, 0.0)


def contact_gamma(d: float) -> float:
    """Return gamma of eq. (3) for a ratio of the radii D > 0."""
    keys = {"load_parameter_m": 1.0, "lubricant_parameter_l": 1.0, "radius_ratio_d": d}
    return conditions_from_keys(keys, needs_lengths=False).gamma


CASE_FILES = {"dense": dense_cases, "fresh": fresh_cases, "line": line_cases}


def write_cases(name: str, path: Path) -> int:
    """Write one of ``CASE_FILES`` for ``ehlwave-sweep``; return the number of cases."""
    rows = [
        (*(f"{x:.10g}" for x in row[:3]), row[3], *(f"{x:.6g}" for x in row[4:]))
        for row in CASE_FILES[name]()
    ]
    file = io.StringIO(newline="")
    csv.writer(file, lineterminator="\n").writerows([COLUMNS, *rows])
    Writer().text(path, file.getvalue())
    return len(rows)


def _waves(r: float, wave: float) -> tuple[str, float, float, float]:
    """Return orientation, lambda, lambda_x and lambda_y; ``wave`` is the shorter wavelength."""
    names = {0.0: "transverse", 1.0: "isotropic", math.inf: "longitudinal"}
    if r in names:
        return names[r], wave, 0.0, 0.0
    return "custom", 0.0, wave * max(r, 1.0), wave * max(1 / r, 1.0)


if __name__ == "__main__":
    print(f"{write_cases(sys.argv[1], Path(sys.argv[2]))} cases in {sys.argv[2]}")
