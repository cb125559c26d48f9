"""Any key of a case is a list in &sweep or a column of a CSV file: rows, plan, status, and refusals."""

import copy
import math
import re
import unittest
from pathlib import Path

from ehlwave_program import FolderTest, last_line, namelist, run
from hdf5_reading import read

CONDITIONS = {"load_parameter_m": 20, "lubricant_parameter_l": 5, "radius_ratio_d": 1}
SHARED = {"conditions": CONDITIONS, "waviness": {"orientation": "transverse", "wavelength_over_a": 2},
          "grid": {"cells_x": 32, "cells_y": 32}}
CIRCUMSTANCES = {"rank", "host", "started", "finished", "seconds", "work_units", "harmonic_work_units", "peak_memory_mib"}
GROUP_OF = {"slip_parameter": "conditions", "method": "solver", "step_tolerance": "solver", "roelands_index": "lubricant",
            "tolerance": "solver", "oblique": "waviness", "amplitude_over_film": "waviness", "cells_x": "grid"}


class SweepKeys(FolderTest):
    def write(self, name, text):
        Path(self.folder, name).write_text(text)

    def sweep(self, groups, *arguments, ranks=0, status=0):
        self.write("sweep.nml", namelist({"sweep": {}, **groups}))   # &sweep on line 1
        outcome = run("sweep", "sweep.nml", *arguments, ranks=ranks, folder=self.folder)
        self.check_status(outcome, status)
        return outcome

    def results(self, groups, ranks=0):
        self.sweep(groups, "--overwrite", ranks=ranks)
        return read(self.folder / "results.h5")[1]

    def assert_same(self, data, other, names=None):
        for name in (set(data) - CIRCUMSTANCES if names is None else names):
            same = data[name] == other[name] if isinstance(data[name], list) else data[name].tobytes() == other[name].tobytes()
            self.assertTrue(same, f"{name}: {data[name]} against {other[name]}")

    def assert_row_is_case(self, data, row, shared, keys):
        """A row holds the results of ehlwave-case with the same keys."""
        groups = copy.deepcopy(shared)
        for key, value in keys.items():
            groups.setdefault(GROUP_OF[key], {})[key] = value
        self.write("case.nml", namelist(groups))
        result = last_line(run("case", "case.nml", "--json", "--quiet", folder=self.folder))
        for name in ["case_id", "status", "central_film", "amplitude_ratio", "harmonic_ratio", "nonlinear_steps"]:
            if isinstance(data[name][row], float) and math.isnan(data[name][row]):
                self.assertIsNone(result[name], name)
            else:
                self.assertEqual(data[name][row], result[name], f"{name} of {keys}")

    def test_lists_and_columns(self):
        lists = {"slip_parameter": [1, 1.5], "method": ["newton", "fas"], "step_tolerance": [1e-4, 1e-3]}
        cases = [{"slip_parameter": s, "step_tolerance": t, "method": m}
                 for s in lists["slip_parameter"] for t in lists["step_tolerance"] for m in lists["method"]]
        alone = self.results({**SHARED, "sweep": lists})
        self.assertEqual(len(alone["case"]), 8)
        for name in lists:
            self.assertEqual(list(alone[name]), [case[name] for case in cases], name)
        self.assertEqual(len(set(alone["case_id"])), 8)
        self.assertEqual(set(alone["status"]), {"converged"})
        self.assertNotEqual(alone["amplitude_ratio"][0], alone["amplitude_ratio"][4])
        for row in [0, 3, 6]:
            self.assert_row_is_case(alone, row, SHARED, cases[row])
        self.assert_same(alone, self.results({**SHARED, "sweep": lists}, ranks=2))

        # the rows from a table, a byte order mark before it
        self.write("cases.csv", "\ufeff" + "\n".join([",".join(lists)] + [",".join(str(case[name]) for name in lists)
                                                                          for case in cases]) + "\n")
        for ranks in [0, 2]:
            self.assert_same(alone, self.results({**SHARED, "sweep": {"case_file": "cases.csv"}}, ranks=ranks))

        # found again, shown in plan and status
        outcome = self.sweep({**SHARED, "sweep": {"case_file": "cases.csv"}})
        self.assertIn("8 of 8 cases found in the store", outcome.stdout)
        plan = self.sweep({**SHARED, "sweep": lists}, "--plan").stdout
        self.assertIn("slip_parameter = 1.5, step_tolerance = 0.001, method = 'fas'", plan)
        status = run("sweep", "--status", "results.h5", folder=self.folder)
        self.assertIn("slip_parameter = 1.5, step_tolerance =", status.stdout)

    def test_steady_states_are_shared_by_equal_ones_only(self):
        shared = copy.deepcopy(SHARED)
        shared["waviness"]["response"] = "harmonic"
        lists = {"roelands_index": [0.4, 0.68], "tolerance": [1e-4, 1e-8], "wavelength_over_a": [2, 3]}
        data = self.results({**shared, "sweep": lists})
        self.assertEqual(len(data["case"]), 8)
        for row in range(0, 8, 2):
            self.assertEqual(data["central_film"][row], data["central_film"][row + 1])
            self.assert_row_is_case(data, row, shared, {name: data[name][row] for name in ["roelands_index", "tolerance"]})
        self.assertEqual(len(set(data["central_film"])), 4)
        self.assert_same(data, self.results({**shared, "sweep": lists}, ranks=2))

    def test_keys_that_apply_to_some(self):
        self.write("sweep.nml", namelist({
            **SHARED, "sweep": {"method": ["newton", "fas"], "cycle": ["v", "w"], "orientation": ["none", "custom"],
                                "oblique": [False, True], "cells_x": [32, 64]},
            "waviness": {"wavelength_x_over_a": 1, "wavelength_y_over_a": 2}}))
        plan = run("sweep", "sweep.nml", "--plan", folder=self.folder)
        # per grid: newton and two cycles of FAS; of each a smooth contact and two patterns
        self.assertIn("\n18 cases,", plan.stdout, plan.stderr)

    def test_keys_that_count_in_some(self):
        """Load steps belong to moving waves: the others have a single case each."""
        groups = {**SHARED, "sweep": {"orientation": ["none", "transverse", "longitudinal"], "load_factor": [1, 1.1]}}
        self.assertIn("\n4 cases,", self.sweep(groups, "--plan").stdout)
        groups["sweep"]["orientation"] = ["none", "longitudinal"]
        self.assertIn("belongs to marches in time", self.refused(groups))
        groups["sweep"] = {"case_file": "cases.csv"}
        for orientation, said in ("transverse", ""), ("longitudinal", "column 'load_factor': belongs to marches in time"):
            self.write("cases.csv", f"orientation,load_factor\n{orientation},1\n{orientation},1.1\nlongitudinal,1\n")
            if said:
                self.assertIn(said, self.refused(groups))
            else:
                self.assertIn("\n3 cases,", self.sweep(groups, "--plan").stdout)

    def test_line_contacts_beside_others(self):
        self.write("cases.csv", "radius_ratio_d,cells_y,cells_x\n1,32,32\n0,32,64\n0,,64\n")
        groups = {**SHARED, "sweep": {"case_file": "cases.csv"}, "grid": {"y_max": 2.5}}
        groups["conditions"] = {"load_parameter_m": 20, "lubricant_parameter_l": 5}
        plan = self.sweep(groups, "--plan")
        self.assertIn("\n2 cases,", plan.stdout)

    def refused(self, groups, ranks=0):
        outcome = self.sweep(groups, ranks=ranks, status=2)
        self.assertFalse(Path(self.folder, "results.h5").exists())
        lines = [line for line in outcome.stderr.split("\n") if line.startswith("ehlwave-sweep: ")]
        self.assertEqual(len(lines), 1, outcome.stderr)
        return lines[0].removeprefix("ehlwave-sweep: ")

    def test_bounds_are_those_of_a_case_file(self):
        for key, value in [("amplitude_over_film", 1.5), ("slip_parameter", 2.5), ("tolerance", 0), ("roelands_index", -1),
                           ("method", "picard"), ("cells_x", 64.5)]:
            with self.subTest(key=key):
                groups = copy.deepcopy(SHARED)
                groups.setdefault(GROUP_OF[key], {})[key] = value
                self.write("case.nml", namelist(groups))
                outcome = run("case", "case.nml", folder=self.folder)
                self.assertEqual(outcome.returncode, 2)
                reason = outcome.stderr.rstrip("\n").split(": ", 3)[-1]
                self.write("cases.csv", f"load_parameter_m,{key}\n20,{value}\n")
                for ranks in [0, 2]:
                    self.assertEqual(self.refused({**SHARED, "sweep": {key: value}}, ranks),
                                     f"sweep.nml:2: key '{key}' in &sweep: {reason}")
                    self.assertEqual(self.refused({**SHARED, "sweep": {"case_file": "cases.csv"}}, ranks),
                                     f"cases.csv:2: column {key}: {reason}")

    def test_contradictions(self):
        for sweep, needle in [
                ({"cycle": ["v", "w"]}, "sweep.nml:2: key 'cycle' in &sweep: belongs to method = 'fas', which none"),
                ({"fields": [True, False]}, "sweep.nml:2: key 'fields' in &sweep: this key cannot vary"),
                ({"file": "surface.h5"}, "&surface file = 'surface.h5' and &waviness orientation = 'transverse': give one"),
                ({"slip_paramter": [1, 2]}, "did you mean 'slip_parameter'?"),
                ({"cells_x": [32, 33]}, "cells_x = 33"),
                ({"load_n": [10, 20]}, "&conditions gives both"),
                ({"f_v": 1, "wavelength_over_a": 1}, "give one of the two"),
                ({"f_v": [1, 2], "orientation": "none"}, "sweep.nml:2: key 'f_v' in &sweep: belongs to orientation = 'transverse'"),
                ({"step_tolerance": [1e-4 + 1e-8*k for k in range(2000)], "tolerance": [1e-6 + 1e-10*k for k in range(2000)]},
                 "have 4000000 combinations")]:
            with self.subTest(sweep=list(sweep)):
                self.assertIn(needle, self.refused({**SHARED, "sweep": sweep}))
        groups = {**SHARED, "sweep": {"slip_parameter": [1, 1.5]}, "solver": {"cycle": "v"}}
        self.assertIn("key 'cycle' in &solver: belongs to method = 'fas', which none", self.refused(groups))

    def test_list_in_place_of_a_group(self):
        groups = {**SHARED, "sweep": {"cells_x": [32, 64]}}
        plan = self.sweep(groups, "--plan")
        self.assertIn("NOTICE: sweep.nml:14: cells_x of &grid gives way to the values that the sweep lists", plan.stdout)
        self.assertIn("\n2 cases,", plan.stdout)


class Reference(unittest.TestCase):
    def test_pages_have_what_the_program_prints(self):
        printed = run("sweep", "--keys", "--markdown").stdout
        inputs = Path(__file__).resolve().parents[2]/"inputs"
        groups = re.findall(r"^## `&(\w+)`$", printed, re.MULTILINE)
        pages = "\n".join("#" + (inputs/"keys"/f"{group}.md").read_text() for group in groups)
        self.assertEqual(pages, printed, "inputs/keys: write its pages by python -m studies.typed_keys in postprocess")
        self.assertEqual({page.stem for page in (inputs/"keys").glob("*.md")}, set(groups))
        index = (inputs/"README.md").read_text()
        self.assertEqual([group for group in groups if f"(keys/{group}.md)" not in index], [], "inputs/README.md lists all groups")

    def test_text(self):
        case = run("case", "--keys")
        self.assertEqual(case.returncode, 0)
        self.assertIn("\n&solver\n", case.stdout)
        self.assertTrue(run("sweep", "--keys").stdout.startswith(case.stdout))

    def test_json_says_what_the_text_says(self):
        text = run("case", "--keys").stdout
        outcome = run("case", "--keys", "--json")
        self.assertEqual((outcome.returncode, outcome.stdout.count("\n")), (0, 1))
        keys = last_line(outcome)["keys"]
        names = [f"  {key['name']} (default: {key['default_text']})" for key in keys]
        self.assertEqual([line for line in text.splitlines() if line.startswith("  ") and line[2] != " "], names)
        self.assertEqual(len({(key["group"], key["name"]) for key in keys}), len(keys))
        said = "".join(line.strip() + " " for line in text.splitlines())
        for key in keys:
            with self.subTest(key["name"]):
                self.assertIn(key["help"], said)
                self.assertIn(key["belongs_to"], said)
                self.assertIn(key["kind"], ("number", "whole", "truth", "word"))
                self.assertTrue(key["default"] is None or not key["required"])
                if key["kind"] in ("number", "whole") and key["default"] is not None:
                    self.assertEqual(float(key["default_text"]), key["default"])
                if key["choices"] and key["default"] is not None:
                    self.assertIn(key["default"], key["choices"])
        known = {key["name"]: key for key in keys}
        self.assertEqual((known["load_parameter_m"]["above"], known["load_parameter_m"]["minimum"]), (0, None))
        self.assertEqual((known["slip_parameter"]["maximum"], known["slip_parameter"]["default"]), (2, 1))
        self.assertEqual(known["edges"]["choices"], ["flooded", "truncated"])


if __name__ == "__main__":
    unittest.main()
