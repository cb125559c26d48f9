"""Where the atlas is computed: contacts, the patterns of each, and its grid."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.stats import qmc

from ehlwave.atlas import Atlas
from ehlwave.atlas.coordinates import hertz_film
from ehlwave.atlas.kind import is_within
from ehlwave.atlas.kinds import ROLLING, SLIDING, SLIDING_WIDE, WIDE, Kind
from ehlwave.atlas.ranges import CONTACT_RANGES, WAVE_RANGE
from ehlwave.atlas.sliding import MODULUS_PA
from ehlwave.contact.conditions import MOES_KEYS
from ehlwave.contact.scales import ellipticity, lambdabar, pressure_factor
from studies import sweeps
from studies.atlas.points import contact_of
from studies.programs import Groups

Floats = NDArray[np.float64]
Ranges = Mapping[str, tuple[float, float]]
Contact = dict[str, float]

CONTACTS = 32
"""Of one batch."""

CANDIDATES = 512
"""Contacts of which those of a batch are drawn by the errors of the atlas so far."""

SLENDER = {"load_parameter_m": (20.0, 70.0), "radius_ratio_d": (0.04, 0.2)}
"""Where bodies are nearly rigid along rolling and not across it."""

SLENDER_BATCHES = (8, 10, 12, 14)
"""Batches of them, of contacts that roll: there responses change most from one to the next."""

FIRST_RANGES = {"load_parameter_m": (5.0, 10000.0), "lubricant_parameter_l": (2.0, 20.0)}
FIRST_BATCHES = 10
"""Of the wide atlas: those within these ranges. Later ones are of contacts beyond them."""

BALLS = {"radius_ratio_d": (0.018, 0.08)}
BALL_BATCHES = range(14, 17)
"""Of those beyond, the ones of balls in grooves."""

INLET_MESHES = 5, 3
"""Mesh sizes in the length of the inlet wanted along X and Y, of the fitted scheme."""

FEWEST_CELLS, MOST_FITTED_CELLS = 192, 512
"""Along X, of the same: the former for short waves."""

CELLS_ACROSS = 36
"""Over kappa, along Y: what longitudinal waves of 0.9 a ask for."""

ROOMY_FILM, ROOM = 0.4, 2
"""Film over the Hertz approach from which on a domain is so many times as large as usual."""

LONGITUDINAL = 100.0
"""Degrees up to which directions are drawn where a tenth shall be longitudinal."""

MARGIN = 1.15
"""By which wavelengths go beyond the range, so that its ends are not ends of the data."""

STANDS_ACROSS = 0.5
"""Degrees from either axis within which a wave is transverse or longitudinal, not oblique."""

FEWEST_FOR_RISES = 8
"""Mesh sizes in a wave of which only the mean film is asked, on half the cells of its contact."""

SIZES = (128, 192, 256, 384, 512, 768, 1024)
MOST_CELLS = SIZES[-1]
"""In one direction, of waves that the atlas is judged by."""

GROUPS: Groups = {
    "waviness": {"orientation": "custom", "response": "harmonic"},
    "grid": {"edges": "flooded"},
}
FITTED: Groups = GROUPS | {"solver": {"scheme": "fitted"}}


@dataclass(frozen=True)
class Design:
    """How an atlas is sampled.

    Attributes
    ----------
    kind : Kind
        Of the atlas.
    seed : int
        Of the sequences of its contacts.
    directions : tuple of (float or None, int)
        Angles, degrees, and how many patterns of a contact have them; None: any in between.
    fewest_points : int
        Mesh sizes in a wave.
    validated, validation_seed : int
        Random contacts that the atlas is judged by. A set that was looked at while the networks
        were chosen is no judge: take another seed then.
    groups : mapping
        What all cases share.
    most_cells : int
        In one direction, where short waves have more than their contact; 0: they have not.
    """

    kind: Kind
    seed: int
    directions: tuple[tuple[float | None, int], ...]
    fewest_points: int
    validated: int
    validation_seed: int
    groups: Groups
    most_cells: int = 0

    def grid(self, contact: Mapping[str, float]) -> tuple[int, int]:
        """Return cells along X and Y of a contact.

        The inlet asks for them: its pressure grows over a length that shrinks as M grows and L
        falls. There are many contacts that slide, and they do with fewer.
        """
        if self.kind is WIDE:
            return fitted_grid(contact)
        m, l, d = (contact[key] for key in MOES_KEYS)
        kappa = ellipticity(d)
        inlet = 0.0141 * (m * kappa) ** 0.44 * l**-0.365  # of 256 cells, as the plan has it
        steps = ((0.02, 128), (0.035, 192), (0.09, 256), (0.15, 384))
        along = next((cells for limit, cells in steps if inlet < limit), 512)
        across = min(512, along * (1 if kappa > 0.5 else 2))
        if self.kind is SLIDING:
            along = min(256, along)
            across = max(64, min(across, 256 if across == along else 384) // 2)
        return along, across

    def judges(self, contact: Mapping[str, float]) -> bool:
        """Return whether the atlas is judged by a contact."""
        return not self.kind.beyond(contact)

    def domain(self, contact: Mapping[str, float]) -> dict[str, float]:
        """Return the keys of a domain that is not the usual one: thick films ask for more room."""
        m, l, d = (contact[key] for key in MOES_KEYS)
        if self.kind not in (WIDE, SLIDING_WIDE) or hertz_film(m, l, d) < ROOMY_FILM:
            return {}
        return {"x_min": -2.5 * ROOM, "x_max": 1.5 * ROOM, "y_max": 2.0 * ROOM}

    def extent(self, contact: Mapping[str, float]) -> tuple[float, float]:
        """Return the lengths of the domain along X and Y over a."""
        length = 4.0 * (ROOM if self.domain(contact) else 1)
        return length, length / ellipticity(contact["radius_ratio_d"])


def fitted_grid(contact: Mapping[str, float]) -> tuple[int, int]:
    """Return cells along X and Y by the length of the inlet, (L/(gamma M))^(1/2) or H's."""
    m, l, d = (contact[key] for key in MOES_KEYS)
    kappa = ellipticity(d)
    length = min(1.0, max((l / m / pressure_factor(kappa)) ** 0.5, lambdabar(m, kappa) ** 0.4))
    along, across = (4 / length * meshes for meshes in INLET_MESHES)
    along = min(max(along, FEWEST_CELLS), MOST_FITTED_CELLS)
    across = min(max(across, CELLS_ACROSS / kappa), SIZES[4])
    return next(n for n in SIZES if n >= along), next(n for n in SIZES if n >= across)


ROLLING_DESIGN = Design(ROLLING, 2000, ((0.0, 3), (90.0, 2), (None, 4)), 12, 150, 1997, GROUPS)
WIDE_DESIGN = Design(WIDE, 2000, ((0.0, 3), (90.0, 2), (None, 4)), 8, 60, 1997, FITTED)
SLIDING_DESIGN = Design(
    SLIDING,
    2100,
    ((0.0, 3), (90.0, 1), (None, 4)),
    10,
    100,
    2026,
    GROUPS
    | {
        "conditions": {"reduced_modulus_pa": MODULUS_PA},
        "lubricant": {"flow_law": "eyring"},
    },
)
DESIGNS = {design.kind.name: design for design in (ROLLING_DESIGN, WIDE_DESIGN, SLIDING_DESIGN)}


def spread_contacts(
    ranges: Ranges,
    seed: int,
    count: int,
    piece: int = 0,
    kind: Kind | None = None,
    outside: Ranges | None = None,
) -> list[Contact]:
    """Return contacts that fill ranges: a piece, counted from 0, of a Sobol sequence.

    Those beyond the limits of a kind are passed over, and those that lie not `outside` of others.
    """
    sequence, found = qmc.Sobol(len(ranges), seed=seed), list[Contact]()
    while len(found) < (piece + 1) * count:
        for contact in (contact_at(one.tolist(), ranges) for one in sequence.random(count)):
            inside = outside and all(is_within(contact[key], *outside[key]) for key in outside)
            if not inside and (kind is None or not kind.beyond(contact)):
                found.append(contact)
    return found[piece * count : (piece + 1) * count]


def uncertain_contacts(
    atlas: Atlas, seed: int, count: int = CONTACTS, of: int = CANDIDATES
) -> list[Contact]:
    """Return contacts where an atlas knows least: of many, drawn by the squares of error bars."""
    candidates = spread_contacts(atlas.kind.ranges, seed, of, kind=atlas.kind)
    waves, angles = np.meshgrid([0.15, 0.4, 1.0, 2.5], [0.0, 40.0, 90.0])
    wanted = [np.mean(atlas.at(one).responses(waves, angles).error ** 2) for one in candidates]
    shares = np.array(wanted) / np.sum(wanted)
    drawn = np.random.default_rng(seed).choice(of, count, replace=False, p=shares)
    return [candidates[one] for one in drawn]


def contact_at(shares: Sequence[float], ranges: Ranges = CONTACT_RANGES) -> dict[str, float]:
    """Return a contact by its place in the ranges, 0 to 1 of logarithms, of values from 0 on."""
    found = {}
    for (key, (low, high)), share in zip(ranges.items(), shares, strict=True):
        value = low * (high / low) ** share if low > 0 else high * share
        found[key] = float(f"{value:.6g}")
    return found


def patterns(
    design: Design, contact: dict[str, float], random: np.random.Generator
) -> Iterator[dict[str, float]]:
    """Yield wavelengths of the patterns of a contact that its grid resolves."""
    cells_x, cells_y = (max(cells, design.most_cells) for cells in design.grid(contact))
    shortest = design.fewest_points * np.array(design.extent(contact)) / (cells_x, cells_y)
    for angle, count in design.directions:
        order = random.permutation(count)
        for place in order:
            most = LONGITUDINAL if design.most_cells else 90
            theta = np.radians(min(random.uniform(0, most), 90) if angle is None else angle)
            # What neither direction's mesh resolves is not asked for.
            low = max(WAVE_RANGE[0] / MARGIN, *(shortest * np.abs([np.cos(theta), np.sin(theta)])))
            high = WAVE_RANGE[1] * MARGIN
            wave = low * (high / low) ** ((place + random.random()) / count)
            yield pattern(wave, np.degrees(theta))


def pattern(wavelength_over_a: float, angle_deg: float) -> dict[str, float]:
    """Return the keys of a pattern by its wavelength along the wave vector and its direction."""
    theta = np.radians(angle_deg)
    along, across = np.cos(theta), np.sin(theta)
    return {
        "wavelength_x_over_a": 0.0 if along < 1e-9 else float(f"{wavelength_over_a / along:.7g}"),
        "wavelength_y_over_a": 0.0 if across < 1e-9 else float(f"{wavelength_over_a / across:.7g}"),
    }


def write_batch(
    folder: Path, batch: int, design: Design = ROLLING_DESIGN, atlas: Atlas | None = None
) -> Path:
    """Write the sweep of a batch: where the atlas so far knows least, if there is one.

    Without one it fills the ranges unless it is one of slender contacts.
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


def wide_contacts(batch: int, design: Design) -> list[Contact]:
    """Return contacts of a batch of the wide atlas: within its first ranges, then beyond them."""
    kind, ranges = design.kind, design.kind.ranges
    if batch < FIRST_BATCHES:
        return spread_contacts({**ranges, **FIRST_RANGES}, design.seed, CONTACTS, batch, kind)
    piece, seed = batch - FIRST_BATCHES, design.seed + FIRST_BATCHES
    if batch in BALL_BATCHES:
        ranges, seed = {**ranges, **BALLS}, seed + 1
        piece = batch - BALL_BATCHES.start
    return spread_contacts(ranges, seed, CONTACTS, piece, kind, FIRST_RANGES)


def write_validation(folder: Path, design: Design = ROLLING_DESIGN, each: int = 2) -> Path:
    """Write the sweep that the atlas is judged by: random contacts and waves."""
    random, found = np.random.default_rng(design.validation_seed), []
    for contact in random_contacts(design.kind, random, design.validated, design.judges):
        for _ in range(each):
            waves = random_wave(design, contact, random)
            found.append({**as_keys(contact), **waves, **design.domain(contact)})
    return sweeps.write_sweep(folder, f"{design.kind.name}-validation", found, design.groups)


def random_contacts(
    kind: Kind,
    random: np.random.Generator,
    count: int,
    is_wanted: Callable[[Contact], bool] | None = None,
) -> Iterator[Contact]:
    """Yield contacts anywhere in an atlas, or so many of them as are wanted."""
    while count:
        contact = contact_at(random.random(len(kind.ranges)).tolist(), kind.ranges)
        if is_wanted(contact) if is_wanted else not kind.beyond(contact):
            count -= 1
            yield contact


def random_wavelength(random: np.random.Generator) -> float:
    """Return a wavelength over a, its logarithm evenly spread over the range."""
    low, high = WAVE_RANGE
    return low * (high / low) ** random.random()


def as_keys(contact: dict[str, float]) -> dict[str, float]:
    """Return the input keys of a contact: of E' tau0 the stress between steel bodies."""
    keys = dict(contact)
    if "stress_modulus_pa2" in keys:
        keys["eyring_stress_pa"] = keys.pop("stress_modulus_pa2") / MODULUS_PA
    return keys


def write_rises(folder: Path, design: Design, computed: xr.Dataset) -> Path:
    """Write the sweep of mean films under oblique waves: those of the computed points, one by one.

    The points themselves are products of cosines, two waves, of which the mean film is not that
    of one. A single oblique wave takes the whole domain; its rise, a correction, half the cells.
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


def grid_for_rise(
    design: Design, contact: dict[str, float], wave: float, angle_deg: float
) -> dict[str, int]:
    """Return half the cells of a contact, or as many more as the wave asks for."""
    theta = np.radians(angle_deg)
    extent = design.extent(contact)
    shares = np.cos(theta), np.sin(theta)
    cells = []
    for whole, length, share in zip(design.grid(contact), extent, shares, strict=True):
        least = max(whole // 2, FEWEST_FOR_RISES * length / wave * share)
        cells.append(next(n for n in (64, 96, *SIZES) if n >= least))
    return {"cells_x": cells[0], "cells_y": cells[1]}


def random_wave(
    design: Design, contact: dict[str, float], random: np.random.Generator
) -> dict[str, float]:
    """Return a pattern of any length and direction in the range, and a grid that resolves it.

    A quarter are transverse. What 1024 cells do not resolve is drawn again.
    """
    while True:
        wave = random_wavelength(random)
        angle = 0.0 if random.random() < 0.25 else random.uniform(0, 90)
        waves = pattern(wave, angle)
        cells = cells_for(design, contact, waves)
        if max(cells) <= MOST_CELLS:
            return {**waves, **dict(zip(("cells_x", "cells_y"), cells, strict=True))}


def cells_for(
    design: Design, contact: Mapping[str, float], waves: Mapping[str, float]
) -> tuple[int, int]:
    """Return cells along X and Y that resolve a contact and a pattern."""
    lengths = waves["wavelength_x_over_a"], waves["wavelength_y_over_a"]
    found = []
    for cells, extent, length in zip(
        design.grid(contact), design.extent(contact), lengths, strict=True
    ):
        need = design.fewest_points * extent / length if length > 0 else 0.0
        found.append(next((n for n in (cells, *SIZES) if n >= max(cells, need)), MOST_CELLS + 1))
    return found[0], found[1]


def rows(
    design: Design, chosen: Sequence[dict[str, float]], random: np.random.Generator
) -> Iterator[dict[str, float]]:
    """Yield the cases of some contacts."""
    for contact in chosen:
        for waves in patterns(design, contact, random):
            found = cells_for(design, contact, waves) if design.most_cells else design.grid(contact)
            cells = dict(zip(("cells_x", "cells_y"), found, strict=True))
            yield {**as_keys(contact), **waves, **cells, **design.domain(contact)}
