"""A sample of the stability map: every resolved case converges, no result makes a false claim."""

import sys
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import HANGS_S, IS_LONG, SKIPPED, TestCase, last_line, namelist, run

try:
    from studies.stability.cases import quick_cases, sliding_cases
    from studies.stability.outcome import CONVERGED, REFUSED
    from studies.stability.run import read_rows, write_cases
except ImportError as error:
    print(f"skipped: the stability map needs the packages of postprocess ({error})")
    sys.exit(SKIPPED)

FIRST, EVERY = 8, 11   # a sample of cheap cases of most families
LIMIT = int(HANGS_S)   # seconds of a case


def touching(orientation, **conditions):
    """Waves nearly as high as the film."""
    return {"conditions": {"load_parameter_m": 300, "lubricant_parameter_l": 30, "radius_ratio_d": 1, **conditions},
            "waviness": {"orientation": orientation, "wavelength_over_a": 1, "amplitude_over_film": 0.9},
            "grid": {"cells_x": 64, "cells_y": 64}}


class StabilityMap(TestCase):
    def case(self, groups, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "case.nml").write_text(namelist(groups))
            outcome = run("case", "case.nml", "--json", "--quiet", *arguments, folder=folder)
        return outcome, last_line(outcome)

    def rows(self, cases):
        with tempfile.TemporaryDirectory() as folder:
            outcome = run("sweep", write_cases(Path(folder), cases, LIMIT))
            self.assertIn(outcome.returncode, (0, 1), outcome.stderr)
            rows = read_rows(Path(folder), cases)
        self.assertEqual(len(rows), len(cases))
        for row in rows:
            self.assertFalse(row.is_bad, (row.case, row.message, row.faults))
        return rows

    def test_sample(self):
        outcomes = [row.outcome for row in self.rows(quick_cases()[FIRST::EVERY])]
        self.assertGreater(outcomes.count(CONVERGED), 6, outcomes)
        self.assertGreater(outcomes.count(REFUSED), 0, outcomes)

    def test_sliding_sample(self):
        keys = {"load_parameter_m": 30, "lubricant_parameter_l": 6, "eyring_stress_pa": 5e5}
        cases = [case for case in sliding_cases() if all(case.value(key) == value for key, value in keys.items())]
        self.assertEqual(len(cases), 18)
        self.assertEqual({row.outcome for row in self.rows(cases if IS_LONG else cases[::3])}, {CONVERGED})

    def test_rung_is_told(self):
        """A solution that takes more steps than it may is found by continuation, the same to the tolerance."""
        groups = {**touching("longitudinal"), "solver": {"tolerance": 1e-8}}
        _, direct = self.case(groups)
        self.assertEqual((direct["status"], direct["rung"]), ("converged", "direct"), direct)
        outcome, result = self.case({**groups, "solver": {**groups["solver"], "largest_steps": 10}})
        self.assertEqual((outcome.returncode, result["status"]), (0, "converged"), result)
        self.assertEqual(result["rung"], "continuation")
        self.check_close(result["amplitude_ratio"], direct["amplitude_ratio"], 1e-6, "Ad/Ai")
        self.assertGreaterEqual(result["rescued_solutions"], 1)
        self.assertIn("Rescue       continuation", outcome.stdout)

    def test_cap_bounds_the_work(self):
        groups = {**touching("longitudinal"), "solver": {"largest_total_steps": 12}}
        outcome, result = self.case(groups)
        self.assertEqual((outcome.returncode, result["status"]), (1, "stalled"), result)
        self.assertEqual(result["nonlinear_steps"], 12)
        self.assertIn("largest_total_steps", result["message"])
        self.assertIsNone(result["amplitude_ratio"])

    def test_no_amplitude_before_the_pattern_has_passed(self):
        groups = touching("transverse", load_parameter_m=100, lubricant_parameter_l=12.05)
        outcome, result = self.case({**groups, "dynamics": {"end_time": 1}})
        self.assertEqual((outcome.returncode, result["status"]), (0, "converged"), result)
        self.assertIsNone(result["amplitude_ratio"])
        self.assertIsNone(result["amplitude_ratio_fit"])


if __name__ == "__main__":
    unittest.main()
