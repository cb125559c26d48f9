"""Observed order of Ad/Ai in mesh size, and its error by long time steps, in the linear range.

A wave of 1 % of the film and lambda = 2 a: the error has to be in its asymptotic range on grids a test can afford.
The pattern settles for three periods, so that the effect of the start is far below the differences compared.
"""

import unittest

from ehlwave_program import IS_LONG, TestCase, report, solve

SMALLEST = 1.8


def amplitude_ratio(m, cells_x, cells_y, cells_per_step=1):
    """Ad/Ai by harmonic fit, algebraic errors far below the discretisation error."""
    result = solve(m=m, d=1, grid={"cells_x": cells_x, "cells_y": cells_y},
                   waviness={"orientation": "transverse", "wavelength_over_a": 2, "amplitude_over_film": 0.01},
                   solver={"tolerance": 1e-9, "step_tolerance": 1e-6, "settling_periods": 3,
                           "time_step_over_cell": cells_per_step})
    return result["amplitude_ratio_fit"]


class Orders(TestCase):
    def test_grid(self):
        ratios = [amplitude_ratio(20, cells, cells) for cells in [32, 64, 128]]
        report(f"grid, M = 20, 32 to 128 cells, dT = hX: order {self.check_order(ratios, SMALLEST, 'Ad/Ai'):.2f} of {ratios}")

    def test_time_step(self):
        # Theory eq. (D14): long steps keep the steady film, and Ad/Ai differs from that of dT = hX by less than (E8) expects.
        for m, cells_x, cells_y, formula_ratio in [(20, 96, 96, 0.673), (100, 192, 48, 0.423)][:2 if IS_LONG else 1]:
            with self.subTest(m=m):
                fine, *longer = (amplitude_ratio(m, cells_x, cells_y, cells_per_step) for cells_per_step in [1, 2, 4])
                errors = [abs(ratio/fine - 1) for ratio in longer]
                expected = [0.0108*(step**2 - 1)*(4/cells_x)**2*m*(1 - formula_ratio)**0.5 for step in (2, 4)]
                report(f"time step, M = {m}, {cells_x} x {cells_y} cells, dT = 2, 4 hX: errors {errors}, expected {expected}")
                self.assertLess(errors[0], expected[0])
                self.assertLess(errors[1], expected[1])
                self.assertLess(errors[0], errors[1])

    def test_shorter_steps_follow_the_same_characteristics(self):
        # With dT = hX/m the difference along the characteristic still spans hX and the Poiseuille terms have no
        # derivative in time: the solution at the times of dT = hX is the same, and samples come more densely.
        whole, half = (amplitude_ratio(20, 64, 64, ratio) for ratio in [1, 0.5])
        report(f"dT = hX/2 against hX: {self.check_close(half, whole, 1e-4, 'Ad/Ai'):.1e}")


if __name__ == "__main__":
    unittest.main()
