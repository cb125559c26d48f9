"""By how much thinner than of a Newtonian oil a film is at most, by shear in the inlet.

Two flows shear the oil there. Pressure drives it in pure rolling, too: its stress is h dp/dx/2.
Over the inlet, H^(2/3) a long, the pressure grows to ph, which makes it

    N = K ph^2/(E' tau) H^(2/3)

Eyring stresses, H the film of Moes' formula over the Hertz approach. Slip shears it by T, 100 times
the Newtonian stress over tau at the viscosity of ambient pressure (:class:`Medium`).

tau is the Eyring stress; of a Carreau oil G/(3 (1/n - 1))^(1/2): fluidities 1 + (s/tau)^2/6 of
Ree-Eyring and 1 + (1/n - 1)(s/G)^2/2 of Carreau are alike then at small stresses s, and at larger
ones Carreau's grows less for n above 1/6.
"""

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from scipy.special import ellipk

from ehlwave.contact.line_contact import moes_per_line_film
from ehlwave.contact.medium import INLET_VISCOSITY, hertz_medium
from ehlwave.contact.oils import Oil
from ehlwave.contact.scales import moes_film, moes_per_film

if TYPE_CHECKING:
    from ehlwave.contact.conditions import Conditions

BY_PRESSURE, PIEZOVISCOUS, BY_SLIP = 0.03, 0.16, 0.008
"""Relative loss of film over N^2, the same times L where that is less, and over T. They are bounds:
drawn contacts computed with ``ehlwave-case`` lose at most 0.94 of it, up to :data:`MOST_LOSS`."""

MOST_LOSS = 0.15
"""Loss up to which a film of a Newtonian oil stands for that of one that thins."""

NEARLY_NEWTONIAN = 0.005
"""Loss below which it is as good."""

LEAST_EXPONENT = 1 / 6
"""Carreau's n from which on its oil thins less than the Ree-Eyring oil."""


def as_ree_eyring(oil: Oil) -> Oil:
    """Return the Ree-Eyring oil that thins as much at small stresses; a Newtonian one as it is."""
    if oil.stress_modulus_pa2 is None or oil.carreau_exponent is None:
        return oil
    if oil.carreau_exponent == 1:
        return replace(oil, stress_modulus_pa2=None, carreau_exponent=None)
    grows = 3 * (1 / oil.carreau_exponent - 1)
    return replace(
        oil, stress_modulus_pa2=oil.stress_modulus_pa2 / math.sqrt(grows), carreau_exponent=None
    )


def stresses_in_inlet(contact: "Conditions") -> tuple[float, float]:
    """Return N and T, what pressure and slip make of shear stresses in the inlet over tau."""
    oil = as_ree_eyring(contact.oil)
    if oil.stress_modulus_pa2 is None:
        return 0.0, 0.0
    m, kappa = contact.m, contact.kappa
    k = 1.0 if contact.is_line else float(ellipk(1 - kappa**2))
    per_film = float(moes_per_line_film(m)) if contact.is_line else moes_per_film(m, kappa)
    film = moes_film(m, contact.l, contact.d) / per_film
    medium = hertz_medium(
        oil, kappa, contact.alphabar, contact.lambdabar, film, contact.slip_parameter
    )
    by_pressure = k * contact.hertz_pa**2 / oil.stress_modulus_pa2 * film ** (2 / 3)
    return by_pressure, INLET_VISCOSITY * medium.thinning


def film_loss(contact: "Conditions") -> float:
    """Return the largest share of the film of a Newtonian oil that thinning takes; inf: unknown."""
    by_pressure, by_slip = stresses_in_inlet(contact)
    pressure_share = min(BY_PRESSURE, PIEZOVISCOUS / contact.l)
    loss = pressure_share * by_pressure**2 + BY_SLIP * by_slip
    exponent = contact.oil.carreau_exponent
    is_known = loss <= MOST_LOSS and (exponent is None or exponent >= LEAST_EXPONENT)
    return loss if is_known or loss == 0 else math.inf
