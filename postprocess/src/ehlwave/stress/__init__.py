"""Stress below rough, sliding, lubricated surfaces, and its effect on their life.

Stresses below any pressure and traction: :func:`stress_below`. The deciding parts of them:
:mod:`ehlwave.stress.criteria`, :mod:`ehlwave.stress.dang_van`, :mod:`ehlwave.stress.life`. Closed
forms of Hertz contacts: :mod:`ehlwave.stress.hertz`.
"""

from ehlwave.stress.case import (
    line_stress_over_time,
    point_histories,
    solved_contact,
    stress_of_case,
)
from ehlwave.stress.centre import contact_fields
from ehlwave.stress.contact_stress import stress_of_contact
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
from ehlwave.stress.rough import RoughStress, rough_stress
from ehlwave.stress.waves import COMPONENTS, wave_stress

__all__ = [
    "COMPONENTS",
    "CRITERIA",
    "Largest",
    "RoughStress",
    "contact_fields",
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
    "line_stress_over_time",
    "orthogonal_shear",
    "point_histories",
    "rough_stress",
    "share_at_risk",
    "solved_contact",
    "stress_below",
    "stress_of_case",
    "stress_of_contact",
    "von_mises",
    "wave_stress",
]
