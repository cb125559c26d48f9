"""Which contacts the later batches of the sliding atlas have.

The first batches fill its ranges, the next ones go one by one where it is worst. Then batches come
in blocks: half of a block fills the ranges, half goes where the atlas of the batches before the
block is worst, all chosen at once, since a fit takes as long as several batches.
"""

from pathlib import Path

import numpy as np

from ehlwave.atlas import Atlas
from studies import sweeps
from studies.atlas.design import CONTACTS, SLIDING_DESIGN, contacts, rows, worst_contacts

FIRST = 14
"""The first batch of the first block."""

BLOCK = 16
"""Batches of one: those with even numbers fill the ranges."""

CANDIDATES = 4096
"""Contacts of which those of a block are chosen."""


def known_before(batch: int) -> int | None:
    """Return how many batches have to be known before one is chosen; None if none has."""
    return None if (batch - FIRST) % 2 == 0 else batch - (batch - FIRST) % BLOCK


def write_batch(folder: Path, batch: int, atlas: Atlas | None) -> Path:
    """Write the sweep of a batch from FIRST on, the odd ones by the atlas of those before."""
    random = np.random.default_rng([batch, SLIDING_DESIGN.seed])
    if atlas is None:
        chosen = contacts(SLIDING_DESIGN, batch)
    else:
        start, share = batch - (batch - FIRST) % BLOCK, BLOCK // 2
        wanted = worst_contacts(
            atlas, SLIDING_DESIGN.seed + 1000 + start, share * CONTACTS, CANDIDATES
        )
        chosen = wanted[(batch - start) // 2 :: share]
    name = f"sliding-{batch:02d}"
    return sweeps.write_sweep(
        folder, name, rows(SLIDING_DESIGN, chosen, random), SLIDING_DESIGN.groups
    )
