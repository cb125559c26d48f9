"""By how much thinner than of a Newtonian oil a film is at most, by shear in the inlet.

Two flows shear the oil there. Pressure drives it in pure rolling, too: its stress is h dp/dx/2.
Over the inlet, H^(2/3) a long, the pressure grows to ph, which makes it

    N = K ph^2/(E' tau) H^(2/3)

Eyring stresses, H the film of Moes' formula over the Hertz approach. Slip shears it by T, 100 times
the Newtonian stress over tau at the viscosity of ambient pressure (:class:`Medium`).

tau is the Eyring stress; of a Carreau oil G/(3 (1/n - 1))^(1/2): fluidities 1 + (s/tau)^2/6 of
Ree-Eyring and 1 + (1/n - 1)(s/G)^2/2 of Carreau are alike then at small stresses s, and at larger
stresses Carreau's grows less for n above 1/6.
"""

from dataclasses import replace

from ehlwave.contact.medium import INLET_VISCOSITY, hertz_medium
from ehlwave.contact.oils import Oil
from ehlwave.contact.scales import first_integral, moes_film, moes_per_film
from ehlwave.duals import math

BY_PRESSURE, PIEZOVISCOUS, BY_SLIP = 0.03, 0.16, 0.008
"""Relative loss of film over N^2, the same times L where that is less, and over T, chosen so that
their sum is a bound for contacts without an atlas: of those in ``record/thinning``
none loses more than 0.93 of it. Ree-Eyring oils under slip lose up to 1.23 of it."""

MOST_LOSS = 0.15
"""Loss up to which a film of a Newtonian oil replaces the film of a shear-thinning oil."""

NEARLY_NEWTONIAN = 0.005
"""Loss below which it is as good."""

LEAST_EXPONENT = 1 / 6
"""Carreau's n from which on its oil thins less than the Ree-Eyring oil."""


def as_ree_eyring(oil: Oil) -> Oil:
    """Return the Ree-Eyring oil that thins as much at small stresses; a Newtonian oil unchanged."""
    if oil.stress_modulus_pa2 is None or oil.carreau_exponent is None:
        return oil
    if oil.carreau_exponent == 1:
        return replace(oil, stress_modulus_pa2=None, carreau_exponent=None)
    grows = 3 * (1 / oil.carreau_exponent - 1)
    return replace(
        oil, stress_modulus_pa2=oil.stress_modulus_pa2 / math.sqrt(grows), carreau_exponent=None
    )


def stresses_in_inlet(
    oil: Oil,
    moes: tuple[float, float, float],
    kappa: float,
    alphabar: float,
    lambdabar: float,
    slip: float,
) -> tuple[float, float]:
    """Return N and T, stresses in the inlet due to pressure and slip, over tau.

    Takes M, L and D in a tuple; other arguments as :func:`hertz_medium`.
    """
    oil = as_ree_eyring(oil)
    if oil.stress_modulus_pa2 is None:
        return 0.0, 0.0
    film = moes_film(*moes) / moes_per_film(moes[0], kappa)
    medium = hertz_medium(oil, kappa, alphabar, lambdabar, film, slip)
    hertz_pa = alphabar / oil.pressure_viscosity_per_pa
    by_pressure = first_integral(kappa) * hertz_pa**2 / oil.stress_modulus_pa2 * film ** (2 / 3)
    return by_pressure, INLET_VISCOSITY * medium.thinning


def loss_bound(lubricant_l: float, by_pressure: float, by_slip: float) -> float:
    """Return the bound of the loss, however large, from L, N and T."""
    return min(BY_PRESSURE, PIEZOVISCOUS / lubricant_l) * by_pressure**2 + BY_SLIP * by_slip


def film_loss(oil: Oil, lubricant_l: float, by_pressure: float, by_slip: float) -> float:
    """Return the largest share of the film of a Newtonian oil that thinning takes; inf: unknown.

    Takes L, and N and T of :func:`stresses_in_inlet`.
    """
    if by_pressure == 0:
        return 0.0
    loss = loss_bound(lubricant_l, by_pressure, by_slip)
    exponent = oil.carreau_exponent
    is_known = loss <= MOST_LOSS and (exponent is None or exponent >= LEAST_EXPONENT)
    return loss if is_known else math.inf
