"""The atlas: read from its file, ready for contacts."""

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

import xarray as xr

from ehlwave.atlas.chart import Chart
from ehlwave.atlas.kinds import KINDS, LINE, ROLLING, SLIDING, Kind
from ehlwave.atlas.stored import checksum, committee_of, errors_of
from ehlwave.contact.conditions import Conditions
from ehlwave.contact.line_contact import ROLLS_ALONE
from ehlwave.errors import RangeError, ResultsError

FORMAT_NAME = "ehlwave-atlas 2"


class Atlas:
    """Computed responses and films, as networks know them between contacts and waves.

    Parameters
    ----------
    data : xarray.Dataset
        As :func:`load_atlas` reads it; ``scripts/atlas`` makes it.
    """

    def __init__(self, data: xr.Dataset) -> None:
        """Take the networks."""
        if data.attrs.get("format") != FORMAT_NAME:
            raise ResultsError(f"not a file of scripts/atlas (format {data.attrs.get('format')!r})")
        self.data = data
        self.kind: Kind = KINDS[data.attrs["kind"]]
        self.films = committee_of(data, "films")
        """What is known of contacts, those that the kind names, by their coordinates."""
        self.waves = committee_of(data, "waves")
        """Numbers of waves, by their coordinates after those of their contacts."""
        self.film_errors = errors_of(data, "film_errors")
        """Errors of what is known of contacts, by their coordinates."""
        self.errors = errors_of(data, "wave_errors")
        """Errors of film responses, shape (n, 1), by the same as their numbers."""

    @property
    def name(self) -> str:
        """What it is and where it comes from."""
        data = self.data
        return (
            f"atlas of {data.attrs['responses']} responses of {data.attrs['contacts']} contacts "
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
