"""Threads that share a contact: the same results with any number of them, and messages about them."""

import os
import unittest
from pathlib import Path
from unittest import mock

from ehlwave_program import FolderTest, last_line, namelist, run

TIMES = {"seconds", "work_units", "harmonic_work_units", "peak_memory_mib", "input"}
CONDITIONS = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
GRID = {"cells_x": 160, "cells_y": 160}
CASES = {
    "newton": {"conditions": CONDITIONS, "grid": GRID, "solver": {"method": "newton"}},
    "fas": {"conditions": CONDITIONS, "grid": GRID, "solver": {"method": "fas"}},
    "response": {"conditions": CONDITIONS, "grid": GRID,
                 "waviness": {"orientation": "isotropic", "wavelength_over_a": 1, "response": "harmonic"}},
}


class Threads(FolderTest):
    def solve(self, groups, threads, *arguments):
        groups = {**groups, "solver": {**groups.get("solver", {}), "threads": threads}}
        Path(self.folder, "case.nml").write_text(namelist(groups))
        return run("case", "case.nml", *arguments, folder=self.folder)

    def results(self, groups, threads):
        outcome = self.solve(groups, threads, "--json")
        self.check_status(outcome)
        return {name: value for name, value in last_line(outcome).items() if name not in TIMES}

    def test_same_bits(self):
        for name, groups in CASES.items():
            one = self.results(groups, 1)
            self.assertGreater(one["central_film"], 0)
            for threads in (2, 3):
                self.assertEqual(self.results(groups, threads), one, f"{name} with {threads} threads")

    def test_plan_and_report_say_how_many(self):
        small = {"conditions": CONDITIONS, "grid": {"cells_x": 32, "cells_y": 32}}
        self.assertEqual(self.solve(small, 3).stdout.count("3 threads"), 2)
        self.assertNotIn("threads", self.solve(small, 1).stdout)

    def test_too_many_are_refused(self):
        outcome = self.solve(CASES["fas"], 300, "--plan")
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("threads", outcome.stderr)

    def test_the_environment_has_the_same_limit(self):
        for program in ("case", "sweep"):
            group = {"case": "conditions", "sweep": "sweep"}[program]
            (self.folder/"input.nml").write_text(namelist({group: CONDITIONS, "grid": {"cells_x": 32, "cells_y": 32}}))
            options = ["--plan"] if program == "case" else ["--time-limit", "0.001"]
            with mock.patch.dict(os.environ, OMP_NUM_THREADS="257"):
                outcome = run(program, "input.nml", *options, folder=self.folder)
            self.assertIn("OMP_NUM_THREADS = 257 is taken as 256", outcome.stdout + outcome.stderr)
            if program == "case":
                self.assertIn("256 threads", outcome.stdout)


if __name__ == "__main__":
    unittest.main()
