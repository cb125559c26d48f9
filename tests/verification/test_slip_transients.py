"""Marches of small waves under slip against the linear response, and orders in mesh size and time step, Ree-Eyring.

Small grids; the manual has marches on finer ones.
"""

import cmath
import math
import unittest

from ehlwave_program import IS_LONG, TestCase, report, solve

OBLIQUE = {"orientation": "custom", "wavelength_x_over_a": 1, "wavelength_y_over_a": 1.5, "oblique": True}
EYRING = {"flow_law": "eyring", "eyring_stress_pa": 5e6}
AGREEMENT = 0.003     # share of Ai, complex
SMALLEST_ORDER = 1.8


def sliding(slip):
    return {"slip_parameter": slip, "reduced_modulus_pa": 2.26e11}


def march(result):
    return cmath.rect(result["amplitude_ratio_fit"], result["phase_fit"])


def response(result):
    return complex(result["harmonic_real"], result["harmonic_imaginary"])


class SlipTransients(TestCase):
    def test_linear_response(self):
        for name, slip, waves, lubricant in [
                ("transverse, Ree-Eyring", 1.5, {"orientation": "transverse", "wavelength_over_a": 1}, EYRING),
                ("oblique, Newtonian", 1.5, OBLIQUE, {}),
                ("isotropic, Ree-Eyring", 1.1, {"orientation": "isotropic", "wavelength_over_a": 1}, EYRING)]:
            with self.subTest(case=name):
                result = solve(m=100, d=1, grid={"cells_x": 64, "cells_y": 64}, conditions=sliding(slip), lubricant=lubricant,
                               waviness={**waves, "amplitude_over_film": 0.01, "response": "both"},
                               solver={"settling_periods": 5, "error_estimate": "model"})
                deviation = abs(march(result) - response(result))
                self.assertLessEqual(deviation, AGREEMENT)
                report(f"{name}, S = {slip}: {100*deviation:.4f} % of Ai")

    def test_order_of_film_and_response(self):
        for slip in (0.5, 1.5):
            results = [solve(m=20, d=1, grid={"cells_x": cells, "cells_y": cells}, conditions=sliding(slip), lubricant=EYRING,
                             waviness={"orientation": "transverse", "wavelength_over_a": 2, "response": "harmonic"},
                             solver={"tolerance": 1e-9}) for cells in (32, 64, 128)]
            film = self.check_order([result["central_film"] for result in results], SMALLEST_ORDER, "film")
            wave = self.check_order([response(result) for result in results], SMALLEST_ORDER, "response")
            report(f"S = {slip}: order {film:.2f} of the film, {wave:.2f} of the complex response")

    def test_order_in_time(self):
        """dT = 8, 4, 2 hX along the characteristic at fixed mesh size, against the linear response for dT = hX: complex, because
        the error can be a phase error (S = 1.2: the amplitude alone would change by 5e-3, then 3e-4, of Ai)."""
        for slip in (0.5, 1.2) if IS_LONG else (1.2,):
            groups = {"m": 20, "d": 1, "grid": {"cells_x": 128, "cells_y": 32}, "conditions": sliding(slip), "lubricant": EYRING}
            waves = {"orientation": "transverse", "wavelength_over_a": 3, "amplitude_over_film": 0.01}
            limit = response(solve(**groups, waviness={**waves, "response": "harmonic"}, solver={"tolerance": 1e-9}))
            errors = [abs(march(solve(**groups, waviness=waves, solver={
                "tolerance": 1e-9, "step_tolerance": 1e-6, "settling_periods": 3, "time_step_over_cell": cells,
                "error_estimate": "model"})) - limit) for cells in (8, 4, 2)]
            orders = [math.log2(coarse/fine) for coarse, fine in zip(errors, errors[1:])]
            report(f"time step, S = {slip}: errors {', '.join(f'{error:.1e}' for error in errors)} of Ai, "
                   f"orders {orders[0]:.2f}, {orders[1]:.2f}")
            self.assertGreaterEqual(min(orders), SMALLEST_ORDER, f"S = {slip}: errors {errors}")


if __name__ == "__main__":
    unittest.main()
