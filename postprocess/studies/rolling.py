"""Rolling resistance by Biboulet and Houpert, Proc. IMechE Part J 224, 2010, parts 1 and 2.

Values are the shift of the pressure's centre upstream over the half width along rolling: twice the
moment of the rolling force about the roller's centre, over load and half width, part 1 equation 37.
"""

import math

import numpy as np
from scipy.special import ellipe

from ehlwave.contact.scales import ellipticity


def biboulet_houpert_line(m: float) -> float:
    """Return the shift in a line contact, part 1 equation 42.

    Parameters
    ----------
    m : float
        Moes load parameter.
    """
    moment = 1.4 / m / (1 + (1.4 / 1.45 * m**0.5) ** 10) ** 0.1
    return 2 * moment / (math.pi / 2)


def biboulet_houpert_point(m: float, radius_ratio_d: float, speed: float) -> float:
    """Return the shift in an elliptical contact, part 2 equation 32.

    Parameters
    ----------
    m : float
        Moes load parameter, eq. (2).
    radius_ratio_d : float
        D = Rx/Ry.
    speed : float
        2U = eta0 us/(E' Rx).
    """
    kappa = float(ellipticity(radius_ratio_d))
    beta = 4 / math.pi * float(ellipe(1 - kappa**2)) / (1 + radius_ratio_d)
    load = m * speed**0.75
    half_width = (1.5 * kappa * load * beta) ** (1 / 3)
    rigid = 0.77 * beta ** (-1 / 3) * kappa**0.12 * speed ** (-1 / 12)
    elastic = 1.8 * beta**-0.25
    own_m = beta**0.25 * kappa * m
    force = 2 * half_width / kappa * ((rigid - elastic) / (1 + own_m / 6.6) + elastic)
    return float(np.float64(2 * force * speed**0.75 / load / half_width))
