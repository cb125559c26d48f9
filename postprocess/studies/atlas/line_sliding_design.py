"""Where the atlas of line contacts that slide is computed: as that of those that roll."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ehlwave.atlas import Atlas
from ehlwave.atlas.line_sliding import LINE_SLIDING_RANGES
from ehlwave.atlas.ranges import WAVE_RANGE
from studies import sweeps
from studies.atlas import line_design
from studies.atlas.design import (
    MARGIN,
    SLIDING_DESIGN,
    as_keys,
    contact_at,
    spread_contacts,
    uncertain_contacts,
)
from studies.atlas.line_design import waves

CONTACTS = 32
"""Of one batch."""

SEED, VALIDATION_SEED = 2300, 2031

SIZES = (1024, 1536, 2048, 3072, 4096, 6144, 8192)
COARSER = 0.625
"""Of the mesh sizes in the length of the inlet of contacts that roll: there are many contacts."""

EXTENDED = ("load_parameter_m", "lubricant_parameter_l")
"""Keys of which contacts lie a little below the range, too."""


def write_batch(folder: Path, batch: int, atlas: Atlas | None = None) -> Path:
    """Write the sweep of a batch: where the atlas so far knows least, if there is one.

    Without one it fills the ranges and a little below.
    """
    random = np.random.default_rng([batch, SEED])
    ranges = {
        key: (low / MARGIN if key in EXTENDED else low, high)
        for key, (low, high) in LINE_SLIDING_RANGES.items()
    }
    if atlas is not None:
        chosen = uncertain_contacts(atlas, SEED + batch, CONTACTS)
    else:
        chosen = spread_contacts(ranges, SEED, CONTACTS, batch)
    rows = (case(one, wave, COARSER) for one in chosen for wave in waves(one, random))
    return sweeps.write_sweep(folder, f"line_sliding-{batch:02d}", rows, SLIDING_DESIGN.groups)


def case(contact: Mapping[str, float], wave: float, share: float = 1.0) -> sweeps.Row:
    """Return a case with a grid that resolves its inlet, with a share of what rolling ones have."""
    found = line_design.case(contact, wave, share * line_design.INLET_CELLS, SIZES)
    return as_keys(found)


def write_validation(folder: Path, count: int = 150, each: int = 2) -> Path:
    """Write the sweep that the atlas is judged by: random contacts and waves."""
    random, found = np.random.default_rng(VALIDATION_SEED), []
    low, high = WAVE_RANGE
    for _ in range(count):
        shares = random.random(len(LINE_SLIDING_RANGES)).tolist()
        contact = contact_at(shares, LINE_SLIDING_RANGES)
        drawn = (low * (high / low) ** random.random() for _ in range(each))
        found += [case(contact, wave) for wave in drawn]
    return sweeps.write_sweep(folder, "line_sliding-validation", found, SLIDING_DESIGN.groups)
