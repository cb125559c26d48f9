"""Where the atlas is computed: its contacts, and the grid of each."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from ehlwave.contact.conditions import MOES_KEYS
from ehlwave.contact.scales import ellipticity, lambdabar, pressure_factor
from ehlwave.laws.atlas import Atlas
from ehlwave.laws.atlas.coordinates import hertz_film
from ehlwave.laws.atlas.kind import is_within
from ehlwave.laws.atlas.kinds import ROLLING, SLIDING, SLIDING_WIDE, WIDE, Kind
from ehlwave.laws.atlas.ranges import CONTACT_RANGES
from ehlwave.laws.atlas.sliding import MODULUS_PA
from studies.programs import Groups

Floats = NDArray[np.float64]
Ranges = Mapping[str, tuple[float, float]]
Contact = dict[str, float]

CONTACTS = 32
"""Contacts of a batch."""

CANDIDATES = 512
"""Contacts from which a batch is drawn by the present errors of the atlas."""

SLENDER = {"load_parameter_m": (20.0, 70.0), "radius_ratio_d": (0.04, 0.2)}
"""Where bodies are nearly rigid along rolling and not across it."""

SLENDER_BATCHES = (8, 10, 12, 14)
"""Batches of them, of contacts that roll: there responses change most from one to the next."""

FIRST_RANGES = {"load_parameter_m": (5.0, 10000.0), "lubricant_parameter_l": (2.0, 20.0)}
FIRST_BATCHES = 10
"""Batches of the wide atlas within these ranges; later batches go beyond them."""

BALLS = {"radius_ratio_d": (0.018, 0.08)}
BALL_BATCHES = range(14, 17)
"""Later batches of balls in grooves."""

INLET_MESHES = 5, 3
"""Mesh sizes in the length of the inlet wanted along X and Y, of the fitted scheme."""

FEWEST_CELLS, MOST_FITTED_CELLS = 192, 512
"""Along X, of the same: the former for short waves."""

CELLS_ACROSS = 36
"""Over kappa, along Y: as needed by longitudinal waves of 0.9 a."""

ROOMY_FILM, ROOM = 0.4, 2
"""Film over the Hertz approach from which on a domain is so many times as large as usual."""

SIZES = (128, 192, 256, 384, 512, 768, 1024)
"""Cells along X or Y that grids have."""

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
        Shared keys of all cases.
    most_cells : int
        Directions in which short waves exceed their contact; 0: none.
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
        inlet = 0.0141 * (m * kappa) ** 0.44 * l**-0.365  # inlet of 256 cells, as in the plan
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
        """Return the keys of a domain other than the default: thick films need more room."""
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
    """Return contacts where an atlas is least accurate: drawn by the squares of error bars."""
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


def random_contacts(
    kind: Kind,
    random: np.random.Generator,
    count: int,
    is_wanted: Callable[[Contact], bool] | None = None,
) -> Iterator[Contact]:
    """Yield contacts anywhere in an atlas, or a given number of them."""
    while count:
        contact = contact_at(random.random(len(kind.ranges)).tolist(), kind.ranges)
        if is_wanted(contact) if is_wanted else not kind.beyond(contact):
            count -= 1
            yield contact
