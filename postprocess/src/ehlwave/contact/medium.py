"""The state of the contact centre for small waves, and its effect on them.

The closed forms of ``src/contact/two_waves.f90``, with the same letters and signs: waves are
exp(i (kx X + ky Y - w T)), X and Y in units of a here, w = kx S.
"""

from dataclasses import dataclass

from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.oils import DENSITY_LIMIT, DENSITY_PA, Oil, log_viscosity
from ehlwave.contact.scales import first_integral
from ehlwave.duals import np

Complex = NDArray[np.complex128]

NEWTON_STEP, MOST_NEWTON_STEPS = 1e-7, 20
"""The relative step after which the next is nothing, and how many there are at most."""

INLET_VISCOSITY = 100.0
"""Over that at ambient pressure, about: where in the inlet shear thinning is felt."""


@dataclass(frozen=True)
class Medium:
    """Density, its derivative, film and flow at a place, dimensionless.

    Attributes
    ----------
    rho, drho, h : float
        rho/rho0, d rho/dP and H.
    eps_x, eps_y : float
        rho H^3/(eta lambdabar) times the tangent factor along X and along Y.
    k : float
        Complete elliptic integral K.
    thinning : float
        Shear stress of slip with the viscosity at ambient pressure in a film of this thickness,
        over the Eyring stress: B with eta = 1. 0 for a Newtonian oil; a Carreau oil takes the
        Ree-Eyring oil with equal thinning in the inlet.
    """

    rho: float
    drho: float
    h: float
    eps_x: float
    eps_y: float
    k: float
    thinning: float = 0.0

    def deflection(self, kx: ArrayLike, ky: ArrayLike) -> Complex:
        """Return W = 2/(K |k|): the deflection under a pressure wave of amplitude 1."""
        return np.asarray(2 / (self.k * np.sqrt(np.square(kx) + np.square(ky))))

    def attenuated(self, kx: ArrayLike, ky: ArrayLike, slip: float) -> Complex:
        """Return the amplitude over Ai of the wave that moves with the surface.

        a = 1/(1 + i (1 - S) kx rho W/(eps_x kx^2 + eps_y ky^2 + i (1 - S) kx rho' H))
        """
        rate = 1j * (1 - slip) * np.asarray(kx, dtype=float)
        flow = self.eps_x * np.square(kx) + self.eps_y * np.square(ky) + rate * self.drho * self.h
        return np.asarray(1 / (1 + rate * self.rho * self.deflection(kx, ky) / flow))

    def complementary_number(self, frequency: ArrayLike, ky: ArrayLike) -> Complex:
        """Return the wave number psi along X, 1/a, of the wave that moves with the oil.

        Of eps_x psi^2 + eps_y ky^2 + i (psi - w)(rho W(psi) + rho' H) = 0 the only root that has
        Re psi > 0 and Im psi > 0; w where nothing flows by pressure. Over rho W |k| and times
        s = (psi^2 + ky^2)^(1/2) it reads

            (e_x psi^2 + e_y ky^2 + i q (psi - w)) s + i (psi - w) = 0.

        With s of psi = w this is a quadratic equation, from whose root Newton's method gets there:
        in at most nine steps in 120 000 random waves (S 0.05 to 2, 0.02 a to 10 a). NaN where it
        does not converge, or to another root. ``src/contact/two_waves.f90`` has the same method.
        """
        w, across = np.asarray(frequency, dtype=float), np.asarray(ky, dtype=float)
        stiffness = self.rho * 2 / self.k
        e_x, q, ky2 = self.eps_x / stiffness, 1j * self.drho * self.h / stiffness, across**2
        still = self.eps_y / stiffness * ky2 - q * w
        psi = _smaller_root(e_x, q, still, w, np.sqrt(w**2 + ky2))
        for _ in range(MOST_NEWTON_STEPS):
            s = np.sqrt(psi**2 + ky2)
            flow = (e_x * psi + q) * psi + still
            step = (flow * s + 1j * (psi - w)) / ((2 * e_x * psi + q) * s + flow * psi / s + 1j)
            psi = psi - step
            has_converged = np.abs(step) <= NEWTON_STEP * np.abs(psi)
            if np.all(has_converged):
                break
        is_first = np.minimum(psi.real, psi.imag) > -NEWTON_STEP * np.abs(psi)
        return np.where(has_converged & is_first, psi, complex(np.nan, np.nan))


def _smaller_root(e_x: ArrayLike, q: ArrayLike, still: Complex, w: Complex, s: Complex) -> Complex:
    """Return the root next to w of (e_x psi^2 + q psi + still) s + i (psi - w) = 0."""
    square, middle, rest = e_x * s, q * s + 1j, still * s - 1j * w
    root = np.sqrt(middle**2 - 4 * square * rest)
    root = np.where((np.conj(middle) * root).real < 0, -root, root)
    return np.asarray(-2 * rest / (middle + root))


def hertz_medium(
    oil: Oil,
    kappa: float,
    alphabar: float,
    lambdabar: float,
    film: float,
    slip: float,
    pressure: float = 1.0,
) -> Medium:
    """Return the state of the centre of a contact, by default under the maximum Hertz pressure.

    The flow follows :meth:`Oil.tangent_factors`, B = (lambdabar N0/6) 2 (S - 1) eta/H, N0 = K
    ph^2/(E' tau0).

    Parameters
    ----------
    oil : Oil
        Of the contact.
    kappa, alphabar, lambdabar : float
        Ellipticity, 0 of a line contact, alpha ph, and the speed parameter, eq. (1), (3), (4).
    film : float
        H at the centre.
    slip : float
        S.
    pressure : float
        P at the centre.
    """
    k = first_integral(kappa)
    alpha, index = oil.pressure_viscosity_per_pa, oil.roelands_index
    hertz_pa = alphabar / alpha
    centre_pa = pressure * hertz_pa
    viscosity = np.exp(log_viscosity(alpha, index, centre_pa))
    rho = (DENSITY_PA + DENSITY_LIMIT * centre_pa) / (DENSITY_PA + centre_pa)
    drho = hertz_pa * (DENSITY_LIMIT - 1) * DENSITY_PA / (DENSITY_PA + centre_pa) ** 2
    eps = rho * film**3 / (viscosity * lambdabar)
    along, across, thinning = 1.0, 1.0, 0.0
    if oil.stress_modulus_pa2 is not None and slip != 1:
        stress = k * hertz_pa**2 / oil.stress_modulus_pa2
        thinning = lambdabar * stress / 3 * abs(slip - 1) / film
        along, across = oil.tangent_factors(thinning * viscosity)
        if oil.carreau_exponent is not None:
            in_inlet = oil.tangent_factors(INLET_VISCOSITY * thinning)[0]
            thinning = (in_inlet - 1) / INLET_VISCOSITY
    return Medium(rho, drho, film, eps * along, eps * across, k, thinning)
