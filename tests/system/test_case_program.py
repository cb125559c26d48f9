"""ehlwave-case as a user meets it: options, output, exit status."""

import math
import unittest
from pathlib import Path

from ehlwave_program import FolderTest, last_line, namelist, run

SMOOTH = {"conditions": {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1},
          "grid": {"cells_x": 64, "cells_y": 64}}
WAVY = {**SMOOTH, "waviness": {"orientation": "transverse", "wavelength_over_a": 0.5}}
KEYS = ["status", "central_film", "minimum_film", "central_film_moes", "max_pressure", "load_error", "residual",
        "amplitude_ratio", "amplitude_ratio_fit", "v", "v2", "f_r", "formula_ratio", "time_steps", "seconds", "work_units",
        "peak_memory_mib"]


class CaseProgram(FolderTest):
    def run_case(self, groups, *arguments):
        Path(self.folder, "case.nml").write_text(namelist(groups))
        return run("case", "case.nml", *arguments, folder=self.folder)

    def test_help_and_version(self):
        outcome = run("case", "--help")
        self.assertEqual((outcome.returncode, outcome.stderr), (0, ""))
        for option in ["--plan", "--json", "--output", "--quiet", "Exit status"]:
            self.assertIn(option, outcome.stdout)
        outcome = run("case", "--version")
        self.assertEqual(outcome.returncode, 0)
        self.assertRegex(outcome.stdout, r"^ehlwave \d+\.\d+\.\d+\n$")

    def test_minimal_input_of_the_help_text(self):
        Path(self.folder, "minimal.nml").write_text(
            "&conditions load_parameter_m = 100, lubricant_parameter_l = 12.05,\n radius_ratio_d = 1 /\n")
        outcome = run("case", "minimal.nml", "--plan", folder=self.folder)
        self.check_status(outcome)

    def test_plan_computes_nothing(self):
        outcome = self.run_case(WAVY, "--plan", "--json")
        self.assertEqual((outcome.returncode, outcome.stderr), (0, ""))
        plan = last_line(outcome)
        self.assertEqual((plan["run"], plan["time_steps"], plan["is_resolved"]), ("march", 72, True))
        self.assertNotIn("central_film", plan)
        self.assertNotIn("Status", outcome.stdout)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["case.nml"])

    def test_plan_says_unresolved(self):
        groups = {**WAVY, "waviness": {"orientation": "transverse", "wavelength_over_a": 0.3}}
        outcome = self.run_case(groups, "--plan", "--json")
        self.assertEqual(outcome.returncode, 0)
        self.assertIn("NOT RESOLVED", outcome.stdout)
        self.assertFalse(last_line(outcome)["is_resolved"])

    def test_plan_warns_of_cells_that_cannot_be_halved(self):
        for cells, is_slow in ((258, True), (256, False), (200, False)):
            groups = {**WAVY, "grid": {"cells_x": cells, "cells_y": cells}}
            text = self.run_case(groups, "--plan").stdout
            self.assertEqual("258 cells on the coarsest grid): several times the work of 320 x 320" in text, is_slow, cells)
            self.assertEqual("can hardly be halved" in text, is_slow, cells)

    def test_plan_of_an_oil_that_does_not_thicken(self):
        """V is infinite for L = 0: no value."""
        conditions = {"load_parameter_m": 50, "lubricant_parameter_l": 0, "radius_ratio_d": 1}
        plan = last_line(self.run_case({**WAVY, "conditions": conditions}, "--plan", "--json"))
        self.assertEqual([plan[name] for name in ("v", "v2", "formula_ratio")], [None]*3)

    def test_plan_says_the_linear_range_of_both_surfaces(self):
        """Either surface of a pair may exceed it."""
        said = {}
        for amplitudes in ((0.01, 0.01), (0.01, 0.5), (0.5, 0.01)):
            groups = {"conditions": {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1, "slip_parameter": 1.25},
                      "grid": {"cells_x": 64, "cells_y": 64}}
            for name, amplitude in zip(("waviness", "waviness2"), amplitudes, strict=True):
                groups[name] = {"orientation": "transverse", "wavelength_over_a": 1, "amplitude_over_film": amplitude}
            said[amplitudes] = last_line(self.run_case(groups, "--plan", "--json"))["validity"]
            self.assertIn("on surface 1 and", said[amplitudes])
            self.assertEqual("WARNING" in self.run_case(groups, "--plan").stdout, max(amplitudes) > 0.1)
        self.assertNotIn("asked for", said[0.01, 0.01])
        self.assertIn("asked for 1 % and 50 %", said[0.01, 0.5])
        self.assertIn("asked for 50 % and 1 %", said[0.5, 0.01])

    def test_methods_agree(self):
        newton = last_line(self.run_case(SMOOTH, "--json"))
        for cycle in "vwf":
            groups = {**SMOOTH, "solver": {"method": "fas", "cycle": cycle}}
            outcome = self.run_case(groups, "--json")
            self.check_status(outcome)
            self.assertIn(f"FAS multigrid, {cycle} cycles", outcome.stdout)
            self.assertRegex(outcome.stdout, r"\d+ cycles and \d+ sweeps")
            self.assertAlmostEqual(last_line(outcome)["central_film"] / newton["central_film"], 1, delta=1e-6)

    def test_result(self):
        outcome = self.run_case(WAVY, "--json")
        self.check_status(outcome)
        result = last_line(outcome)
        self.assertEqual([key for key in KEYS if key not in result], [])
        self.assertEqual(result["status"], "converged")
        for key in KEYS[1:]:
            self.assertTrue(isinstance(result[key], (int, float)) and math.isfinite(result[key]), f"{key}: {result[key]}")
        self.assertEqual(result["time_steps"], 72)
        self.assertLess(result["residual"], 1e-3)
        self.assertGreater(result["seconds"], 0)
        self.assertIn("time step", outcome.stderr)
        self.assertNotIn("\n{", outcome.stdout[:outcome.stdout.rindex("{") - 1])

    def test_smooth_result_has_no_amplitude(self):
        outcome = self.run_case(SMOOTH, "--json", "--quiet")
        result = last_line(outcome)
        self.assertEqual(outcome.returncode, 0)
        self.assertIsNone(result["amplitude_ratio"])
        self.assertIsNone(result["amplitude_ratio_fit"])
        self.assertEqual(outcome.stderr, "", "quiet means no progress lines")

    def test_march_of_waves_that_stand_still(self):
        """It has no Ad/Ai, with a message; the film has its error."""
        waves = {**WAVY["waviness"], "orientation": "longitudinal"}
        outcome = self.run_case({**WAVY, "waviness": waves, "dynamics": {"end_time": 0.25}})
        self.check_status(outcome)
        self.assertIn("no Ad/Ai of the march: the pattern stands still", outcome.stdout)
        self.assertRegex(outcome.stdout, r"of H\(0,0\) in all 0\.\d+: mesh")

    def test_text_without_json(self):
        outcome = self.run_case(SMOOTH)
        self.assertEqual(outcome.returncode, 0)
        self.assertNotIn("{", outcome.stdout)
        self.assertIn("Status       converged", outcome.stdout)

    def test_unresolved_is_flagged_and_succeeds(self):
        groups = {**WAVY, "waviness": {"orientation": "longitudinal", "wavelength_over_a": 0.3}}
        outcome = self.run_case(groups, "--json", "--quiet")
        result = last_line(outcome)
        self.assertEqual((outcome.returncode, result["status"]), (0, "unresolved"))
        self.assertIn("along Y", result["message"])
        self.assertTrue(math.isfinite(result["amplitude_ratio"]))

    def test_stalled_fails(self):
        for groups in [SMOOTH, WAVY]:
            outcome = self.run_case({**groups, "solver": {"largest_steps": 1}}, "--json", "--quiet")
            result = last_line(outcome)
            self.assertEqual((outcome.returncode, result["status"]), (1, "stalled"))
            self.assertIsNone(result["amplitude_ratio"])
            self.assertIsNone(result["amplitude_ratio_fit"])
            self.assertIn("stalled", result["message"])

    def test_march_that_stalls_fails(self):
        groups = {**WAVY, "solver": {"largest_total_steps": 30, "step_tolerance": 1e-12, "tolerance": 1e-4}}
        outcome = self.run_case(groups, "--json", "--quiet")
        result = last_line(outcome)
        self.assertEqual((outcome.returncode, result["status"]), (1, "stalled"), result)
        self.assertIn("time step", result["message"])
        self.assertIsNone(result["amplitude_ratio"])
        self.assertTrue(math.isfinite(result["central_film"]))

    def test_dimensional_input(self):
        groups = {"conditions": {"radius_x_m": 12.52e-3, "radius_y_m": 12.52e-3, "reduced_modulus_pa": 1.17e11,
                                 "load_n": 39.2, "mean_speed_m_per_s": 0.024, "viscosity_pa_s": 1.22},
                  "lubricant": {"pressure_viscosity_per_pa": 2.25e-8, "roelands_index": 0.484},
                  "grid": {"cells_x": 128, "cells_y": 128}}
        outcome = self.run_case(groups, "--json", "--quiet")
        result = last_line(outcome)
        self.check_status(outcome)
        # published: 0.24 um computed
        self.assertAlmostEqual(result["central_film_um"], 0.24, delta=0.02)

    def test_shipped_inputs_are_valid(self):
        top = Path(__file__).parents[2]            # files that inputs name are seen from there
        inputs = sorted((top / "inputs").glob("*.nml"))
        names = [path.name for path in inputs]
        self.assertIn("smooth.nml", names)
        for path in inputs:
            with self.subTest(path=path.name):
                program = "case"
                if "&sweep" in path.read_text():
                    continue
                outcome = run(program, path, "--plan", folder=top)
                self.check_status(outcome)


if __name__ == "__main__":
    unittest.main()
