"""Which contacts the later batches of the sliding atlas have.

The first batches fill its ranges, the next ones go one by one where it is worst. Then batches come
in blocks: half of a block fills the ranges, half goes where the atlas of the batches before the
block is worst, all chosen at once, since a fit takes as long as several batches.
"""

from ehlwave.atlas import Atlas
from studies.atlas.design import CONTACTS, SLIDING_DESIGN, contacts, worst_contacts

FIRST = 14
"""The first batch of the first block."""

BLOCK = 16
"""Batches of one: those with even numbers fill the ranges."""

CANDIDATES = 4096
"""Contacts of which those of a block are chosen."""


def fills(batch: int) -> bool:
    """Return whether a batch from FIRST on fills the ranges, with no atlas."""
    return (batch - FIRST) % 2 == 0


def block_start(batch: int) -> int:
    """Return the first batch of the block of a batch from FIRST on."""
    return batch - (batch - FIRST) % BLOCK


def chosen_contacts(batch: int, atlas: Atlas | None) -> list[dict[str, float]]:
    """Return the contacts of a batch from FIRST on, by the atlas of those before its block."""
    if atlas is None:
        return contacts(SLIDING_DESIGN, batch)
    start, shares = block_start(batch), BLOCK // 2
    seed = SLIDING_DESIGN.seed + 1000 + start
    wanted = worst_contacts(atlas, seed, shares * CONTACTS, CANDIDATES)
    return wanted[(batch - start) // 2 :: shares]
