"""The marches as sweeps, one of each contact."""

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from ehlwave import Contact, ExtrapolationWarning
from ehlwave.surface import Deformed, Surface, simulation_surface
from studies import sweeps
from studies.lambda_ratio.maps import STRETCH, rough_map
from studies.microgeometry.simulate import CONTACT, LUBRICANT
from studies.microgeometry.traces import CONTACTS as TRACED

Levels = tuple[float, ...]

CONTACTS: dict[str, dict[str, float]] = {
    "ball": TRACED["ball"],
    "experiment": {**CONTACT, **LUBRICANT, "mean_speed_m_per_s": 0.024},
    "ellipse": {
        "radius_x_m": 10e-3,
        "radius_y_m": 20e-3,
        "reduced_modulus_pa": 2.26e11,
        "load_n": 80.0,
        "mean_speed_m_per_s": 1.0,
        "viscosity_pa_s": 0.05,
    },
}
"""M = 39, L = 12; M = 134, L = 6.6; M = 206, L = 13, b/a = 1.6."""

HELD_OUT = "ellipse"
"""Contact that no number is fitted to."""

EYRING_PA = 5e6
MOTIONS = {  # slip parameter, whether the oil is a Ree-Eyring one, seeds of the maps
    "rolling": (1.0, False, (1, 2)),
    "newtonian-0.9": (0.9, False, (2,)),
    "newtonian-1.1": (1.1, False, (1,)),
    "eyring-0.9": (0.9, True, (2,)),
    "eyring-1.1": (1.1, True, (1,)),
}

MOVED = {
    "ball": tuple(MOTIONS),
    "experiment": ("rolling", "newtonian-0.9", "eyring-1.1"),
    "ellipse": ("rolling", "newtonian-1.1", "eyring-0.9"),
}

SMALL = 0.05
FEW = (SMALL, 0.35, 0.6, 1.0, 1.5)
LEVELS = {"ball": (SMALL, 0.2, *FEW[1:]), "experiment": FEW, "ellipse": FEW}
"""Rq over the film by formula; the first shows what grid and atlas differ by."""

SURE_TO_TOUCH = 1.4
"""Highest deformed point over the film, predicted, above which nothing is marched."""

FIELDS_EVERY = 2
SECONDS = 120
"""After which a march is given up: the surfaces touch."""


@dataclass(frozen=True)
class March:
    """A map, how it moves, and what is predicted of it."""

    contact: str
    motion: str
    seed: int
    level: float
    surface: Surface

    @property
    def bodies(self) -> Contact:
        """Return the contact as a user has it."""
        slip, is_eyring, _ = MOTIONS[self.motion]
        moving: dict[str, Any] = {} if slip == 1 else {"slip_parameter": slip}
        oil = {"eyring_stress_pa": EYRING_PA} if is_eyring else {}
        return Contact(**CONTACTS[self.contact], **moving, **oil)

    def predicted(self) -> Deformed:
        """Return the map by `Contact.deform`, its ends faded as the simulation has them."""
        faded = simulation_surface(self.surface, "none")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ExtrapolationWarning)
            return self.bodies.deform(faded, form="none", ends="none")

    def row(self, folder: Path) -> sweeps.Row:
        """Return its row in the file of the cases."""
        slip, is_eyring, _ = MOTIONS[self.motion]
        oil = {"flow_law": "eyring", "eyring_stress_pa": EYRING_PA} if is_eyring else {}
        file = sweeps.surface_file(folder, self.surface).resolve()
        bodies = CONTACTS[self.contact]
        return {**bodies, "slip_parameter": slip, "flow_law": "newtonian", **oil, "file": str(file)}


def marches(contact: str, levels: Levels | None = None) -> Iterator[March]:
    """Yield all marches of a contact but those whose surfaces are sure to touch."""
    conditions = Contact(**CONTACTS[contact]).conditions
    film_m = float(conditions.central_film_m or np.nan)
    for motion, kind in product(MOVED[contact], STRETCH):
        for seed, level in product(MOTIONS[motion][-1], levels or LEVELS[contact]):
            surface = rough_map(kind, seed, level * film_m, conditions)
            march = March(contact, motion, seed, level, surface)
            if march.predicted().height.max() <= SURE_TO_TOUCH * film_m:
                yield march


def write_marches(folder: Path, contact: str, cells: int, levels: Levels | None = None) -> Path:
    """Write the maps of a contact and the sweep that marches them; return the path of that."""
    chosen = list(marches(contact, levels))
    for march in chosen:
        if not sweeps.surface_file(folder, march.surface).is_file():
            sweeps.write_surface(folder, march.surface)
    groups = {
        "grid": {"cells_x": cells, "cells_y": cells, "edges": "flooded"},
        "solver": {"error_estimate": "model"},
        "output": {"fields": True, "fields_every": FIELDS_EVERY},
        "sweep": {"largest_case_seconds": float(SECONDS)},
    }
    return sweeps.write_sweep(folder, contact, [one.row(folder) for one in chosen], groups)
