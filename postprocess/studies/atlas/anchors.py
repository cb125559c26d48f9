"""Points of the wide atlas of contacts that slide which are taken from the usual atlas."""

import numpy as np
import xarray as xr

from ehlwave.laws.atlas import load_atlas
from ehlwave.laws.atlas.kind import Kind, shipped
from ehlwave.laws.atlas.kinds import SLIDING
from ehlwave.laws.atlas.ranges import WAVE_RANGE
from studies.atlas.design import spread_contacts

COUNT, WAVES = 1024, 4
"""Contacts, and waves in each."""

SEED = 2210

NAMES = ("film", "pressure", "mean_rise", "discretisation", "wavelength_over_a", "angle_deg")
"""Variables of responses, as in :func:`studies.atlas.points.read_points`."""


def with_anchors(data: xr.Dataset, kind: Kind, count: int = COUNT) -> xr.Dataset:
    """Return points with more of them, within the usual ranges, from the usual atlas.

    There the wide atlas is not asked, but its networks have to meet the usual atlas at its ends.
    ``is_computed`` distinguishes the contacts.
    """
    added, both = anchors(kind, count), []
    for part, is_computed in ((data, True), (added, False)):
        mark = np.full(part.sizes["contact"], is_computed)
        both.append(part.assign(is_computed=("contact", mark))[[*added, "is_computed"]])
    joined = {
        name: (variable.dims, np.concatenate([part[name].values for part in both]))
        for name, variable in both[0].variables.items()
    }
    return xr.Dataset(joined, attrs=data.attrs)


def anchors(kind: Kind, count: int = COUNT) -> xr.Dataset:
    """Return the points within the usual ranges."""
    atlas, random = load_atlas(shipped(SLIDING)), np.random.default_rng(SEED)
    contacts = [
        contact
        for contact in spread_contacts(SLIDING.ranges, SEED, count)
        if not kind.beyond(contact)
    ]
    columns = {key: np.array([one[key] for one in contacts]) for key in kind.ranges}
    references = kind.references(columns)
    low, high = WAVE_RANGE
    films, found = [], []
    for contact, reference in zip(contacts, references, strict=True):
        chart = atlas.at(contact)
        film, pressure_ratio = chart.film(), chart.film_numbers[3]
        ratios = film.central_moes / reference[0], film.minimum_moes / film.central_moes
        stress = (film.stress or np.nan) / reference[2]
        smallest = np.log(ratios[1] * reference[0] / reference[1])
        errors = film.central_error, film.minimum_error, film.stress_error or np.nan, 0.0
        films.append([np.log(ratios[0]), smallest, np.log(stress), pressure_ratio, *errors])
        wave = low * (high / low) ** random.random(WAVES)
        angle = np.where(random.random(WAVES) < 0.5, 0.0, random.uniform(0, 90, WAVES))
        one = chart.responses(wave, angle)
        found.append([one.film, one.pressure, one.rise, one.error / 2, wave, angle])
    values = dict(zip(NAMES, np.concatenate(found, axis=1), strict=True))
    values = {name: one if name in NAMES[:2] else one.real for name, one in values.items()}
    names = [*kind.films, *(f"{name}_discretisation" for name in kind.films)]
    own = {name: ("contact", column) for name, column in columns.items()}
    own |= {
        name: ("contact", column) for name, column in zip(names, np.array(films).T, strict=True)
    }
    own["references"] = ("contact", "reference"), references
    own["responses"] = "contact", np.full(len(contacts), WAVES)
    own |= {name: ("point", column) for name, column in values.items()}
    return xr.Dataset(own)
