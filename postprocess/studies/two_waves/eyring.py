"""Attenuated waves deep in the Eyring regime, where one number decides them."""

import itertools

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.special import ellipk

from studies.section import Table
from studies.two_waves.cases import REDUCED_MODULUS_PA
from studies.two_waves.fit import rms
from studies.two_waves.points import Pairs

Complex = NDArray[np.complex128]


def eyring_points(pairs: Pairs) -> tuple[NDArray[np.float64], Complex, Complex, Complex]:
    """Return (tau0/E')(lambda/h)^2, a as fitted to the film, by (S5), and incompressible."""
    t = pairs.table
    deep = (t["flow_law"] == "eyring") & (t["tangent_factor_x"] > 100) & (t["along"] == 1)
    deep &= np.isfinite(t["attenuated_real"])
    rows = t[deep.to_numpy()]
    hertz_pa = rows["alphabar"] / rows["pressure_viscosity_per_pa"]
    # c/a = 2 K ph/E'.
    film_over_a = rows["central_film"] * 2 * _elliptic(rows["kappa"]) * hertz_pa
    film_over_a /= REDUCED_MODULUS_PA
    number = rows["eyring_stress_pa"] / REDUCED_MODULUS_PA
    number = (number * (rows["wavelength_x_over_a"] / film_over_a) ** 2).to_numpy()
    sign = np.sign(rows["slip"].to_numpy() - 1)
    fitted_a = rows["attenuated_real"].to_numpy() + 1j * rows["attenuated_imaginary"].to_numpy()
    rigid = 1 / (1 - 6j / np.pi**2 * sign * number)
    return number, fitted_a, pairs.attenuated[deep.to_numpy()], rigid


def _elliptic(kappa: pd.Series) -> NDArray[np.float64]:
    return np.asarray(ellipk(1 - kappa**2))


def eyring_table(pairs: Pairs) -> Table:
    """Return amplitudes deep in the Eyring regime over the number that decides them."""
    number, fitted_a, closed, rigid = eyring_points(pairs)
    rows = []
    edges = np.geomspace(0.01, 100, 9)
    for low, high in itertools.pairwise(edges):
        chosen = (number >= low) & (number < high)
        if chosen.any():
            ratio = np.abs(closed[chosen]) / np.abs(rigid[chosen])
            turn = np.abs(np.angle(closed[chosen] / rigid[chosen]))
            rows.append(
                (
                    f"{low:.2g} to {high:.2g}",
                    int(chosen.sum()),
                    float(np.abs(rigid[chosen]).mean()),
                    rms(np.abs(fitted_a[chosen]) - np.abs(closed[chosen])),
                    float(np.mean(ratio) - 1),
                    float(np.max(ratio) - 1),
                    float(np.max(turn)),
                )
            )
    names = ["(tau0/E')(lambda/h)^2", "points", "|a|, incompressible"]
    names += ["rms, fitted less closed |a|", "compressibility, mean", "largest", "turns by, rad"]
    caption = "Deep in the Eyring regime one number decides; what compressibility adds"
    return Table("two_waves_eyring", caption, pd.DataFrame(rows, columns=names))
