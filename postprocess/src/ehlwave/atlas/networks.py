"""What an atlas knows: its networks, and the kind of contacts that they are of."""

import xarray as xr

from ehlwave.atlas.kind import Kind
from ehlwave.atlas.stored import committee_of, errors_of


class Networks:
    """Networks of films, waves and their errors.

    Parameters
    ----------
    data : xarray.Dataset
        As :func:`ehlwave.atlas.stored.read_stored` reads it.
    kind : Kind
        Of its contacts.
    """

    def __init__(self, data: xr.Dataset, kind: Kind) -> None:
        """Take the networks."""
        self.data = data
        self.kind = kind
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
        """What it is and where it comes from.

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
