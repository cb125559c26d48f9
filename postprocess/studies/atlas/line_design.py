"""Where the atlas of line contacts is computed: they cost little, and their file is to be small."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from ehlwave.contact.line_contact import SLENDER_OVER_LINE, line_film, moes_per_line_film
from ehlwave.laws.atlas import Atlas
from ehlwave.laws.atlas.kinds import LINE
from ehlwave.laws.atlas.line import LineShape
from ehlwave.laws.atlas.line_rolling import COMPUTED
from ehlwave.laws.atlas.ranges import WAVE_RANGE
from studies import sweeps
from studies.atlas.design import GROUPS, random_contacts, spread_contacts, uncertain_contacts
from studies.atlas.waves import MARGIN, random_wavelength

CONTACTS = 32
"""Contacts of a batch."""

WAVES = 5
"""Waves of a contact."""

SEED = 2200

STEEP = 0.4, 0.2
"""The x of the law about which responses fall, and the share of waves that are evenly spread."""

INLET_CELLS = 16
"""Mesh sizes in the length of the inlet, (L/(gamma M))^(1/2)."""

FEWEST_CELLS = 128
"""Over a."""

SIZES = (1024, 2048, 4096, 8192)
LOW_LOAD = 40.0
"""The M below which the inlet is so long that the domain begins at X = -6.5, not -2.5."""

THICK_FILMS = ((4.0, (-26.0, 6.0)), (1.0, (-13.0, 3.0)))
"""H of the formula from which the pressure is so wide that the domain is larger still."""


def write_batch(folder: Path, batch: int, atlas: Atlas | None = None) -> Path:
    """Write the sweep of a batch: where the present atlas is least accurate, if any.

    Without an atlas it fills the ranges and a little below.
    """
    random = np.random.default_rng([batch, SEED])
    if atlas is not None:
        chosen = uncertain_contacts(atlas, SEED + batch, CONTACTS)
    else:
        chosen = spread_contacts(COMPUTED.ranges, SEED, CONTACTS, batch, LINE)
    rows = (case(one, wave) for one in chosen for wave in waves(one, random))
    return sweeps.write_sweep(folder, f"line-{batch:02d}", rows, GROUPS)


def write_validation(folder: Path, count: int = 150, each: int = 2) -> Path:
    """Write the sweep that the atlas is judged by: random contacts and waves."""
    random, found = np.random.default_rng(1997), []
    for contact in random_contacts(LINE, random, count):
        found += [case(contact, random_wavelength(random)) for _ in range(each)]
    return sweeps.write_sweep(folder, "line-validation", found, GROUPS)


def waves(contact: Mapping[str, float], random: np.random.Generator) -> Iterator[float]:
    """Yield wavelengths over a, most of them where the response falls from 1 to 0."""
    logs = np.log(np.geomspace(WAVE_RANGE[0] / MARGIN, WAVE_RANGE[1] * MARGIN, 400))
    middle, even = STEEP
    log_x = LineShape.of_keys(contact).seen(np.exp(logs), 0.0).coordinates[:, 0]
    density = 1 / np.cosh(log_x - np.log(middle))
    density = (1 - even) * density / density.mean() + even
    shares = (np.arange(WAVES) + random.random(WAVES)) / WAVES
    yield from np.exp(np.interp(shares * density.sum(), np.cumsum(density), logs)).tolist()


def case(
    contact: Mapping[str, float],
    wave: float,
    inlet_cells: float = INLET_CELLS,
    sizes: Sequence[int] = SIZES,
) -> sweeps.Row:
    """Return a case with a grid that resolves its inlet, of these sizes as far as they go."""
    m, l = contact["load_parameter_m"], contact["lubricant_parameter_l"]
    x_min, x_max = domain(m, l)
    inlet = min(1.0, (l / (SLENDER_OVER_LINE * m**1.5)) ** 0.5)
    wanted = (x_max - x_min) * max(inlet_cells / inlet, FEWEST_CELLS)
    cells = next((size for size in sizes if size >= wanted), sizes[-1])
    keys = {"radius_ratio_d": 0.0, "wavelength_x_over_a": float(f"{wave:.7g}")}
    return {**contact, **keys, "cells_x": cells, "x_min": x_min, "x_max": x_max}


def domain(m: float, l: float) -> tuple[float, float]:
    """Return where the domain begins and ends."""
    film = line_film(m, l) / moes_per_line_film(m)
    usual = (-6.5 if m < LOW_LOAD else -2.5), 1.5
    return next((ends for thick, ends in THICK_FILMS if film > thick), usual)
