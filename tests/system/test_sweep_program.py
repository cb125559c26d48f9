"""ehlwave-sweep as a user meets it, with and without mpiexec."""

import unittest
from pathlib import Path

from ehlwave_program import FolderTest, namelist, run

SWEEP = {"sweep": {"load_parameter_m": [100, 200], "lubricant_parameter_l": 12.05, "radius_ratio_d": 1,
                   "orientation": ["longitudinal", "transverse"], "wavelength_over_a": [1, 2]},
         "grid": {"cells_x": 32, "cells_y": 32}}


class SweepProgram(FolderTest):
    def sweep(self, groups, *arguments, ranks=0):
        Path(self.folder, "sweep.nml").write_text(namelist(groups))
        return run("sweep", "sweep.nml", *arguments, ranks=ranks, folder=self.folder)

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def test_help_and_version(self):
        outcome = run("sweep", "--help")
        self.assertEqual((outcome.returncode, outcome.stderr), (0, ""))
        self.assertIn("--overwrite", outcome.stdout)
        outcome = run("sweep", "--version", ranks=2)
        self.check_status(outcome)
        self.assertRegex(outcome.stdout, r"^ehlwave \d+\.\d+\.\d+\n$")

    def test_plan_writes_nothing(self):
        outcome = self.sweep(SWEEP, "--plan")
        self.check_status(outcome)
        self.assertIn("8 cases, ", outcome.stdout)
        self.assertEqual(len([line for line in outcome.stdout.split("\n") if " x " in line]), 8)
        self.assertEqual(self.names(), ["sweep.nml"])

    def test_line_contacts(self):
        """D = 0 in lists, beside an elliptical contact that needs cells_y, and in CSV columns."""
        groups = {"sweep": {"load_parameter_m": 50, "lubricant_parameter_l": 8, "radius_ratio_d": [0, 1], "f_v": [2, 4],
                            "orientation": "transverse", "output": "lists.h5"},
                  "waviness": {"response": "harmonic"}, "grid": {"cells_x": 128, "cells_y": 64}}
        outcome = self.sweep(groups)
        self.check_status(outcome)
        self.assertIn("4 cases", outcome.stdout)
        self.assertIn("4 converged", outcome.stdout)
        rows = ["load_parameter_m,lubricant_parameter_l,radius_ratio_d,orientation,f_v,cells_x",
                "50,8,0,transverse,2,128", "50,8,0,transverse,4,128"]
        Path(self.folder, "rows.csv").write_text("\n".join(rows) + "\n")
        outcome = self.sweep({"sweep": {"case_file": "rows.csv", "output": "rows.h5"}, "waviness": {"response": "harmonic"}})
        self.check_status(outcome)
        self.assertIn("2 converged", outcome.stdout)
        groups["sweep"]["radius_ratio_d"] = 0
        outcome = self.sweep(groups, "--plan")
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("cells_y", outcome.stderr)

    def test_run(self):
        for ranks in [0, 2]:
            outcome = self.sweep(SWEEP, "--output", f"results_{ranks}.h5", ranks=ranks)
            self.check_status(outcome)
            self.assertIn("8/8 cases, 0 failed", outcome.stdout)
        self.assertEqual(self.names(), ["results_0.h5", "results_0.store", "results_2.h5", "results_2.store", "sweep.nml"])

    def test_existing_results_are_kept(self):
        results = Path(self.folder, "results.h5")
        results.write_text("precious")
        for ranks in [0, 2]:
            outcome = self.sweep(SWEEP, ranks=ranks)
            self.assertEqual(outcome.returncode, 2)
            self.assertIn("--overwrite", outcome.stderr)
            self.assertEqual(results.read_text(), "precious")
        outcome = self.sweep(SWEEP, "--overwrite")
        self.assertEqual(outcome.returncode, 0)
        self.assertTrue(results.read_bytes().startswith(b"\x89HDF"))

    def test_failing_cases(self):
        for ranks in [0, 2]:
            outcome = self.sweep({**SWEEP, "solver": {"largest_steps": 1}}, "--overwrite", ranks=ranks)
            self.check_status(outcome, 1)
            self.assertIn("8/8 cases, 8 failed", outcome.stdout)
            self.assertIn("stalled", outcome.stdout)
            self.assertIn("results.h5", self.names())

    def test_unresolved_cases_can_be_left_out(self):
        groups = {**SWEEP, "sweep": {**SWEEP["sweep"], "unresolved": "skip", "wavelength_over_a": [0.5, 2],
                                     "load_parameter_m": 20}}
        outcome = self.sweep(groups, "--plan")
        self.check_status(outcome)
        self.assertIn("2 cases, 2 resolved, 2 unresolved left out", outcome.stdout)
        groups["sweep"]["wavelength_over_a"] = 0.5
        outcome = self.sweep(groups, "--plan")
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("unresolved", outcome.stderr)


if __name__ == "__main__":
    unittest.main()
