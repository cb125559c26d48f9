"""The atlas: read from its file, ready for contacts."""

import json
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

import numpy as np
import xarray as xr

from ehlwave.atlas.chart import Chart
from ehlwave.atlas.coordinates import Floats
from ehlwave.atlas.interpolated import scales_of
from ehlwave.atlas.kinds import LINE, ROLLING, SLIDING, Kind, kind_of
from ehlwave.atlas.process import Process, correlation
from ehlwave.atlas.stored import checksum, contacts_alone, film_errors, film_numbers
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
        """Solve for the weights of the films."""
        if data.attrs.get("format") != FORMAT_NAME:
            raise ResultsError(f"not a file of scripts/atlas (format {data.attrs.get('format')!r})")
        self.data = data
        self.kind: Kind = kind_of(data)
        self.waves = self.kind.waves(data, self.kind)
        scales = scales_of(data)
        self._responses = int(data["responses"].sum())
        self._contacts = self.kind.coordinates(data)
        films = film_numbers(data, self.kind)
        self._film_means = films.mean(axis=0)
        of_films = contacts_alone(self._contacts)
        self._films = [
            Process(of_films, values[:, None], scales[name])
            for name, values in zip(self.kind.films, (films - self._film_means).T, strict=True)
        ]
        self._film_misfit = film_errors(data, self.kind) ** 2
        self._film_reach = np.array(json.loads(data.attrs["film_reach"]))
        self.contact_scales = scales["film"].contacts if "film" in scales else self._film_reach
        """Lengths over which responses, or errors of films, change from contact to contact."""
        self._film_factors = np.array(json.loads(data.attrs["film_error_factors"]))

    @property
    def has_rises(self) -> bool:
        """Whether it knows what waves add to the mean film."""
        return "mean_rise" in self.data

    def film_numbers(self, place: Floats) -> Floats:
        """Return what the films of a contact are interpolated by, those that its kind names."""
        found = [process.at_contact(place).sum() for process in self._films]
        return np.array(found) + self._film_means

    def film_errors(self, place: Floats) -> Floats:
        """Return their errors: of contacts near by, times what holds the share that is wanted."""
        near = correlation(place[None, :], self._contacts, self._film_reach)[0]
        squares = near @ self._film_misfit / np.maximum(near.sum(), 1e-300)
        return np.asarray(self._film_factors * np.sqrt(squares))

    @property
    def name(self) -> str:
        """What it is and where it comes from."""
        data = self.data
        return (
            f"atlas of {self._responses} responses of {data.sizes['contact']} contacts "
            f"({data.attrs['program']}, {data.attrs['checksum'][:8]})"
        )

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
