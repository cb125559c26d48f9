"""Bearings as catalogues have them, and the contacts that the wide atlas is made of."""

from dataclasses import replace
from functools import partial

import pytest
from long_tests import IS_LONG

from ehlwave.contact.conditions import MOES_KEYS
from ehlwave.laws.atlas.kind import is_within
from ehlwave.laws.atlas.kinds import WIDE
from studies.atlas import bearings
from studies.atlas.catalogue import DRAWS
from studies.atlas.design import CONTACTS, FIRST_BATCHES, FIRST_RANGES, WIDE_DESIGN, wide_contacts

BALLS, ROLLERS = DRAWS[:2]


def test_contacts_of_balls_and_rollers_are_answered() -> None:
    count = bearings.CONTACTS if IS_LONG else 60
    balls = replace(BALLS, contacts=partial(bearings.ball_contacts, count))
    rollers = replace(ROLLERS, contacts=partial(bearings.roller_contacts, count))
    found, refused = balls.answered(None)
    assert len(found) + len(refused) == count
    assert len(found) >= 0.98 * count
    found, refused = rollers.answered(None)
    assert len(found) == (297 if IS_LONG else 59)  # 297 of 300 in the manual
    assert all("L = " in why for why in refused)


def test_loads_of_bearings_are_shares_of_the_rated_one() -> None:
    low, high = bearings.LOAD_SHARE
    for contacts, rated, power in (
        (bearings.ball_contacts, bearings.RATED_PA, 3),
        (bearings.roller_contacts, bearings.RATED_LINE_PA, 2),
    ):
        shares = [(one.conditions.hertz_pa / rated) ** power for one in contacts(40)]
        assert 0.999 * low < min(shares) < 1.5 * low
        assert high / 1.5 < max(shares) < 1.001 * high


@pytest.mark.parametrize("batch", [0, FIRST_BATCHES, 14])
def test_the_wide_atlas_is_made_of_contacts_within_and_beyond_its_first_ranges(batch: int) -> None:
    chosen = wide_contacts(batch, WIDE_DESIGN)
    assert len(chosen) == CONTACTS
    for contact in chosen:
        assert WIDE.holds(contact)
        assert not WIDE.beyond(contact)
        first = all(is_within(contact[key], *FIRST_RANGES[key]) for key in FIRST_RANGES)
        assert first == (batch < FIRST_BATCHES)
        assert set(MOES_KEYS) < set(contact)
    assert wide_contacts(batch + 1, WIDE_DESIGN)[0] not in chosen
