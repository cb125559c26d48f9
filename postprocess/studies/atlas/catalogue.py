"""How many contacts of bearings, gears and cams the atlas answers, and how well."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

import ehlwave
from ehlwave.errors import RangeError
from ehlwave.laws.atlas.atlas import Atlas, chart_of
from ehlwave.laws.atlas.kind import Kind
from ehlwave.laws.atlas.kinds import LINE, LINE_NEWTONIAN, LINE_SLIDING, WIDE
from studies import sweeps
from studies.atlas import line_design, line_sliding_design
from studies.atlas.bearings import CONTACTS, SEED, ball_contacts, roller_contacts
from studies.atlas.cams import cam_contacts
from studies.atlas.design import GROUPS, WIDE_DESIGN
from studies.atlas.gears import gear_contacts
from studies.atlas.line_sliding_design import GROUPS_OF
from studies.atlas.waves import random_wave, random_wavelength
from studies.programs import Groups

COMPUTED = 30
"""Number of answered contacts."""


def _wave_of_ball(keys: dict[str, float], random: np.random.Generator) -> sweeps.Row:
    return {**keys, **random_wave(WIDE_DESIGN, keys, random), **WIDE_DESIGN.domain(keys)}


def _wave_of_roller(keys: dict[str, float], random: np.random.Generator) -> sweeps.Row:
    return line_design.case(keys, random_wavelength(random))


def _wave_of_sliding_line(keys: dict[str, float], random: np.random.Generator) -> sweeps.Row:
    return line_sliding_design.case(keys, random_wavelength(random))


@dataclass(frozen=True)
class Draw:
    """Contacts of a kind of machine elements.

    Attributes
    ----------
    elements, name : str
        Name of the kind; name of the sweep of some of its contacts.
    kind : Kind
        Of the atlas that the sweep is compared with.
    contacts : callable
        Yields contacts.
    case : callable
        Returns a case of a contact by its keys, with a random wave.
    groups : mapping
        Shared keys of all cases.
    """

    elements: str
    name: str
    kind: Kind
    contacts: Callable[[], Iterator[ehlwave.Contact]]
    case: Callable[[dict[str, float], np.random.Generator], sweeps.Row]
    groups: Groups

    def answered(self, atlas: Atlas | None) -> tuple[list[ehlwave.Contact], list[str]]:
        """Return contacts that the atlas answers, and why it does not answer the others."""
        found, refused = [], []
        for contact in self.contacts():
            try:
                chart_of(contact.conditions, atlas)
            except RangeError as error:
                refused.append(str(error))
            else:
                found.append(contact)
        return found, refused

    def write(self, folder: Path, atlas: Atlas | None) -> Path:
        """Write the sweep of some of those that are answered, two random waves in each."""
        random = np.random.default_rng(SEED)
        rows = []
        for contact in self.answered(atlas)[0][:COMPUTED]:
            place = contact.conditions.atlas_keys()
            keys = {key: float(f"{place[key]:.6g}") for key in self.kind.ranges}
            rows += [self.case(keys, random) for _ in range(2)]
        return sweeps.write_sweep(folder, self.name, rows, self.groups)

    def text(self, atlas: Atlas | None) -> str:
        """Return how many are answered, and where all of them lie."""
        found, refused = self.answered(atlas)
        places = [contact.conditions.atlas_keys() for contact in self.contacts()]
        ends = "; ".join(
            f"{key} {np.quantile(values, 0.02):.3g} to {np.quantile(values, 0.98):.3g}"
            for key in self.kind.ranges
            for values in ([place[key] for place in places],)
        )
        share = f"{100 * len(found) / CONTACTS:.1f} %"
        count = f"{len(found)} of {CONTACTS} contacts of {self.elements} answered ({share})"
        return "\n".join([f"{count}; 96 % have {ends}", *(f"refused: {why}" for why in refused)])


DRAWS = (
    Draw("bearing balls", "bearings", WIDE, ball_contacts, _wave_of_ball, WIDE_DESIGN.groups),
    Draw("bearing rollers", "rollers", LINE, roller_contacts, _wave_of_roller, GROUPS),
    *(
        Draw(
            f"{machine} in a {law} oil",
            f"{machine}_{kind.name}",
            kind,
            partial(contacts, kind is LINE_SLIDING),
            _wave_of_sliding_line,
            GROUPS_OF[kind.name],
        )
        for machine, contacts in (("gears", gear_contacts), ("cams", cam_contacts))
        for law, kind in (("Ree-Eyring", LINE_SLIDING), ("Newtonian", LINE_NEWTONIAN))
    ),
)
