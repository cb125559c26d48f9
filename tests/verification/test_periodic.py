"""The periodic state against settled marches."""

import unittest

from ehlwave_program import TestCase, report, solve

GRID = {"cells_x": 64, "cells_y": 64}
EYRING = {"flow_law": "eyring", "eyring_stress_pa": 5e6}
SLIDING = {"slip_parameter": 1.5, "reduced_modulus_pa": 226e9}


def waves(response, orientation, wavelength, amplitude=0.2):
    return {"orientation": orientation, "wavelength_over_a": wavelength, "amplitude_over_film": amplitude,
            "response": response}


class Periodic(TestCase):
    def test_marches(self):
        """Ad/Ai within 1e-3, the rise of the mean within 2 %, for at most 60 % of the work; work counted as in marches."""
        for name, waviness, grid, conditions, lubricant in [
                ("transverse, 0.5 a", ("transverse", 0.5), {}, {}, {}),
                ("transverse, a, flooded", ("transverse", 1), {"edges": "flooded"}, {}, {}),
                ("isotropic, a, Ai = 10 %", ("isotropic", 1, 0.1), {}, {}, {}),
                ("transverse, a, Ai = 5 %, Ree-Eyring, S = 1.5", ("transverse", 1, 0.05), {}, SLIDING, EYRING)]:
            with self.subTest(case=name):
                smooth, march, state = [solve(m=100, d=1, grid=GRID | grid, conditions=conditions, lubricant=lubricant, **kind) for kind in (
                    {"solver": {"error_estimate": "model"}},
                    *({"waviness": waves(response, *waviness), "solver": {"settling_periods": 3, "error_estimate": "model"}}
                      for response in ("transient", "periodic")))]
                self.assertEqual((march["march_from"], state["march_from"]), ("rest", "waves"))
                self.assertLess(state["time_steps"], march["time_steps"])
                self.assertLess(state["counted_work_units"], 0.6*march["counted_work_units"])
                step = [(one["counted_work_units"] - smooth["counted_work_units"])/(one["linear_steps"] - smooth["linear_steps"])
                        for one in (march, state)]
                self.assertTrue(0.9 < step[1]/step[0] < 1.3, f"{name}: work of a linear step {step[1]:.2f}, march {step[0]:.2f}")
                ratio = "amplitude_ratio_fit"
                self.assertLess(abs(state["phase_fit"] - march["phase_fit"]), 0.007, name)
                self.assertLess(abs(state[ratio] - march[ratio]), 1e-3, name)
                film = march["central_film"]
                self.check_close(state["mean_film"] - film, march["mean_film"] - film, 0.02, name)
                report(f"{name}: Ad/Ai {state[ratio]:.5f}, march {march[ratio]:.5f}, counted work units "
                       f"{state['counted_work_units']:.0f}, march {march['counted_work_units']:.0f}")

    def test_steep_waves(self):
        """Waves of 40 % of the film; a fit of a single harmonic depends on its samples."""
        march, state = [solve(m=100, d=1, grid=GRID, waviness=waves(response, "transverse", 0.5, 0.4),
                              solver={"settling_periods": 3, "error_estimate": "model"})
                        for response in ("transient", "periodic")]
        self.assertEqual(state["march_from"], "waves")
        self.assertLess(abs(state["amplitude_ratio_fit"] - march["amplitude_ratio_fit"]), 3e-3)


if __name__ == "__main__":
    unittest.main()
