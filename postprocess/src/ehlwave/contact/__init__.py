"""The contact: its conditions and scales, its oil, and the two waves under slip.

Independent of surfaces, atlas and results files.
"""

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.contact.conditions_read import read_conditions
from ehlwave.contact.medium import Medium, hertz_medium
from ehlwave.contact.oils import Oil
from ehlwave.contact.two_waves import TwoWaves

__all__ = [
    "Conditions",
    "Medium",
    "Oil",
    "TwoWaves",
    "conditions_from_keys",
    "hertz_medium",
    "read_conditions",
]
