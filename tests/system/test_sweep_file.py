"""Rows of a sweep's results file: independent of the number of ranks, complete, without duplicates."""

import math
import unittest
from pathlib import Path

from ehlwave_program import FolderTest, last_line, namelist, run
from hdf5_reading import dimensions, read

SWEEP = {"sweep": {"load_parameter_m": [100, 200], "lubricant_parameter_l": 12.05, "radius_ratio_d": [1, 0.35],
                   "orientation": ["longitudinal", "transverse", "isotropic"], "wavelength_over_a": [1]},
         "grid": {"cells_x": 32, "cells_y": 32}}
# where and when a case ran may differ
CIRCUMSTANCES = {"rank", "host", "started", "finished", "seconds", "work_units", "peak_memory_mib"}


class SweepFile(FolderTest):
    def sweep(self, groups, status=0, ranks=0):
        Path(self.folder, "sweep.nml").write_text(namelist(groups))
        outcome = run("sweep", "sweep.nml", "--overwrite", ranks=ranks, folder=self.folder)
        self.check_status(outcome, status)
        self.assertEqual(list(self.folder.glob("*.part*")), [])
        return read(self.folder / "results.h5")

    def test_ranks_do_not_matter(self):
        _, alone = self.sweep(SWEEP)
        self.assertEqual(len(alone["case"]), 12)
        self.assertLessEqual(CIRCUMSTANCES, set(alone))
        self.assertGreater(alone["seconds"].min(), 0)
        for ranks in [1, 2, 4]:
            with self.subTest(ranks=ranks):
                _, data = self.sweep(SWEEP, ranks=ranks)
                self.assertEqual(set(data), set(alone))
                self.assertTrue(all(0 <= rank < ranks for rank in data["rank"]))
                for name in set(data) - CIRCUMSTANCES:
                    same = data[name] == alone[name] if isinstance(data[name], list) \
                        else data[name].tobytes() == alone[name].tobytes()
                    self.assertTrue(same, f"{name}: {data[name]} against {alone[name]}")

    def test_rows_hold_their_case(self):
        attributes, data = self.sweep(SWEEP)
        self.assertEqual(attributes["format"], "ehlwave-results")
        self.assertEqual(attributes["sweep_input"].rstrip(), namelist(SWEEP).rstrip())
        self.assertEqual(dimensions(self.folder / "results.h5", "amplitude_ratio"), ["case"])
        self.assertEqual(data["orientation"], ["longitudinal", "transverse", "isotropic"]*4)
        self.assertEqual(list(data["load_parameter_m"]), [100]*3 + [200]*3 + [100]*3 + [200]*3)
        self.assertEqual(len(set(data["case_id"])), 12)
        for row in [0, 4, 11]:
            Path(self.folder, "case.nml").write_text(data["effective_input"][row].rstrip() + "\n")
            outcome = run("case", "case.nml", "--json", "--quiet", folder=self.folder)
            result = last_line(outcome)
            self.assertEqual(result["case_id"], data["case_id"][row])
            for name in ["central_film", "amplitude_ratio", "amplitude_ratio_fit", "v", "f_r", "nonlinear_steps",
                         "rung", "rescued_solutions"]:
                self.assertEqual(result[name], data[name][row], f"{name} of row {row}")

    def test_failing_cases_are_rows(self):
        path = Path(self.folder, "cases.csv")
        path.write_text("load_parameter_m,lubricant_parameter_l,radius_ratio_d,orientation,wavelength_over_a,cells_x\n"
                        "100,12.05,1,transverse,0.5,64\n100,12.05,1,none,0,64\n")
        groups = {"sweep": {"case_file": "cases.csv"}, "grid": {"cells_y": 64},
                  "solver": {"largest_total_steps": 30, "step_tolerance": 1e-12, "tolerance": 1e-4}}
        for ranks in [0, 2]:
            _, data = self.sweep(groups, status=1, ranks=ranks)
            self.assertEqual(data["status"][0], "stalled")
            self.assertIn(data["status"][1], ["converged", "unresolved"])
            self.assertIn("time step", data["message"][0])
            self.assertTrue(math.isnan(data["amplitude_ratio"][0]))
            self.assertTrue(math.isfinite(data["central_film"][0]) and math.isfinite(data["central_film"][1]))

    def test_case_file(self):
        Path(self.folder, "cases.csv").write_text(
            "load_parameter_m, radius_ratio_d, orientation, f_v\n"
            "100, 1, transverse, 3\n# a comment\n200, 0.35, Isotropic, 3\n\n200, 0.35, longitudinal, 12\n")
        groups = {"sweep": {"case_file": "cases.csv"}, "conditions": {"lubricant_parameter_l": 12.05},
                  "grid": {"cells_x": 32, "cells_y": 32}}
        _, data = self.sweep(groups)
        self.assertEqual(data["orientation"], ["transverse", "isotropic", "longitudinal"])
        for row, expected in enumerate([3, 3, 12]):
            self.assertAlmostEqual(data["f_r"][row]*data["v"][row], expected, delta=1e-12)
        self.assertTrue(all(math.isfinite(ratio) for ratio in data["amplitude_ratio"]))

    def test_duplicates_are_removed(self):
        groups = {**SWEEP, "sweep": {**SWEEP["sweep"], "load_parameter_m": [100, 100, 1e2], "radius_ratio_d": 1,
                                     "orientation": ["longitudinal", "none"], "wavelength_over_a": [1, 2]}}
        _, data = self.sweep(groups)
        self.assertEqual(data["orientation"], ["longitudinal", "longitudinal", "none"])
        self.assertEqual(list(data["wavelength_over_a"]), [1, 2, 0])


if __name__ == "__main__":
    unittest.main()
