"""Derivatives of periodic states against centred differences of marches from rest, which share no step with them."""

import copy
import math
import random
import unittest

from ehlwave_program import IS_LONG, TestCase, report, solve

STEP = 1e-4          # step in the logarithm of a key
AGREEMENT = 1e-4     # relative to the largest derivative of a result,
ABSOLUTE = 1e-5      # or this
SETTLE = 12          # periods that marches wait
RESULTS = ("amplitude_ratio_fit", "phase_fit", "mean_film")
WAVES = {"orientation": "transverse", "amplitude_over_film": 0.15}


def periodic(conditions, lubricant, grid, wavelength, dynamics=None, **solver):
    """Input of a periodic state."""
    return {"conditions": {"radius_x_m": 0.01, "reduced_modulus_pa": 2.26e11, "viscosity_pa_s": 0.04, **conditions},
            "lubricant": lubricant, "grid": {"edges": "flooded", **grid}, "dynamics": dynamics or {},
            "waviness": {**WAVES, "wavelength_over_a": wavelength, "response": "periodic"},
            "solver": {"tolerance": 1e-12, "step_tolerance": 1e-6, "settling_periods": SETTLE, "largest_steps": 100, "scheme": "averaged", **solver}}


def marched(groups, key, change):
    """Return Ad/Ai, its phase and the mean film of the same samples of a march from rest, with ln(key) changed; None: nothing."""
    other = copy.deepcopy(groups)
    group = next(name for name in other if key in other[name])
    other[group][key] *= math.exp(change)
    other["waviness"]["response"] = "transient"
    other["solver"]["step_tolerance"] = 1e-11
    result = solve(**other)
    unit = result["central_film_um"]/result["central_film"]
    return math.log(result["amplitude_ratio_fit"]), result["phase_fit"], math.log(unit*result["mean_film"])


LINE = {"load_n_per_m": 2*math.pi*0.01*0.5e9**2/2.26e11, "mean_speed_m_per_s": 1, "slip_parameter": 1.1}
BALL = {"radius_y_m": 0.014, "load_n": 8, "mean_speed_m_per_s": 0.5, "slip_parameter": 1.2}
ROELANDS = {"pressure_viscosity_per_pa": 1.8e-8, "roelands_index": 0.6}


class PeriodicGradients(TestCase):
    def check(self, name, groups, keys):
        """Compare derivatives by some keys."""
        result = solve(**groups, output={"sensitivities": True})
        self.assertEqual((result["status"], result["march_from"]), ("converged", "waves"))
        worst = 0
        for of, expected in zip(RESULTS, zip(*(self.differences(groups, key) for key in keys))):
            found = [result[f"sensitivity_{of}_{key}"] for key in keys]
            allowed = max(ABSOLUTE, AGREEMENT*max(map(abs, expected)))
            for key, one, other in zip(keys, found, expected):
                self.assertLessEqual(abs(one - other), allowed, f"{name}: {of} by {key}: {one} against {other}")
                worst = max(worst, abs(one - other)/allowed)
        report(f"{name}: {len(keys)} keys, largest deviation {worst:.2f} of the allowed")
        return result

    def differences(self, groups, key):
        """Return centred differences of all results."""
        up, down = (marched(groups, key, side*STEP) for side in (1, -1))
        return [(a - b)/(2*STEP) for a, b in zip(up, down)]

    def test_line(self):
        """Rolling and sliding line: load, slip, waves, oil."""
        groups = periodic(LINE, ROELANDS, {"cells_x": 64}, 1.672, step_tolerance=1e-7)
        result = self.check("line", groups, ["load_n_per_m", "slip_parameter", "wavelength_over_a", "amplitude_over_film"])
        self.assertGreater(result["sensitivity_solves"], 3*24)

    def test_sliding_line(self):
        """Ree-Eyring oil and differences of third order; 24 whole steps to a period, of which none is interpolated."""
        oil = ROELANDS | {"flow_law": "eyring", "eyring_stress_pa": 4e6}
        groups = periodic(LINE | {"slip_parameter": 1.5}, oil, {"cells_x": 64}, 2.25, scheme="fitted")
        self.check("sliding line", groups, ["eyring_stress_pa", "pressure_viscosity_per_pa"])

    def test_short_steps(self):
        """Two steps to a cell."""
        groups = periodic(LINE, ROELANDS, {"cells_x": 64}, 0.836, time_step_over_cell=0.5)
        self.check("short steps", groups, ["mean_speed_m_per_s", "amplitude_over_film"])

    def test_ellipse_that_moves(self):
        """Its radius changes the kernel; the approach follows the equation of motion."""
        moves = {"load_balance": "equation_of_motion", "natural_frequency": 4}
        groups = periodic(BALL, ROELANDS, {"cells_x": 32, "cells_y": 32}, 3.648, moves)
        self.check("ellipse that moves", groups, ["radius_y_m", "natural_frequency"])

    @unittest.skipUnless(IS_LONG, "EHLWAVE_LONG_TESTS")
    def test_drawn(self):
        """Drawn lines, all keys."""
        draw = random.Random(60)
        for number in range(12):
            slip, oil = draw.uniform(1.05, 1.6), dict(ROELANDS)
            if draw.random() < 0.5:
                oil |= {"flow_law": "eyring", "eyring_stress_pa": 10**draw.uniform(6.3, 7)}
            conditions = LINE | {"slip_parameter": slip, "mean_speed_m_per_s": 10**draw.uniform(-0.3, 0.5), "viscosity_pa_s": 10**draw.uniform(-1.7, -1)}
            conditions["load_n_per_m"] *= draw.uniform(0.5, 2)
            groups = periodic(conditions, oil, {"cells_x": 64}, 1.52*slip, scheme=draw.choice(["averaged", "fitted"]))
            keys = [*conditions, "radius_x_m", "reduced_modulus_pa", *(key for key in oil if key != "flow_law"), "wavelength_over_a", "amplitude_over_film"]
            self.check(f"draw {number}", groups, keys)


if __name__ == "__main__":
    unittest.main()
