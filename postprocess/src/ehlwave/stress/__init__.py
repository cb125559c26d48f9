"""Stress below rough, sliding, lubricated surfaces, and what it does to their life.

Stresses below any pressure and traction: :func:`stress_below`. What of them decides:
:mod:`ehlwave.stress.criteria`, :mod:`ehlwave.stress.dang_van`, :mod:`ehlwave.stress.life`. Closed
forms of Hertz contacts: :mod:`ehlwave.stress.hertz`.
"""

from ehlwave.stress.criteria import (
    CRITERIA,
    Largest,
    hydrostatic,
    largest,
    largest_shear,
    orthogonal_shear,
    von_mises,
)
from ehlwave.stress.dang_van import dang_van_factor, dang_van_path, fatigue_shear
from ehlwave.stress.field import stress_below
from ehlwave.stress.hertz import (
    hertz_axis_stress,
    hertz_circle_stress,
    hertz_line_stress,
    hertz_pressure,
)
from ehlwave.stress.life import life_integral_ratio, life_ratio, share_at_risk
from ehlwave.stress.waves import COMPONENTS, wave_stress

__all__ = [
    "COMPONENTS",
    "CRITERIA",
    "Largest",
    "dang_van_factor",
    "dang_van_path",
    "fatigue_shear",
    "hertz_axis_stress",
    "hertz_circle_stress",
    "hertz_line_stress",
    "hertz_pressure",
    "hydrostatic",
    "largest",
    "largest_shear",
    "life_integral_ratio",
    "life_ratio",
    "orthogonal_shear",
    "share_at_risk",
    "stress_below",
    "von_mises",
    "wave_stress",
]
