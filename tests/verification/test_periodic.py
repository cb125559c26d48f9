"""The periodic state against settled marches, and the march in its place where it is not found."""

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
        """Ad/Ai within 1.5e-3, most of which is the march's fit: its samples are those of a period and one more."""
        for name, waviness, grid, conditions, lubricant in [
                ("transverse, 0.5 a", ("transverse", 0.5), {}, {}, {}),
                ("transverse, a, flooded", ("transverse", 1), {"edges": "flooded"}, {}, {}),
                ("isotropic, a, Ai = 10 %", ("isotropic", 1, 0.1), {}, {}, {}),
                ("transverse, a, Ree-Eyring, S = 1.5", ("transverse", 1), {}, SLIDING, EYRING)]:
            with self.subTest(case=name):
                march, state = [solve(m=100, d=1, grid=GRID | grid, waviness=waves(response, *waviness), conditions=conditions,
                                      lubricant=lubricant, solver={"settling_periods": 3, "error_estimate": "model"})
                                for response in ("transient", "periodic")]
                self.assertEqual(state["time_steps"], 0)
                self.assertLess(state["counted_work_units"], march["counted_work_units"])
                ratio = "amplitude_ratio_fit"
                self.assertLess(abs(state["phase_fit"] - march["phase_fit"]), 0.007, name)
                self.assertLess(abs(state[ratio] - march[ratio]), 3e-3 if conditions else 1.5e-3, name)
                film = march["central_film"]
                self.check_close(state["mean_film"] - film, march["mean_film"] - film, 0.02, name)
                report(f"{name}: Ad/Ai {state[ratio]:.5f}, march {march[ratio]:.5f}, counted work units "
                       f"{state['counted_work_units']:.0f}, march {march['counted_work_units']:.0f}")

    def test_march_takes_over(self):
        """Waves of 70 % of the film."""
        march, state = [solve(m=100, d=1, grid=GRID, waviness=waves(response, "transverse", 0.5, 0.7),
                              solver={"settling_periods": 0, "error_estimate": "model"})
                        for response in ("transient", "periodic")]
        self.assertEqual(state["amplitude_ratio_fit"], march["amplitude_ratio_fit"])
        self.assertIn("marched in its place", state["warning"])
        self.assertGreater(state["time_steps"], 0)


if __name__ == "__main__":
    unittest.main()
