"""The networks of an atlas, and the kind of contacts that they are for."""

from dataclasses import replace

import numpy as np

from ehlwave.laws.atlas.kind import Kind
from ehlwave.laws.atlas.stored import Stored, committee_of, errors_of


class Networks:
    """Networks of films, waves and their errors.

    Parameters
    ----------
    data : Stored
        As :func:`ehlwave.laws.atlas.stored.read_stored` reads it.
    kind : Kind
        Of its contacts.
    """

    def __init__(self, data: Stored, kind: Kind) -> None:
        """Take the networks."""
        self.data = data
        self.kind = kind
        self.films = replace(committee_of(data, "films"), precision=np.float64)
        """Return the films that the kind names, by the coordinates of contacts."""
        self.waves = replace(committee_of(data, "waves"), precision=np.float64)
        """Numbers of waves, by their coordinates after the coordinates of their contacts."""
        self.film_errors = errors_of(data, "film_errors")
        """Errors of the data of contacts, by their coordinates."""
        self.errors = errors_of(data, "wave_errors")
        """Errors of film responses, shape (n, 1), by the coordinates of their numbers."""

    @property
    def name(self) -> str:
        """Return its description and origin.

        Examples
        --------
        >>> import ehlwave
        >>> ehlwave.load_atlas().name.split("(")[0]
        'atlas of 6912 responses of 768 contacts '
        """
        data = self.data
        return (
            f"atlas of {data.attrs['responses']} responses of {data.attrs['contacts']} contacts "
            f"({data.attrs['program']}, {data.attrs['checksum'][:8]})"
        )
