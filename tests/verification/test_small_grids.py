"""Checks of the solver, on grids that a debug build can run: run-time checks and sanitizers see every path.

The independent solver's values on 65 x 65 points (see reference/README.md), and routes that must agree with each other.
"""

import unittest

from compare_linear_response import respond_linearly
from ehlwave_program import TestCase, report, solve
from reference_values import case_groups, case_name, rows

POINTS = 65
WAVE = {"orientation": "transverse", "wavelength_over_a": 1}
COARSE = {"cells_x": 32, "cells_y": 32}


def small_rows(name, **wanted):
    return [row for row in rows(name)
            if row["points"] == POINTS and all(row[key] == value for key, value in wanted.items())]


class SmallGrids(TestCase):
    def test_steady_rows(self):
        table = small_rows("steady.csv")
        self.assertEqual(len(table), 4)
        for row in table:
            with self.subTest(row=case_name(row)):
                result = solve(**case_groups(row))
                for column in ("central_film", "minimum_film", "max_pressure"):
                    self.check_close(result[column], row[column], 1e-5, column)

    def test_linear_response(self):
        table = small_rows("linear_response.csv", wavelength_over_a=2)
        self.assertGreaterEqual(len(table), 8)
        worst = 0
        for row in table:
            with self.subTest(row=case_name(row)):
                ratio = respond_linearly(row)["harmonic_ratio"]
                worst = max(worst, self.check_close(ratio, row["amplitude_ratio"], 1e-3, "Ad/Ai"))
        report(f"linear response: largest deviation {worst:.1e}")

    def test_transient(self):
        row = small_rows("transient.csv", amplitude_over_film=0.2, orientation="isotropic")[0]
        result = solve(**case_groups(row), solver={"settling_periods": 0},
                       waviness={"orientation": "isotropic", "wavelength_over_a": row["wavelength_over_a"]})
        self.check_close(result["amplitude_ratio_fit"], row["amplitude_ratio_fit"], 3e-3, "Ad/Ai")

    def test_methods_agree(self):
        """On the whole domain, with slip, and with the deformation by multilevel integration."""
        settings = {"m": 50, "d": 0.35, "waviness": WAVE, "dynamics": {"end_time": 0.5}}
        first = solve(**settings, grid=COARSE, conditions={"slip_parameter": 1.2})
        for method in ("newton", "fas"):
            other = solve(**settings, grid={**COARSE, "domain": "whole"}, conditions={"slip_parameter": 1.2},
                          solver={"method": method, "deformation": "mlmi", "tolerance": 1e-8})
            self.check_close(other["central_film"], first["central_film"], 1e-4, f"H(0,0), {method}")

    def test_line_contact(self):
        result = solve(m=50, l=8, d=0, grid={"cells_x": 256},
                       waviness={**WAVE, "response": "both", "amplitude_over_film": 0.01},
                       solver={"settling_periods": 2, "step_tolerance": 1e-5})
        self.check_close(result["harmonic_ratio"], result["amplitude_ratio_fit"], 2e-3, "Ad/Ai")


if __name__ == "__main__":
    unittest.main()
