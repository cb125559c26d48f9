"""The scheme that is fitted to steep inlets: against the averaged one, its order, and the same linear response as its march."""

import unittest

from ehlwave_program import TestCase, report, solve

HEAVY = {"load_parameter_m": 300, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
SLIDING = {**HEAVY, "slip_parameter": 1.3, "reduced_modulus_pa": 2.26e11}
EYRING = {"flow_law": "eyring", "eyring_stress_pa": 2e6}
LINE = {"load_parameter_m": 100, "lubricant_parameter_l": 11, "radius_ratio_d": 0}
WAVES = {"orientation": "transverse", "wavelength_over_a": 1}
CELLS = (64, 128, 256)
ERRORS = {"central_film": "central_film_error", "harmonic_ratio": "harmonic_error", "friction_coefficient": "friction_error"}


def contact(scheme, cells, conditions=HEAVY, waves=None, oil=None, **solver):
    """A contact on so many cells along each side."""
    grid = {"cells_x": cells} if conditions["radius_ratio_d"] == 0 else {"cells_x": cells, "cells_y": cells}
    groups = {"conditions": conditions, "grid": grid, "solver": {"scheme": scheme, **solver}}
    if oil:
        groups["lubricant"] = oil
    return solve(**groups, waviness=waves) if waves else solve(**groups)


class BothSchemes:
    """Three grids of either scheme, for a contact and its oil."""

    conditions, oil = HEAVY, None
    falling = ()    # responses whose errors are above 0.1 % and fall; the others' change sign
    shares = (("central_film", 0.1), ("harmonic_ratio", 0.2))   # share of the averaged error that may be left

    @classmethod
    def setUpClass(cls):
        waves = {**WAVES, "response": "harmonic"}
        cls.fitted, cls.averaged = ([contact(scheme, cells, cls.conditions, waves, cls.oil) for cells in CELLS]
                                    for scheme in ("fitted", "averaged"))

    def test_same_limit(self):
        """Both schemes agree within their errors; averaged values are extrapolated with their own order."""
        for column, _ in self.shares:
            with self.subTest(column=column):
                coarse, fine = (result[column] for result in self.averaged[1:])
                limit = fine + (fine - coarse) / 3
                error = abs(self.fitted[-1][column] / limit - 1)
                report(f"{column}: fitted, 256 cells, off the extrapolated averaged value by {error:.1e}")
                self.assertLess(error, 0.005)

    def test_errors(self):
        """A fraction of the error of the averaged scheme on the same grid; estimates cover it."""
        for column, share in self.shares:
            best = self.fitted[-1][column]
            for cells, fitted, averaged in zip(CELLS[:2], self.fitted, self.averaged):
                with self.subTest(column=column, cells=cells):
                    error, usual = (abs(result[column] / best - 1) for result in (fitted, averaged))
                    report(f"{column}, {cells} cells: error {error:.1e}, averaged {usual:.1e}")
                    self.assertLess(error, share * usual)
                    estimate = fitted[ERRORS[column]]
                    self.assertLess(error, 1.5 * estimate)

    def test_order(self):
        for column in "central_film", *self.falling:
            with self.subTest(column=column):
                order = self.check_order([result[column] for result in self.fitted], 1.8, column)
                report(f"{column}: order {order:.2f}")

    def test_march_has_its_response(self):
        """Steps of third order along the characteristic and the linear response of the same grid."""
        for steps in 1, 0.5:
            with self.subTest(time_step_over_cell=steps):
                waves = {**WAVES, "amplitude_over_film": 0.01, "response": "both"}
                result = contact("fitted", CELLS[0], self.conditions, waves, self.oil, time_step_over_cell=steps,
                                 error_estimate="model")
                self.check_close(result["amplitude_ratio_fit"], result["harmonic_ratio"], 5e-4, "Ad/Ai")


class SlidingThinning(BothSchemes, TestCase):
    """A Ree-Eyring oil between surfaces that slide."""

    conditions, oil = SLIDING, EYRING
    falling = ("harmonic_ratio",)
    shares = (("central_film", 0.1), ("harmonic_ratio", 0.35), ("friction_coefficient", 0.5))


class Fitted(BothSchemes, TestCase):
    def test_multigrid_has_the_same_solution(self):
        result = contact("fitted", CELLS[1], method="fas", tolerance=1e-6)
        self.check_close(result["central_film"], self.fitted[1]["central_film"], 2e-6, "central film")

    def test_accuracy_at_a_heavy_load(self):
        """The plan takes this scheme, and the requested accuracy is reached: against four times the cells."""
        heavy = {"load_parameter_m": 10000, "lubricant_parameter_l": 12.05, "radius_ratio_d": 0.07}
        waves = {**WAVES, "response": "harmonic"}
        result = solve(conditions=heavy, waviness=waves, solver={"accuracy": 0.01}, grid={"edges": "flooded"})
        cells = {"cells_x": 768, "cells_y": 384}
        fine = solve(conditions=heavy, waviness=waves, solver={"scheme": "fitted"}, grid={"edges": "flooded", **cells})
        self.assertEqual(result["scheme"], "fitted")
        self.assertLess(result["cells_x"], 500)   # the averaged scheme: 768
        for column in "central_film", "harmonic_ratio":
            error = self.check_close(result[column], fine[column], 0.01, column)
            report(f"M = 10,000, D = 0.07, accuracy = 0.01: {column} off by {error:.1e} on {result['cells_x']} x {result['cells_y']} cells")

    def test_line_contact(self):
        fine = contact("averaged", 4096, LINE)["central_film"]
        error, usual = (abs(contact(scheme, 256, LINE)["central_film"] / fine - 1) for scheme in ("fitted", "averaged"))
        report(f"line contact, 256 cells: error {error:.1e}, averaged {usual:.1e}")
        self.assertLess(error, 0.1 * usual)


if __name__ == "__main__":
    unittest.main()
