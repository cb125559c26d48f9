"""The atlas: read from its file, ready for contacts."""

import json
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

import numpy as np
import xarray as xr

from ehlwave.atlas.chart import NEIGHBOURHOOD, Chart
from ehlwave.atlas.coordinates import Floats
from ehlwave.atlas.kinds import LINE, ROLLING, SLIDING, Kind, kind_of
from ehlwave.atlas.process import Correlation, Process, Scales
from ehlwave.atlas.stored import (
    checksum,
    contacts_alone,
    film_errors,
    film_numbers,
    numbers_of,
    responses_of,
    seen_of,
)
from ehlwave.deform.conditions import Conditions
from ehlwave.deform.line_contact import ROLLS_ALONE
from ehlwave.errors import RangeError, ResultsError

FORMAT_NAME = "ehlwave-atlas"


class Atlas:
    """Computed responses and films, interpolated between contacts and waves.

    Parameters
    ----------
    data : xarray.Dataset
        As :func:`load_atlas` reads it; ``scripts/atlas`` makes it.
    """

    def __init__(self, data: xr.Dataset) -> None:
        """Solve for the weights of all points: a second for 4000 of them."""
        if data.attrs.get("format") != FORMAT_NAME:
            raise ResultsError(f"not a file of scripts/atlas (format {data.attrs.get('format')!r})")
        self.data = data
        self.kind: Kind = kind_of(data)
        self.scales = {
            name: Scales(np.array(one["contact"]), np.array(one["wave"]), one["noise"])
            for name, one in json.loads(data.attrs["length_scales"]).items()
        }
        self._seen = seen_of(data)
        self.points = responses_of(data, self._seen)
        self.near = Correlation(self.points.waves, self.scales["film"].waves * NEIGHBOURHOOD)
        self._processes: dict[str, Process] = {}
        films = film_numbers(data)
        self.film_means = films.mean(axis=0)
        of_films = contacts_alone(self.points.contacts)
        self.films = Process(of_films, films - self.film_means, self.scales["smooth"])
        self.misfit = data["error"].values.astype(float) ** 2
        self.film_misfit = film_errors(data) ** 2

    def process(self, part: str) -> Process:
        """Return the interpolation of a part of the responses; its weights are found once."""
        if part not in self._processes:
            points, values = numbers_of(self.data, part, self._seen)
            self._processes[part] = Process(points, values, self.scales[part])
        return self._processes[part]

    @property
    def has_rises(self) -> bool:
        """Whether it knows what waves add to the mean film."""
        return "mean_rise" in self.data

    @property
    def name(self) -> str:
        """What it is and where it comes from."""
        data = self.data
        return (
            f"atlas of {data.sizes['point']} responses of {data.sizes['contact']} contacts "
            f"({data.attrs['program']}, {data.attrs['checksum'][:8]})"
        )

    @property
    def contact_scales(self) -> Floats:
        """Lengths over which responses change with the coordinates of the contact."""
        return self.scales["film"].contacts

    @property
    def film_scales(self) -> Floats:
        """Lengths over which errors of films are alike."""
        return self.scales["smooth" if self.kind is SLIDING else "film"].contacts

    def at(self, keys: Mapping[str, float]) -> "Chart":
        """Return the chart of one contact.

        Parameters
        ----------
        keys : mapping
            Those of its kind: :mod:`ehlwave.atlas.ranges`.

        Raises
        ------
        RangeError
            If one lies outside its range.
        """
        for key, (low, high) in self.kind.ranges.items():
            if not low * (1 - 1e-9) <= keys[key] <= high * (1 + 1e-9):
                name = "eyring_stress_pa reduced_modulus_pa" if "stress" in key else key
                raise RangeError(
                    f"{name} = {keys[key]:.5g} lies outside the atlas, which holds {low:g} to "
                    f"{high:g}: name a formula, or compute it (ehlwave.Case, a harmonic table)"
                )
        return Chart(self, keys)


def shipped(kind: Kind) -> Path:
    """Return the file of this package."""
    return Path(__file__).with_name(f"{kind.name}.nc")


SHIPPED = shipped(ROLLING)
"""The atlas of contacts that roll."""


def atlas_for(conditions: Conditions, atlas: Atlas | None = None) -> Atlas:
    """Return the atlas that a contact is looked up in: this one if it is of the kind, else ours.

    A Ree-Eyring oil under slip has one of its own, and so have line contacts; all else rolls as far
    as the atlas knows.

    Raises
    ------
    RangeError
        Of a line contact under slip, unless the oil is Newtonian: the film is that of rolling then.
    """
    kind = SLIDING if conditions.has_sliding_atlas else ROLLING
    if conditions.is_line:
        if conditions.slip_parameter != 1 and conditions.oil.name != "Newtonian":
            raise RangeError(ROLLS_ALONE)
        kind = LINE
    return atlas if atlas is not None and atlas.kind is kind else load_atlas(shipped(kind))


@lru_cache(maxsize=4)
def load_atlas(path: str | Path = SHIPPED) -> Atlas:
    """Return the atlas of a file, by default the one of this package for contacts that roll.

    Read once a process.

    Raises
    ------
    ResultsError
        If it cannot be read, is none, or its checksum is not that of its data.
    """
    try:
        with xr.open_dataset(path) as opened:
            data = opened.load()
    except (OSError, ValueError) as error:
        raise ResultsError(f"{path}: cannot be read as an atlas ({error})") from error
    if checksum(data) != data.attrs.get("checksum"):
        raise ResultsError(f"{path}: its checksum is not that of its data: the file is damaged")
    return Atlas(data)
