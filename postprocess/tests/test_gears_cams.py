"""Gears along the line of action, and cams, as the atlas of line contacts is judged by them."""

from dataclasses import replace
from itertools import islice

import numpy as np
import pytest
from long_tests import IS_LONG

from ehlwave.laws.atlas.kinds import LINE_NEWTONIAN, LINE_SLIDING
from studies.atlas import cams, gears
from studies.atlas.bearings import CONTACTS
from studies.atlas.catalogue import DRAWS
from studies.atlas.gears import Mesh

PITCH = np.pi * np.cos(np.radians(20))


def test_the_path_of_contact_is_that_of_standard_teeth() -> None:
    mesh = Mesh(20, 40)
    first, last = mesh.path
    assert (last - first) / PITCH == pytest.approx(1.635, abs=0.001)  # contact ratio
    pitch_point = mesh.base[0] * np.tan(np.radians(20))
    assert first < pitch_point < last
    radii = np.array(mesh.radii(pitch_point))
    speeds = radii * (1, 0.5)  # turns of pinion and wheel
    assert speeds[0] == pytest.approx(speeds[1])  # it rolls
    rack = Mesh(17, 10_000).path[0]
    assert 0 <= rack < 0.2  # nearly at the base circle: the fewest teeth without undercut


def test_the_pairs_of_teeth_in_contact_share_the_whole_load() -> None:
    mesh = Mesh(23, 57)
    first, last = mesh.path
    for place in np.linspace(first, last - PITCH, 7)[1:-1]:
        assert mesh.share(place) + mesh.share(place + PITCH) == pytest.approx(1)
    assert mesh.share((first + last) / 2) == 1


def test_gears_have_pressures_and_slip_of_their_ranges() -> None:
    found = [one.conditions for one in gears.gear_contacts()]
    low, high = gears.PRESSURE_PA
    pressures = np.array([one.hertz_pa for one in found])
    assert pressures.max() < 1.3 * high  # above that at the pitch point towards either end
    assert pressures.min() > 0.5 * low  # a third of the load
    slips = np.array([one.slip_parameter for one in found])
    assert slips.min() < 0.5
    assert slips.max() > 1.5
    assert abs(np.mean(slips < 1) - 0.5) < 0.1
    assert {one.oil.name for one in found} == {"Ree-Eyring"}
    assert {one.conditions.oil.name for one in gears.gear_contacts(False, 5)} == {"Newtonian"}


def test_cams_slide_on_flat_followers_and_nearly_roll_on_rollers() -> None:
    found = [one.conditions for one in cams.cam_contacts()]
    flat, roller = (np.array([one.slip_parameter for one in found[k::2]]) for k in (0, 1))
    assert np.all(np.abs(roller - 1) < cams.ROLLER_SLIP[1] / 2 + 1e-9)
    assert np.all(np.abs(flat - 1) > 0.08)
    for k, (low, high) in enumerate((cams.FLAT_PA, cams.ROLLER_PA)):
        pressures = [one.hertz_pa for one in found[k::2]]
        assert low * 0.999 < min(pressures) < max(pressures) < high * 1.001


def test_gears_and_cams_are_answered() -> None:
    sliding = [draw for draw in DRAWS if draw.kind in (LINE_SLIDING, LINE_NEWTONIAN)]
    assert len(sliding) == 4
    count = CONTACTS if IS_LONG else 50
    for draw in sliding:
        some = replace(draw, contacts=lambda every=draw.contacts: islice(every(), count))
        assert len(some.answered(None)[0]) >= 0.98 * count
