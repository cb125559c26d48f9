"""Oils: how viscosity and density grow with pressure, and how an oil shears."""

from dataclasses import dataclass

from numpy.typing import ArrayLike, NDArray

from ehlwave.duals import np, root, to_float

ROELANDS_PA = 1.96e8
DENSITY_PA, DENSITY_LIMIT = 5.9e8, 1.34
"""Coefficients of Dowson and Higginson's density, (5.9e8 + 1.34 p)/(5.9e8 + p)."""


@dataclass(frozen=True)
class Oil:
    """Properties of an oil for waves under slip: Roelands' viscosity, and the flow law.

    Attributes
    ----------
    pressure_viscosity_per_pa : float
        alpha, 1/Pa.
    roelands_index : float
        z.
    stress_modulus_pa2 : float or None
        Eyring stress, or Carreau's G, times reduced modulus, E' tau0, Pa^2, on which films depend;
        None of a Newtonian oil.
    carreau_exponent : float or None
        n of a Carreau oil, above 0 and at most 1; None of other oils.
    other_laws : tuple of str
        Requested data that are not included, such as another law of viscosity.
    other_keys : tuple of pairs
        Parameters of these laws by their keys.
    """

    pressure_viscosity_per_pa: float = 2.2e-8
    roelands_index: float = 0.68
    stress_modulus_pa2: float | None = None
    carreau_exponent: float | None = None
    other_laws: tuple[str, ...] = ()
    other_keys: tuple[tuple[str, float], ...] = ()

    @property
    def name(self) -> str:
        """Return which flow law the oil has."""
        if self.stress_modulus_pa2 is None:
            return "Newtonian"
        return "Ree-Eyring" if self.carreau_exponent is None else "Carreau"

    def tangent_factors(self, b: float) -> tuple[float, float]:
        """Return by how much more the film lets through along X and along Y as it is sheared.

        Without a pressure gradient, at a Newtonian stress B over tau0: (1 + B^2)^(1/2) and
        B/asinh(B) of a Ree-Eyring oil (Ehret, Dowson and Taylor 1998). Of a Carreau oil
        s + 2 p sigma^2 s/(1 + sigma^2) and s = (1 + sigma^2)^p, p = (1/n - 1)/2, at the
        stress sigma that has sigma s = B.
        """
        if self.stress_modulus_pa2 is None or b == 0:
            return 1.0, 1.0
        if self.carreau_exponent is None:
            return to_float(np.hypot(1, b)), to_float(b / np.arcsinh(b))
        power = (1 / self.carreau_exponent - 1) / 2
        log_b = to_float(np.log(b))

        def excess(log_stress: float) -> float:
            return to_float(log_stress + power * np.logaddexp(0, 2 * log_stress) - log_b)

        least = min(log_b, log_b / (2 * power + 1)) - power * to_float(np.log(2))
        stress = np.exp(root(excess, least - 1e-9, log_b + 1e-9, xtol=1e-14))
        across = to_float(b / stress)
        return to_float(across * (1 + 2 * power * stress**2 / (1 + stress**2))), across


def log_viscosity(
    alpha: ArrayLike, index: ArrayLike, pressure_pa: ArrayLike
) -> NDArray[np.float64]:
    """Return ln(eta/eta0) by Roelands, for alpha, 1/Pa, z and a pressure, Pa."""
    relative = (1 + np.asarray(pressure_pa) / ROELANDS_PA) ** np.asarray(index) - 1
    return np.asarray(np.asarray(alpha) * ROELANDS_PA / np.asarray(index) * relative)
