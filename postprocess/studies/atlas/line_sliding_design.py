"""Where the atlases of line contacts that slide are computed: as in rolling."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ehlwave.laws.atlas import Atlas
from ehlwave.laws.atlas.kind import Kind
from ehlwave.laws.atlas.kinds import LINE_NEWTONIAN, LINE_SLIDING
from ehlwave.laws.atlas.line_rolling import COMPUTED
from studies import sweeps
from studies.atlas import line_design
from studies.atlas.batches import as_keys
from studies.atlas.design import (
    GROUPS,
    SLIDING_DESIGN,
    Contact,
    Ranges,
    random_contacts,
    spread_contacts,
    uncertain_contacts,
)
from studies.atlas.line_design import waves
from studies.atlas.waves import random_wavelength

CONTACTS = 32
"""Contacts of a batch."""

SEED, VALIDATION_SEED = 2300, 2031

GROUPS_OF = {LINE_SLIDING.name: SLIDING_DESIGN.groups, LINE_NEWTONIAN.name: GROUPS}
"""Shared keys of all cases."""

SIZES = (1024, 1536, 2048, 3072, 4096, 6144, 8192)
COARSER = 0.625
"""Mesh sizes in the length of the inlet, over rolling contacts: there are many contacts."""

EVENLY_SPREAD = {LINE_SLIDING.name: 32, LINE_NEWTONIAN.name: 20}
"""Batches over all of the ranges; those that follow are where machines are."""

SLIGHT_SLIP = (5e-4, 0.05)
"""Ree-Eyring oils: deviation of S from 1, as in rollers. Friction is still linear there."""

LIGHT = {"load_parameter_m": (COMPUTED.ranges["load_parameter_m"][0], 100.0)}
"""Newtonian oils, as in gears and cams: responses change most between contacts."""

EXTENDED = ("load_parameter_m", "lubricant_parameter_l")
"""Keys of which contacts lie a little below the range, too."""


def write_batch(
    folder: Path, batch: int, atlas: Atlas | None = None, kind: Kind = LINE_SLIDING
) -> Path:
    """Write the sweep of a batch: where the present atlas is least accurate, if any.

    Without an atlas it fills the ranges and a little below.
    """
    random = np.random.default_rng([batch, SEED])
    ranges = {
        key: COMPUTED.ranges[key] if key in EXTENDED else ends for key, ends in kind.ranges.items()
    }
    if atlas is not None:
        chosen = uncertain_contacts(atlas, SEED + batch, CONTACTS)
    elif batch < EVENLY_SPREAD[kind.name]:
        chosen = spread_contacts(ranges, SEED, CONTACTS, batch, kind)
    else:
        chosen = machine_contacts(ranges, batch - EVENLY_SPREAD[kind.name], kind, random)
    rows = (case(one, wave, COARSER) for one in chosen for wave in waves(one, random))
    return sweeps.write_sweep(folder, f"{kind.name}-{batch:02d}", rows, GROUPS_OF[kind.name])


def machine_contacts(
    ranges: Ranges, piece: int, kind: Kind, random: np.random.Generator
) -> list[Contact]:
    """Return contacts of a piece, counted from 0, where contacts of machines mostly are."""
    if kind is LINE_NEWTONIAN:
        return spread_contacts({**ranges, **LIGHT}, SEED + 1, CONTACTS, piece, kind)
    found = spread_contacts(ranges, SEED + 1, CONTACTS, piece, kind)
    low, high = SLIGHT_SLIP
    for contact in found:
        slip = low * (high / low) ** random.random() * random.choice((-1, 1))
        contact["slip_parameter"] = float(f"{1 + slip:.7g}")
    return found


def case(contact: Mapping[str, float], wave: float, share: float = 1.0) -> sweeps.Row:
    """Return a case with a grid that resolves its inlet, with a share of the cells in rolling."""
    found = line_design.case(contact, wave, share * line_design.INLET_CELLS, SIZES)
    return as_keys(found)


def write_validation(
    folder: Path, kind: Kind = LINE_SLIDING, count: int = 150, each: int = 2
) -> Path:
    """Write the sweep that the atlas is judged by: random contacts and waves."""
    random, found = np.random.default_rng(VALIDATION_SEED), []
    for contact in random_contacts(kind, random, count):
        found += [case(contact, random_wavelength(random)) for _ in range(each)]
    return sweeps.write_sweep(folder, f"{kind.name}-validation", found, GROUPS_OF[kind.name])
