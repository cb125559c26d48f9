"""Refusals of ehlwave-sweep: exit status 2 on every rank, one message, nothing written."""

import copy
import unittest
from pathlib import Path

from ehlwave_program import FolderTest, namelist, run

GOOD = {"sweep": {"load_parameter_m": [100, 200], "lubricant_parameter_l": 12.05, "radius_ratio_d": 1,
                  "orientation": "transverse", "wavelength_over_a": 1},
        "grid": {"cells_x": 32, "cells_y": 32}}
HEADER = "load_parameter_m,lubricant_parameter_l,radius_ratio_d,orientation,wavelength_over_a"
ROW = "100,12.05,1,transverse,1"

# case, group, key, value, needle
CHANGES = [
    ("unknown key", "sweep", "loads", 3, "loads"),
    ("negative in a list", "sweep", "load_parameter_m", [100, -200], "load_parameter_m"),
    ("D out of range", "sweep", "radius_ratio_d", [1, 1.2], "radius_ratio_d"),
    ("unknown orientation", "sweep", "orientation", ["transverse", "diagonal"], "orientation"),
    ("wavelength and f_v", "sweep", "f_v", 1.0, "f_v"),
    ("case file and lists", "sweep", "case_file", "cases.csv", "case_file"),
    ("list in a case group", "grid", "cells_x", [32, 64], "cells_x"),
    ("contradiction in a case group", "dynamics", "natural_frequency", 5, "natural_frequency"),
    ("surface beside waves", "surface", "file", "s.h5", "give one of the two"),
    ("dimensional data beside lists", "conditions", "load_n", 39.2, "load_parameter_m"),
]

# case, line 7 of the file, needles
TYPOS = [
    ("not a number", "1oo,12.05,1,transverse,1", ["cases.csv:7:", "load_parameter_m", "1oo"]),
    ("NaN", "nan,12.05,1,transverse,1", ["cases.csv:7:", "load_parameter_m"]),
    ("empty", "100,,1,transverse,1", ["cases.csv:7:", "lubricant_parameter_l"]),
    ("negative", "-100,12.05,1,transverse,1", ["cases.csv:7:", "load_parameter_m"]),
    ("D out of range", "100,12.05,1.5,transverse,1", ["cases.csv:7:", "radius_ratio_d"]),
    ("word", "100,12.05,1,transvers,1", ["cases.csv:7:", "orientation", "transvers"]),
    ("short", "100,12.05,1,transverse", ["cases.csv:7:"]),
    ("long", "100,12.05,1,transverse,1,1", ["cases.csv:7:"]),
]


class BadSweep(FolderTest):
    def write(self, name, text):
        Path(self.folder, name).write_text(text)

    def refuse(self, needles, *arguments, ranks=0):
        Path(self.folder, "results.h5").unlink(missing_ok=True)   # results of an earlier mistake that was accepted
        before = sorted(self.folder.iterdir())
        outcome = run("sweep", *arguments, ranks=ranks, folder=self.folder)
        self.check_status(outcome, 2)
        self.assertEqual(outcome.stderr.count("ehlwave-sweep: "), 1, outcome.stderr)
        for needle in needles:
            self.assertIn(needle, outcome.stderr)
        self.assertEqual(sorted(self.folder.iterdir()), before)

    def test_values(self):
        for what, group, key, value, needle in CHANGES:
            with self.subTest(what=what):
                groups = copy.deepcopy(GOOD)
                groups.setdefault(group, {})[key] = value
                if what.startswith("dimensional"):
                    groups["conditions"] = {"radius_x_m": 0.0125, "radius_y_m": 0.0125, "reduced_modulus_pa": 1.17e11,
                                            "load_n": 39.2, "mean_speed_m_per_s": 0.024, "viscosity_pa_s": 1.22}
                self.write("sweep.nml", namelist(groups))
                self.refuse([needle], "sweep.nml")

    def test_rows_of_a_case_file(self):
        groups = {"sweep": {"case_file": "cases.csv"}, "grid": GOOD["grid"]}
        self.write("sweep.nml", namelist(groups))
        for what, row, needles in TYPOS:
            with self.subTest(what=what):
                # a comment, the header, three rows, an empty line: the typo is in line 7
                self.write("cases.csv", "\n".join(["# cases", HEADER, ROW, ROW, ROW, "", row, ROW]) + "\n")
                self.refuse(needles, "sweep.nml")
        with self.subTest(what="line 731"):
            rows = [f"{100 + n},12.05,1,transverse,1" for n in range(1000)]
            rows[729] = rows[729].replace("12.05", "12.O5")
            self.write("cases.csv", "\n".join([HEADER, *rows]) + "\n")
            self.refuse(["cases.csv:731:", "lubricant_parameter_l", "12.O5"], "sweep.nml", ranks=2)
        with self.subTest(what="unknown column"):
            self.write("cases.csv", HEADER.replace("wavelength_over_a", "wavelength") + "\n" + ROW + "\n")
            self.refuse(["cases.csv", "wavelength"], "sweep.nml")
        with self.subTest(what="column given twice"):
            self.write("cases.csv", HEADER + ",load_parameter_m\n" + ROW + ",200\n")
            self.refuse(["cases.csv", "load_parameter_m"], "sweep.nml")
        with self.subTest(what="fraction of a cell"):
            self.write("cases.csv", HEADER + ",cells_x\n" + ROW + ",64.4\n")
            self.refuse(["cases.csv:2:", "cells_x"], "sweep.nml")
        with self.subTest(what="no rows"):
            self.write("cases.csv", HEADER + "\n")
            self.refuse(["cases.csv"], "sweep.nml")
        with self.subTest(what="missing file"):
            Path(self.folder, "cases.csv").unlink()
            self.refuse(["cases.csv"], "sweep.nml")

    def test_on_two_ranks(self):
        groups = copy.deepcopy(GOOD)
        groups["sweep"]["radius_ratio_d"] = 2
        self.write("sweep.nml", namelist(groups))
        self.refuse(["radius_ratio_d"], "sweep.nml", ranks=2)
        self.write("sweep.nml", namelist(GOOD))
        self.refuse(["no/such/folder"], "sweep.nml", "--output", "no/such/folder/r.h5", ranks=2)
        self.refuse(["--plna"], "sweep.nml", "--plna", ranks=2)

    def test_files(self):
        self.refuse(["missing.nml"], "missing.nml")
        self.refuse(["sweep file"])
        self.write("empty.nml", "")
        self.refuse(["empty.nml"], "empty.nml")


if __name__ == "__main__":
    unittest.main()
