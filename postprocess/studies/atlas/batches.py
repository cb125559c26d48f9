"""The sweeps of an atlas: batches of contacts with waves, and those that it is judged by."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import xarray as xr

from ehlwave.laws.atlas import Atlas
from ehlwave.laws.atlas.kinds import ROLLING, WIDE
from ehlwave.laws.atlas.ranges import CONTACT_RANGES
from ehlwave.laws.atlas.sliding import MODULUS_PA
from studies import sweeps
from studies.atlas.design import (
    CONTACTS,
    ROLLING_DESIGN,
    SLENDER,
    SLENDER_BATCHES,
    Design,
    random_contacts,
    spread_contacts,
    uncertain_contacts,
    wide_contacts,
)
from studies.atlas.points import contact_of
from studies.atlas.waves import cells_for, grid_for_rise, pattern, patterns, random_wave

STANDS_ACROSS = 0.5
"""Degrees from either axis within which a wave is transverse or longitudinal, not oblique."""


def write_batch(
    folder: Path, batch: int, design: Design = ROLLING_DESIGN, atlas: Atlas | None = None
) -> Path:
    """Write the sweep of a batch: where the present atlas is least accurate, if any.

    Without an atlas it fills the ranges unless it has slender contacts.
    """
    if atlas is not None:
        chosen = uncertain_contacts(atlas, design.seed + 1000 + batch)
    elif design.kind is ROLLING and batch in SLENDER_BATCHES:
        chosen = spread_contacts({**CONTACT_RANGES, **SLENDER}, 4000 + batch, CONTACTS)
    elif design.kind is WIDE:
        chosen = wide_contacts(batch, design)
    else:
        chosen = spread_contacts(design.kind.ranges, design.seed, CONTACTS, batch, design.kind)
    random = np.random.default_rng([batch, design.seed])
    name = f"{design.kind.name}-{batch:02d}"
    return sweeps.write_sweep(folder, name, rows(design, chosen, random), design.groups)


def write_validation(folder: Path, design: Design = ROLLING_DESIGN, each: int = 2) -> Path:
    """Write the sweep that the atlas is judged by: random contacts and waves."""
    random, found = np.random.default_rng(design.validation_seed), []
    for contact in random_contacts(design.kind, random, design.validated, design.judges):
        for _ in range(each):
            waves = random_wave(design, contact, random)
            found.append({**as_keys(contact), **waves, **design.domain(contact)})
    return sweeps.write_sweep(folder, f"{design.kind.name}-validation", found, design.groups)


def write_rises(folder: Path, design: Design, computed: xr.Dataset) -> Path:
    """Write the sweep of mean films under oblique waves: individually for the computed points.

    The points themselves are products of cosines, two waves, whose mean film differs from a single
    wave's. A single oblique wave takes the whole domain; its rise, a correction, half the cells.
    """
    found = []
    for contact in range(computed.sizes["contact"]):
        keys = {name: float(computed[name].values[contact]) for name in design.kind.ranges}
        own = computed.isel(point=np.flatnonzero(contact_of(computed) == contact))
        for wave, angle in zip(
            own["wavelength_over_a"].values, own["angle_deg"].values, strict=True
        ):
            if STANDS_ACROSS < angle < 90 - STANDS_ACROSS:
                waves = {**pattern(float(wave), float(angle)), "oblique": True}
                cells = grid_for_rise(design, keys, float(wave), float(angle))
                found.append({**as_keys(keys), **waves, **cells, **design.domain(keys)})
    return sweeps.write_sweep(folder, f"{design.kind.name}-rises", found, design.groups)


def rows(
    design: Design, chosen: Sequence[dict[str, float]], random: np.random.Generator
) -> Iterator[dict[str, float]]:
    """Yield the cases of some contacts."""
    for contact in chosen:
        for waves in patterns(design, contact, random):
            found = cells_for(design, contact, waves) if design.most_cells else design.grid(contact)
            cells = dict(zip(("cells_x", "cells_y"), found, strict=True))
            yield {**as_keys(contact), **waves, **cells, **design.domain(contact)}


def as_keys(contact: dict[str, float]) -> dict[str, float]:
    """Return the input keys of a contact: of E' tau0 the stress between steel bodies."""
    keys = dict(contact)
    if "stress_modulus_pa2" in keys:
        keys["eyring_stress_pa"] = keys.pop("stress_modulus_pa2") / MODULUS_PA
    return keys
