"""The key `response`: fields, refusals, and sweeps that share steady states."""

import math
import re
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import TestCase, last_line, namelist, run, solve

CONTACT = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
GRID = {"cells_x": 32, "cells_y": 32}
WAVES = {"orientation": "transverse", "wavelength_over_a": 2, "response": "harmonic"}


class Response(TestCase):
    def refuse(self, expected, **groups):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "case.nml")
            path.write_text(namelist({"conditions": CONTACT, "grid": GRID, **groups}))
            outcome = run("case", path)
        self.check_status(outcome, 2)
        self.assertIn(expected, outcome.stderr)

    def test_choices(self):
        small = {"m": 100, "d": 1, "grid": GRID}
        harmonic = solve(**small, waviness=WAVES)
        both = solve(**small, waviness={**WAVES, "response": "both", "amplitude_over_film": 0.01})
        transient = solve(**small, waviness={**WAVES, "response": "transient", "amplitude_over_film": 0.01})
        self.assertEqual(harmonic["harmonic_ratio"], both["harmonic_ratio"])
        self.assertEqual(both["amplitude_ratio_fit"], transient["amplitude_ratio_fit"])
        self.assertIsNone(harmonic["amplitude_ratio"])
        self.assertIsNone(harmonic["mean_film"])
        # the response has an error estimate of its own, and the transient beside it no smaller error
        self.assertIsNone(harmonic["amplitude_ratio_error"])
        self.assertEqual(harmonic["amplitude_error_basis"], "")
        self.assertAlmostEqual(both["amplitude_ratio_error"],
                               max(transient["amplitude_ratio_error"], both["harmonic_error"] + both["ratio_error_algebraic"]), delta=1e-12)
        self.assertEqual(harmonic["central_film_error"], transient["central_film_error"])
        self.assertIsNone(transient["harmonic_ratio"])
        self.assertAlmostEqual(math.hypot(harmonic["harmonic_real"], harmonic["harmonic_imaginary"]),
                               harmonic["harmonic_ratio"], delta=1e-12)
        self.assertAlmostEqual(math.atan2(harmonic["harmonic_imaginary"], harmonic["harmonic_real"]),
                               harmonic["harmonic_phase"], delta=1e-12)

    def test_the_mean_can_be_left_out(self):
        for orientation in ("transverse", "longitudinal"):
            waves = {**WAVES, "orientation": orientation}
            whole = solve(m=100, d=1, grid=GRID, waviness=waves)
            less = solve(m=100, d=1, grid=GRID, waviness=waves, output={"mean_rise": False})
            for name in ("harmonic_real", "harmonic_imaginary", "harmonic_error", "harmonic_counted_work_units"):
                self.assertEqual(less[name], whole[name], name)
            self.assertTrue(whole["mean_film_rise"] > 0 and whole["smallest_film"] > 0)
            self.assertIsNone(less["mean_film_rise"])
            self.assertIsNone(less["smallest_film"])
            self.assertIsNone(less["surfaces_touch"])
            self.assertLess(less["counted_work_units"], whole["counted_work_units"] - 5)
            self.assertLess(less["expected_work_units"], whole["expected_work_units"])

    def test_the_report_has_the_sensitivities_of_the_result(self):
        groups = {"conditions": {**CONTACT, "reduced_modulus_pa": 2.26e11, "slip_parameter": 1.2}, "grid": GRID, "waviness": WAVES,
                  "lubricant": {"flow_law": "eyring", "eyring_stress_pa": 5e6}}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "case.nml")
            path.write_text(namelist({**groups, "output": {"sensitivities": True}}))
            outcome = run("case", path, "--json")
            path.write_text(namelist(groups))
            self.assertNotIn("Sensitivity", run("case", path).stdout)
        result = last_line(outcome)
        for name in ("alpha", "stress"):
            printed = re.search(rf"Sensitivity  H\(0,0\) goes with the power (\S+) of {name}, Ad/Ai with (\S+)", outcome.stdout)
            for number, quantity in zip(printed.groups(), ("film", "response"), strict=True):
                self.assertAlmostEqual(float(number)/result[f"{quantity}_sensitivity_{name}"], 1, delta=1e-3)

    def test_plan(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "case.nml")
            path.write_text(namelist({"conditions": CONTACT, "grid": GRID, "waviness": WAVES}))
            plan = last_line(run("case", path, "--plan", "--json"))
        self.assertEqual(plan["run"], "harmonic")
        self.assertEqual(plan["time_steps"], 0)

    def test_plan_for_an_accuracy(self):
        """The response needs a small part of the work of the transient. Steps beside a response have its frequency: one cell."""
        plans = {}
        for response in ("harmonic", "both", "transient"):
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder, "case.nml")
                path.write_text(namelist({"conditions": CONTACT, "waviness": {**WAVES, "response": response},
                                          "solver": {"accuracy": 0.02}}))
                plans[response] = last_line(run("case", path, "--plan", "--json"))
        for plan in plans.values():
            self.assertLessEqual(plan["expected_error"], 0.02)
        harmonic, both, transient = plans["harmonic"], plans["both"], plans["transient"]
        self.assertGreater(harmonic["expected_error"], 0.005)   # waves in time: finer, for the error that they can declare
        for plan, longest in ((both, 1), (transient, 2)):
            cells = plan["time_step"]*plan["cells_x"]/(plan["domain_x_max"] - plan["domain_x_min"])
            self.assertIn(round(cells, 9), range(1, longest + 1))
        # a work unit goes with the cells of a plan's own grid
        work = [plan["expected_work_units"]*plan["cells_x"]*plan["cells_y"] for plan in (harmonic, both)]
        self.assertLess(work[0], 0.1*work[1])

    def test_waves_that_touch(self):
        """No negative film is a result: to second order these waves would go 0.005 into the other surface."""
        waviness = {"orientation": "isotropic", "wavelength_over_a": 1.9, "response": "harmonic"}
        films = {}
        for amplitude in (0.5, 1):
            films[amplitude] = solve(conditions={"load_parameter_m": 184, "lubricant_parameter_l": 15, "radius_ratio_d": 0.63},
                                     grid={"cells_x": 96, "cells_y": 96, "edges": "flooded"},
                                     waviness={**waviness, "amplitude_over_film": amplitude})
        self.assertGreater(films[0.5]["smallest_film"], 0)
        self.assertFalse(films[0.5]["surfaces_touch"])
        self.assertIsNone(films[1]["smallest_film"])
        self.assertTrue(films[1]["surfaces_touch"])
        self.assertIn("would touch the other surface at X", films[1]["warning"])
        self.assertIn("would touch", films[1]["validity"])

    def test_work_at_a_steep_spike(self):
        """Waves move the spike of Barus' oil, which no coarser grid has: 18 steps and 54 work units before."""
        book = solve(conditions={"load_parameter_m": 20, "lubricant_parameter_l": 10, "radius_ratio_d": 1},
                     lubricant={"viscosity_law": "barus", "density_law": "incompressible"},
                     grid={"x_min": -4.5, "x_max": 1.5, "y_max": 3, "cells_x": 512, "cells_y": 512},
                     waviness={**WAVES, "wavelength_over_a": 0.5}, solver={"error_estimate": "model"})
        self.assertLessEqual(book["harmonic_linear_steps"], 15)
        self.assertLessEqual(book["harmonic_counted_work_units"], 47)

    def test_refusals(self):
        self.refuse("response", waviness={**WAVES, "response": "linear"})
        self.refuse("load_factor", waviness=WAVES, dynamics={"load_factor": 1.1})
        self.refuse("time_step_over_cell", waviness=WAVES, solver={"time_step_over_cell": 2})
        self.refuse("end_time", waviness=WAVES, dynamics={"end_time": 2.0})

    def test_slip_enters_the_frequency_only(self):
        """A stationary pattern has no phase in time but a phase in space: w = 0, kx > 0."""
        standing = solve(conditions={**CONTACT, "slip_parameter": 0}, grid=GRID, waviness=WAVES)
        slow = solve(conditions={**CONTACT, "slip_parameter": 1e-6}, grid=GRID, waviness=WAVES)
        self.check_close(slow["harmonic_ratio"], standing["harmonic_ratio"], 1e-4, "Ad/Ai")

    def test_oblique(self):
        """sin(ky Y) vanishes at the centre: there an oblique wave equals the product of cosines."""
        custom = {"orientation": "custom", "wavelength_x_over_a": 2, "wavelength_y_over_a": 1.6, "response": "harmonic"}
        product = solve(conditions=CONTACT, grid=GRID, waviness=custom)
        oblique = solve(conditions=CONTACT, grid=GRID, waviness={**custom, "oblique": True})
        self.check_close(oblique["harmonic_ratio"], product["harmonic_ratio"], 5e-4, "Ad/Ai")
        self.assertAlmostEqual(oblique["harmonic_phase"], product["harmonic_phase"], delta=5e-4)


if __name__ == "__main__":
    unittest.main()
