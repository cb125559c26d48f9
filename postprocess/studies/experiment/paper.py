"""Numbers of section 4 of Venner, Kaneta and Lubrecht (2000): tables 1 and 2, and its text."""

from typing import NamedTuple

from studies.experiment.cases import PRINTED_L, PRINTED_M


class Printed(NamedTuple):
    """Numbers at a speed; films and amplitudes in um, None where missing."""

    m: float
    l: float
    lambdabar: float
    v: float
    formula_ratio: float
    measured_mean: float
    computed_mean: float
    smooth_film: float | None
    measured_amplitude: float | None
    computed_amplitude: float | None


def _printed(speed: float, *numbers: float | None) -> Printed:
    return Printed(PRINTED_M[speed], PRINTED_L[speed], *numbers)  # type: ignore[arg-type]


PRINTED = {
    0.024: _printed(0.024, 1.65e-2, 1.42, 0.80, 0.28, 0.25, 0.24, 0.15, 0.13),
    0.048: _printed(0.048, 3.19e-2, 1.02, 0.86, 0.42, 0.40, None, None, None),
    0.096: _printed(0.096, 6.39e-2, 0.72, 0.90, 0.70, 0.62, None, None, None),
}
ALPHABAR = 12.23
W = 2.086e-6
G = 2633.0
U = {0.024: 2.0e-11}
SEMI_AXIS_MM = 0.185
HERTZ_PRESSURE_GPA = 0.54
V_IN_TEXT = 1.423
PARTS_AMPLITUDE_UM = (0.13, 0.16)
