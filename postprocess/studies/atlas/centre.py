"""The pressure at the centre of line contacts in Newtonian oils.

In thick films it is far below the largest pressure, in a spike. Results have the attenuated wave in
closed form, which falls as the pressure there grows: the pressure is found from it.
"""

import math

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.optimize import brentq

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.medium import hertz_medium
from ehlwave.laws.atlas.line_newtonian import newtonian_conditions_of

LOWEST, HIGHEST = 0.005, 3.0
"""P between which it is looked for."""


def centre_pressures(contacts: pd.DataFrame) -> NDArray[np.float64]:
    """Return P at the centres of contacts that slide, one per row of results."""
    table = contacts.to_dict("records")
    found = zip(newtonian_conditions_of(contacts), table, strict=True)
    return np.array([_pressure(*one) for one in found])


def _pressure(contact: Conditions, row: dict[str, float]) -> float:
    number, slip = 2 * math.pi / row["wavelength_x_over_a"], contact.slip_parameter
    wanted = math.hypot(row["attenuated_formula_real"], row["attenuated_formula_imaginary"])
    c, film = contact, row["central_film"]

    def excess(pressure: float) -> float:
        medium = hertz_medium(c.oil, c.kappa, c.alphabar, c.lambdabar, film, slip, pressure)
        return abs(complex(medium.attenuated(number, 0.0, slip))) - wanted

    return float(brentq(excess, LOWEST, HIGHEST, xtol=1e-9))
