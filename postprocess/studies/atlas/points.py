"""Results of the sweeps of the atlas, as contacts and their responses."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ehlwave.contact.formula import wave_and_direction
from ehlwave.laws.atlas.kinds import LINE_NEWTONIAN, ROLLING, Kind
from ehlwave.laws.atlas.sliding import MODULUS_PA, conditions_of
from ehlwave.results.read import read_results
from studies.atlas.centre import centre_pressures

Floats = NDArray[np.float64]

LARGEST_CORRECTION = 0.03
"""Change of a response by extrapolation, in units of Ai: beyond it the grid was too coarse."""

SAME_CASE = 1e-3
"""Distance, in logarithms of the keys, of cases that differ by rounding alone."""

LARGEST_RISE = 3.0
"""Rise of the mean film: larger rises come from long waves that the load, not the oil, balances."""

LARGEST_PRESSURE = 1.02
"""P at the centre; more than that is of a spike elsewhere."""

LEFT_BY_EXTRAPOLATION = 0.25
"""Share of the correction, as the next grid finds it."""


def read_points(
    paths: Sequence[Path], rises: Path | None = None, kind: Kind = ROLLING
) -> xr.Dataset:
    """Return contacts and the responses of each, without `error`, of finished sweeps.

    Contacts beyond the limits of the kind are left out. Film and pressure responses are those at
    mesh size 0; films are extrapolated likewise. With `rises`, the results of
    :func:`studies.atlas.design.write_rises`, oblique waves have the rise of the mean film, too;
    without them it is NaN.
    """
    results = read_results(paths)
    table = _with_modulus(results.to_dataframe().reset_index(drop=True))
    film = table["harmonic_extrapolated_real"] + 1j * table["harmonic_extrapolated_imaginary"]
    pressure = (
        table["harmonic_pressure_extrapolated_real"]
        + 1j * table["harmonic_pressure_extrapolated_imaginary"]
    )
    table["correction"] = np.abs(film - table["harmonic_real"] - 1j * table["harmonic_imaginary"])
    table = table[np.isfinite(table["correction"]) & (table["correction"] < LARGEST_CORRECTION)]
    keys = list(kind.ranges)
    table = table[[not kind.beyond(one) for one in table[keys].to_dict("records")]]
    groups = table.groupby(keys, sort=True)
    contacts = groups.first().reset_index()
    order = np.argsort(groups.ngroup().to_numpy(), kind="stable")
    table, counts = table.iloc[order], groups.size().to_numpy()
    wave, along = wave_and_direction(table["wavelength_x_over_a"], table["wavelength_y_over_a"])
    angle = np.degrees(np.arccos(np.sqrt(along)))
    points = {
        "wavelength_over_a": wave,
        "angle_deg": angle,
        "film": film[table.index].to_numpy(complex),
        "pressure": pressure[table.index].to_numpy(complex),
        "mean_rise": _rises(table, rises, keys),
        "discretisation": (LEFT_BY_EXTRAPOLATION * table["correction"]).to_numpy(float),
    }
    data = {name: ("point", values) for name, values in points.items()}
    data["responses"] = "contact", counts
    references = kind.references(contacts)
    data["references"] = ("contact", "reference"), references
    films = _films(contacts, kind, references)
    data |= {name: ("contact", values) for name, values in films.items()}
    origin = {
        key: str(results[key].values[0]) for key in ("program_version", "git_revision", "compiler")
    }
    return xr.Dataset(data, attrs={"kind": kind.name, **origin})


def contact_of(data: xr.Dataset) -> NDArray[np.intp]:
    """Return the contact of each response: responses of the first contact come first."""
    return np.repeat(np.arange(data.sizes["contact"]), data["responses"].values)


def waves_of(data: xr.Dataset) -> tuple[Floats, Floats]:
    """Return wavelengths over a and angles, degrees."""
    return data["wavelength_over_a"].values, data["angle_deg"].values


def film_numbers(data: xr.Dataset, names: Sequence[str]) -> Floats:
    """Return the data of contacts by these names, shape (contacts, names)."""
    return np.stack([data[name].values for name in names], axis=1)


def _rises(table: pd.DataFrame, oblique: Path | None, keys: Sequence[str]) -> np.ndarray:
    """Return the rise of the mean film by each wave; for products of cosines, by a single wave."""
    rise = (table["mean_film_rise"] / table["amplitude_over_film"]).to_numpy(float, copy=True)
    is_product = (table["wavelength_x_over_a"] > 0) & (table["wavelength_y_over_a"] > 0)
    rise[is_product] = np.nan
    if oblique is not None:
        single = _with_modulus(read_results(oblique).to_dataframe())
        single = single[np.isfinite(single["mean_film_rise"])]
        distance, which = cKDTree(_places(single, keys)).query(_places(table, keys))
        found = (single["mean_film_rise"] / single["amplitude_over_film"]).to_numpy(float)
        matches = is_product.to_numpy() & (distance < SAME_CASE)
        rise[matches] = found[which[matches]]
    rise[np.abs(rise) > LARGEST_RISE] = np.nan
    return rise


def _places(table: pd.DataFrame, contact: Sequence[str]) -> np.ndarray:
    """Return the columns that identify cases."""
    keys = [*contact, "wavelength_x_over_a", "wavelength_y_over_a"]
    return np.log(np.maximum(table[keys].to_numpy(float), 1e-9))


def _with_modulus(table: pd.DataFrame) -> pd.DataFrame:
    """Return cases with E' tau0 where they have an Eyring stress."""
    return table.assign(stress_modulus_pa2=table.get("eyring_stress_pa", np.nan) * MODULUS_PA)


def _films(contacts: pd.DataFrame, kind: Kind, base: Floats) -> dict[str, np.ndarray]:
    """Return the keys of contacts and the logarithms of their films, and of friction.

    Films grow with finer grids, also smallest films; the estimated error is the missing part.
    """
    central = contacts["central_film_moes"] * (1 + contacts["central_film_error"])
    smallest = contacts["minimum_film"] * (1 + contacts["minimum_film_error"])
    smallest_moes = smallest * contacts["central_film_moes"] / contacts["central_film"]
    discretisation = (
        LEFT_BY_EXTRAPOLATION * contacts[["central_film_error", "minimum_film_error"]].to_numpy()
    )
    numbers = {name: contacts[name].to_numpy(float) for name in kind.ranges}
    if "pressure_ratio" in kind.films:
        numbers |= _centre(contacts, kind)
    if "friction_ratio" in kind.films:
        numbers |= _frictions(contacts, base[:, 2], discretisation[:, 0])
    return numbers | {
        "film_ratio": np.log(central / base[:, 0]).to_numpy(float),
        "minimum_ratio": np.log(smallest_moes / central * base[:, 0] / base[:, 1]).to_numpy(float),
        "film_ratio_discretisation": np.hypot(discretisation[:, 0], contacts["domain_error"]),
        "minimum_ratio_discretisation": discretisation[:, 1],
    }


def _centre(contacts: pd.DataFrame, kind: Kind) -> dict[str, np.ndarray]:
    """Return ln of the pressure at the centre: the largest, but for a spike."""
    largest = np.minimum(contacts["max_pressure"], LARGEST_PRESSURE).to_numpy(float)
    pressure = np.log(centre_pressures(contacts) if kind is LINE_NEWTONIAN else largest)
    return {"pressure_ratio": pressure, "pressure_ratio_discretisation": np.zeros(pressure.size)}


def _frictions(
    contacts: pd.DataFrame, expected: np.ndarray, film_error: np.ndarray
) -> dict[str, np.ndarray]:
    """Return ln of the mean shear stress over the expected stress, and its error.

    The stress is as the logarithm of the film, so that it errs at most as the film does.
    """
    mean_pa = np.array([c.hertz_pa / c.peak_over_mean for c in conditions_of(contacts)])
    mean = contacts["friction_coefficient"] * mean_pa / contacts["eyring_stress_pa"]
    return {
        "friction_ratio": np.log(np.abs(mean) / expected).to_numpy(float),
        "friction_ratio_discretisation": film_error,
    }
