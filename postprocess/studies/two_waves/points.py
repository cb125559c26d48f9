"""The points of the study: waves in pure rolling, and the same waves under slip."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.special import ellipk

from ehlwave.contact.formula import wave_and_direction
from ehlwave.contact.oils import Oil
from ehlwave.results.read import read_results
from studies.two_waves.cases import REDUCED_MODULUS_PA

Floats = NDArray[np.float64]

CONDITION = (
    "load_parameter_m",
    "lubricant_parameter_l",
    "radius_ratio_d",
    "pressure_viscosity_per_pa",
)
WAVE = ("wavelength_x_over_a", "wavelength_y_over_a")

DEFAULTS = {"pressure_viscosity_per_pa": Oil().pressure_viscosity_per_pa, "flow_law": "newtonian"}

LARGEST_ERROR = 0.03
"""Error of Ad/Ai from two grids, absolute: points beyond it measure the grid rather than waves."""

SOLVED = ("converged", "inaccurate")
"""Statuses of solved cases. The accuracy of a sweep is relative to Ad/Ai, which excludes small
responses that are accurate in units of Ai.
"""

LEAST_LOAD = 5.0


@dataclass(frozen=True)
class Pairs:
    """Waves under slip with the results of the same waves in pure rolling; arrays over points.

    ``table`` holds M, L, D, gamma, kappa, alphabar, slip and the like, ``film`` and ``rolling`` the
    responses over Ai at the contact centre, amplitudes extrapolated to mesh size 0; ``attenuated``
    in closed form at the computed contact centre, ``mismatch`` and ``mismatch_rolling`` the
    mismatches of the wave numbers there, see :class:`ehlwave.contact.two_waves.Launch`; ``error``
    the error bar of ``film``.
    """

    table: pd.DataFrame
    film: NDArray[np.complex128]
    rolling: NDArray[np.complex128]
    attenuated: NDArray[np.complex128]
    mismatch: NDArray[np.complex128]
    mismatch_rolling: NDArray[np.complex128]
    error: NDArray[np.float64]

    def part(self, chosen: NDArray[np.bool_]) -> "Pairs":
        """Return the chosen points."""
        arrays = (self.film, self.rolling, self.attenuated, self.mismatch, self.mismatch_rolling)
        table = self.table[chosen].reset_index(drop=True)
        return Pairs(table, *(one[chosen] for one in arrays), self.error[chosen])


@dataclass(frozen=True)
class Rolling:
    """Waves in pure rolling: ``table`` as of :class:`Pairs`, response over Ai, its error bar."""

    table: pd.DataFrame
    film: NDArray[np.complex128]
    error: NDArray[np.float64]

    def part(self, chosen: NDArray[np.bool_]) -> "Rolling":
        """Return the chosen points."""
        table = self.table[chosen].reset_index(drop=True)
        return Rolling(table, self.film[chosen], self.error[chosen])


def rolling_points(*paths: Path) -> Rolling:
    """Return the resolved points in pure rolling of these sweeps, each wave once.

    Below gamma M = ``LEAST_LOAD`` there is no Hertzian contact to speak of.

    Raises as :func:`ehlwave.results.read.read_results`.
    """
    table = _usable(paths)
    table = table[(table["slip_parameter"] == 1) & (table["flow_law"] == "newtonian")]
    table = table[table["gamma"] * table["load_parameter_m"] >= LEAST_LOAD]
    table = table.drop_duplicates("wave").reset_index(drop=True)
    return Rolling(_with_names(table), _film(table), _error(table))


def slip_points(*paths: Path) -> Pairs:
    """Return the resolved points under slip of which the wave was rolled, too."""
    table = _usable(paths)
    rolled = table[(table["slip_parameter"] == 1) & (table["flow_law"] == "newtonian")]
    rolled = rolled.drop_duplicates("wave").set_index("wave")
    under = table[(table["slip_parameter"] != 1) & table["wave"].isin(rolled.index)]
    under = under.reset_index(drop=True)
    rolled = rolled.loc[under["wave"]]
    along = 2 * np.pi / under["wavelength_x_over_a"].to_numpy()
    return Pairs(
        _with_names(under),
        _film(under),
        _film(rolled),
        _complex(under, "attenuated_formula"),
        _complex(under, "psi_formula") - along,
        _complex(rolled, "psi_formula") - along,
        _error(under),
    )


def _usable(paths: tuple[Path, ...]) -> pd.DataFrame:
    table = read_results(paths).to_dataframe()
    error = table["harmonic_error"] * table["harmonic_ratio"]
    fine = table["status"].isin(SOLVED) & (table["is_resolved"] != 0)
    table = table[fine & (error <= LARGEST_ERROR)].copy()
    # Files have columns of the keys that vary there.
    for name, value in DEFAULTS.items():
        given = table[name] if name in table else pd.Series(np.nan, table.index)
        table[name] = given.replace("", np.nan).fillna(value)
    table["condition"] = _joined(table, CONDITION)
    table["wave"] = _joined(table, (*CONDITION, *WAVE))
    return table


def _joined(table: pd.DataFrame, columns: tuple[str, ...]) -> pd.Series:
    # Files may hold the same number in other last bits.
    return table[list(columns)].map("{:.6g}".format).agg("|".join, axis=1)


def _with_names(table: pd.DataFrame) -> pd.DataFrame:
    wave, along = wave_and_direction(*(table[name].to_numpy() for name in WAVE))
    return table.assign(
        m=table["load_parameter_m"],
        l=table["lubricant_parameter_l"],
        d=table["radius_ratio_d"],
        slip=table["slip_parameter"],
        load=table["gamma"] * table["load_parameter_m"],
        wave_n=wave,
        along=along,
        thinning=_thinning(table),
    )


def _thinning(table: pd.DataFrame) -> Floats:
    """Return B0, see :class:`ehlwave.contact.medium.Medium`."""
    is_thinned = (table["flow_law"] == "eyring").to_numpy()
    if not is_thinned.any():
        return np.zeros(len(table))
    hertz_pa = table["alphabar"] / table["pressure_viscosity_per_pa"]
    stress = ellipk(1 - table["kappa"] ** 2) * hertz_pa**2
    stress /= table["eyring_stress_pa"].where(is_thinned) * REDUCED_MODULUS_PA
    slip = (table["slip_parameter"] - 1).abs()
    b0 = table["lambdabar"] * stress / 3 * slip / table["central_film"]
    return b0.fillna(0.0).to_numpy()


def _film(table: pd.DataFrame) -> NDArray[np.complex128]:
    film = _complex(table, "harmonic")
    extrapolated = (table["harmonic_extrapolated"] / table["harmonic_ratio"]).to_numpy()
    return film * np.where(np.isfinite(extrapolated), extrapolated, 1.0)


def _error(table: pd.DataFrame) -> NDArray[np.float64]:
    return np.nan_to_num((table["harmonic_error"] * table["harmonic_ratio"]).to_numpy())


def _complex(table: pd.DataFrame, name: str) -> NDArray[np.complex128]:
    return table[f"{name}_real"].to_numpy() + 1j * table[f"{name}_imaginary"].to_numpy()
