"""What the study of stresses says: dry waves, and which of two bodies suffers."""

import numpy as np
import pandas as pd
import pytest

from ehlwave import Contact
from studies.stress import CONTACT, ranking_figure, roughness, rows_of, stresses, wave


def test_dry_waves_are_pressed_flat() -> None:
    contact = Contact(**CONTACT, slip_parameter=1.1)
    length = 0.2 * contact.conditions.semi_axis_a_m
    result = stresses(contact, wave(length, 1e-8, "transverse"), "dry")
    amplitude = CONTACT["reduced_modulus_pa"] / 4 * 2 * np.pi / length * 1e-8
    assert result.ripple_rq_pa == pytest.approx(amplitude / 2**0.5, rel=1e-6)
    assert result.friction == 0.12


def test_the_smooth_body_suffers_most_and_transverse_ridges_are_worst() -> None:
    rows = []
    for slip in (1.1, 0.9):
        contact = Contact(**CONTACT, slip_parameter=slip)
        a, film = contact.conditions.semi_axis_a_m, contact.film().central_m or np.nan
        for orientation in ("transverse", "longitudinal"):
            surface = roughness(a, film / 3, orientation)
            for kind in ("lubricated", "dry"):
                inputs = {"slip_parameter": slip, "orientation": orientation, "kind": kind}
                result = stresses(contact, surface, kind)
                rows += rows_of(result, film_over_rq=3.0, **inputs)
    table = pd.DataFrame(rows)
    for (slip, kind), part in table.groupby(["slip_parameter", "kind"]):
        life = part.set_index(["orientation", "body"]).life_ratio
        assert life["transverse", "smooth"] < 0.9 * life["transverse", "rough"], (slip, kind)
        assert life["transverse", "smooth"] < 0.9 * life["longitudinal", "smooth"], (slip, kind)
        same = life["longitudinal", "rough"]
        assert life["longitudinal", "smooth"] == pytest.approx(same, rel=0.01)
    assert len(ranking_figure(table).axes) == 3
