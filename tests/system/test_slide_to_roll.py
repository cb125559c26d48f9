"""A slide-to-roll ratio is another form of the slip parameter: S = 1 + ratio/2, one identity, one store."""

import unittest
from pathlib import Path

from ehlwave_program import FolderTest, last_line, namelist, run
from hdf5_reading import read

CONDITIONS = {"load_parameter_m": 20, "lubricant_parameter_l": 5, "radius_ratio_d": 1}
GRID = {"cells_x": 32, "cells_y": 32}
# S and 1 + ratio/2 differ in the last bits here
SAME = [(0.3, 1.15), (-0.3, 0.85), (0, 1), (2, 2), (-2, 0), (-1.98, 0.01), (0.1, 1.05)]


class SlideToRoll(FolderTest):
    def case(self, *arguments, **keys):
        groups = {"conditions": CONDITIONS | keys, "grid": GRID}
        Path(self.folder, "case.nml").write_text(namelist(groups))
        return run("case", "case.nml", *arguments, folder=self.folder)

    def sweep(self, conditions, *arguments, status=0, **lists):
        groups = {"sweep": lists, "conditions": CONDITIONS | conditions, "grid": GRID}
        Path(self.folder, "sweep.nml").write_text(namelist(groups))
        outcome = run("sweep", "sweep.nml", *arguments, folder=self.folder)
        self.check_status(outcome, status)
        return outcome

    def test_identity_and_effective_input(self):
        for ratio, slip in SAME:
            one = last_line(self.case("--json", "--quiet", slide_to_roll_ratio=ratio))
            other = last_line(self.case("--json", "--quiet", slip_parameter=slip))
            for name in ("case_id", "slip_parameter", "central_film"):
                self.assertEqual(one[name], other[name], f"{name} of {ratio}")
            self.assertEqual(one["slip_parameter"], slip)

    def test_both_are_refused(self):
        outcome = self.case("--plan", slide_to_roll_ratio=0, slip_parameter=1)
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("slip_parameter = 1 and slide_to_roll_ratio = 0", outcome.stderr)
        outcome = self.sweep({"slip_parameter": 1.5}, "--plan", status=2, slide_to_roll_ratio=[0, 0.3])
        self.assertIn("slip_parameter = 1.5 and slide_to_roll_ratio = 0", outcome.stderr)
        Path(self.folder, "cases.csv").write_text("slide_to_roll_ratio\n0\n")   # 0 is a ratio, not none
        self.sweep({"slip_parameter": 1.5}, "--plan", status=2, case_file="cases.csv")
        outcome = self.case("--plan", slide_to_roll_ratio=2.5)
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("slide_to_roll_ratio", outcome.stderr)

    def test_lists_and_columns(self):
        self.sweep({}, "--overwrite", output="results.h5", slide_to_roll_ratio=[-0.3, 0, 0.3])
        data = read(self.folder / "results.h5")[1]
        self.assertEqual(list(data["slip_parameter"]), [0.85, 1, 1.15])
        self.assertEqual(list(data["slide_to_roll_ratio"]), [-0.3, 0, 0.3])
        # the store finds them by the other key
        outcome = self.sweep({}, output="results.h5", slip_parameter=[0.85, 1, 1.15])
        self.assertIn("3 of 3 cases found in the store", outcome.stdout)
        # a column of each, one in a row; both keys lead to the same case
        Path(self.folder, "cases.csv").write_text("slide_to_roll_ratio,slip_parameter\n-0.3,\n,0.85\n,1.15\n")
        outcome = self.sweep({}, "--plan", case_file="cases.csv")
        self.assertIn("slip_parameter = 1.15, slide_to_roll_ratio = 0.3", outcome.stdout)
        self.assertIn("2 cases", outcome.stdout)


if __name__ == "__main__":
    unittest.main()
