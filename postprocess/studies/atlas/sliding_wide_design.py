"""Where the wide atlas of contacts that slide is computed."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ehlwave.contact.conditions import MOES_KEYS
from ehlwave.laws.atlas import Atlas
from ehlwave.laws.atlas.coordinates import hertz_film
from ehlwave.laws.atlas.kinds import SLIDING, SLIDING_WIDE
from ehlwave.laws.atlas.sliding import conditions_of, thinning_of
from ehlwave.laws.atlas.sliding_wide import beyond_sliding, film_under_slip
from studies import sweeps
from studies.atlas.batches import rows
from studies.atlas.design import (
    CONTACTS,
    SIZES,
    SLIDING_DESIGN,
    Contact,
    Design,
    spread_contacts,
    uncertain_contacts,
)

THICK_FILM = 0.15
"""Over the Hertz approach, from which on the fewest cells do for contacts that slide."""

EASY = {"thinning": 50.0, "film": 0.006}
"""Most thinning and thinnest film under slip of most contacts of the wide atlas that slide."""

HARD_BATCHES = range(14, 16)
"""Batches of the others of them: there cases take several times as long."""

SLOW, SLOW_BATCHES = {"slip_parameter": (0.0, 0.5)}, range(16, 24)
"""S of more of them, where responses change most from one contact to the next."""

THINNED, THINNED_BATCHES = 10.0, range(24, 28)
"""Least thinning of more of them, where films change most."""

MOST_STEPS = {"largest_total_steps": 100}
"""Steps of a case: later convergence is rare and needs many more."""

AT_REST = {0: 0.0, 16: 2.0}
"""S of contacts of a batch of which one surface rests, the rough one or the other, by number."""


@dataclass(frozen=True)
class WideSlidingDesign(Design):
    """How the wide atlas of contacts that slide is sampled."""

    def grid(self, contact: Mapping[str, float]) -> tuple[int, int]:
        """Return cells along X and Y: thick films need fewer, thin films more."""
        along, across = SLIDING_DESIGN.grid(contact)
        if hertz_film(*(contact[key] for key in MOES_KEYS)) > THICK_FILM:
            return SIZES[0], min(across, SIZES[0])
        return (SIZES[3], SIZES[2]) if film_under_slip(contact) < EASY["film"] else (along, across)

    def judges(self, contact: Mapping[str, float]) -> bool:
        """Return whether the atlas is judged by a contact: the usual atlas covers its own."""
        return not (self.kind.beyond(contact) or SLIDING.holds(contact))


SLIDING_WIDE_DESIGN = WideSlidingDesign(
    kind=SLIDING_WIDE,
    seed=2200,
    directions=((0.0, 2), (None, 2)),
    fewest_points=8,
    validated=80,
    validation_seed=2040,
    groups=SLIDING_DESIGN.groups | {"solver": MOST_STEPS},
    most_cells=384,
)


def write_batch(folder: Path, batch: int, atlas: Atlas | None = None) -> Path:
    """Write the sweep of a batch: where the present atlas is least accurate, if any."""
    design = SLIDING_WIDE_DESIGN
    if atlas is not None:
        chosen = uncertain_contacts(atlas, design.seed + 1000 + batch)
    else:
        chosen = batch_contacts(batch)
    random = np.random.default_rng([batch, design.seed])
    name = f"{design.kind.name}-{batch:02d}"
    return sweeps.write_sweep(folder, name, rows(design, chosen, random), design.groups)


def batch_contacts(batch: int) -> list[Contact]:
    """Return contacts of a batch, beyond the usual ranges; two have a surface at rest."""
    seed, piece, ranges = SLIDING_WIDE_DESIGN.seed, batch, SLIDING_WIDE.ranges
    beyond = _beyond_easy
    if batch in HARD_BATCHES:
        beyond, seed, piece = _beyond_hard, seed + 1, batch - HARD_BATCHES.start
    elif batch in SLOW_BATCHES:
        ranges, seed, piece = {**ranges, **SLOW}, seed + 2, batch - SLOW_BATCHES.start
    elif batch in THINNED_BATCHES:
        beyond, seed, piece = _beyond_thinned, seed + 3, batch - THINNED_BATCHES.start
    kind = replace(SLIDING_WIDE, beyond=beyond)
    found = spread_contacts(ranges, seed, CONTACTS, piece, kind, SLIDING.ranges)
    for place, slip in AT_REST.items():
        resting = {**found[place], "slip_parameter": slip}
        if not kind.beyond(resting):
            found[place] = resting
    return found


def _beyond_easy(contact: Mapping[str, float]) -> str:
    thinning = thinning_of(conditions_of(contact)[0])
    is_hard = thinning > EASY["thinning"] or film_under_slip(contact) < EASY["film"]
    return beyond_sliding(contact) or ("hard" if is_hard else "")


def _beyond_hard(contact: Mapping[str, float]) -> str:
    return beyond_sliding(contact) or ("" if _beyond_easy(contact) else "easy")


def _beyond_thinned(contact: Mapping[str, float]) -> str:
    is_thinned = thinning_of(conditions_of(contact)[0]) > THINNED
    return beyond_sliding(contact) or ("" if is_thinned else "hardly thinned")
