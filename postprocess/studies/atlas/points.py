"""What the sweeps of the atlas came to, as contacts and their responses."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from ehlwave.atlas.ranges import CONTACT_RANGES
from ehlwave.deform.conditions import moes_film
from ehlwave.formula import wave_and_direction
from ehlwave.read import read_results

LARGEST_CORRECTION = 0.03
"""Of a response by extrapolation, in units of Ai: beyond it the grid was too coarse."""

LEFT_BY_EXTRAPOLATION = 0.25
"""Of the correction, as the next grid finds it."""


def read_points(paths: Sequence[Path]) -> xr.Dataset:
    """Return contacts and the responses of each, without `error`, of finished sweeps.

    Film and pressure responses are those at mesh size 0; films are extrapolated likewise.
    """
    results = read_results(paths)
    table = results.to_dataframe().reset_index(drop=True)
    film = table["harmonic_extrapolated_real"] + 1j * table["harmonic_extrapolated_imaginary"]
    table["correction"] = np.abs(film - table["harmonic_real"] - 1j * table["harmonic_imaginary"])
    table = table[np.isfinite(table["correction"]) & (table["correction"] < LARGEST_CORRECTION)]
    keys = list(CONTACT_RANGES)
    groups = table.groupby(keys, sort=True)
    contacts = groups.first().reset_index()
    of_contact = groups.ngroup().to_numpy()
    wave, along = wave_and_direction(table["wavelength_x_over_a"], table["wavelength_y_over_a"])
    angle = np.degrees(np.arccos(np.sqrt(along)))
    points = {
        "of_contact": of_contact.astype(np.uint16),
        "wavelength_over_a": wave.astype(np.float32),
        "angle_deg": angle.astype(np.float32),
        "film_real": table["harmonic_extrapolated_real"].to_numpy(np.float32),
        "film_imaginary": table["harmonic_extrapolated_imaginary"].to_numpy(np.float32),
        "pressure_real": table["harmonic_pressure_extrapolated_real"].to_numpy(np.float32),
        "pressure_imaginary": table["harmonic_pressure_extrapolated_imaginary"].to_numpy(
            np.float32
        ),
        "discretisation": (LEFT_BY_EXTRAPOLATION * table["correction"]).to_numpy(np.float32),
    }
    data = {name: ("point", values) for name, values in points.items()}
    data |= {name: ("contact", values) for name, values in _films(contacts).items()}
    origin = {
        key: str(results[key].values[0]) for key in ("program_version", "git_revision", "compiler")
    }
    return xr.Dataset(data, attrs=origin)


def _films(contacts: pd.DataFrame) -> dict[str, np.ndarray]:
    """Return the keys of contacts and the logarithms of their films.

    Films grow with finer grids, smallest ones too; the estimated error is what is missing.
    """
    m, l, d = (contacts[key].to_numpy() for key in list(CONTACT_RANGES)[:3])
    moes = np.array([moes_film(*one) for one in zip(m, l, d, strict=True)])
    central = contacts["central_film_moes"] * (1 + contacts["central_film_error"])
    smallest = contacts["minimum_film"] * (1 + contacts["minimum_film_error"])
    smallest_moes = smallest * contacts["central_film_moes"] / contacts["central_film"]
    discretisation = (
        LEFT_BY_EXTRAPOLATION * contacts[["central_film_error", "minimum_film_error"]].to_numpy()
    )
    numbers = {name: contacts[name].to_numpy(np.float32) for name in CONTACT_RANGES}
    return numbers | {
        "film_ratio": np.log(central / moes).to_numpy(np.float32),
        "minimum_ratio": np.log(smallest_moes / central).to_numpy(np.float32),
        "film_ratio_discretisation": np.hypot(
            discretisation[:, 0], contacts["domain_error"]
        ).astype(np.float32),
        "minimum_ratio_discretisation": discretisation[:, 1].astype(np.float32),
    }
