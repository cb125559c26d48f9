"""The mean film of waves to second order against settled marches, and that it is quadratic in the amplitude."""

import unittest

from ehlwave_program import TestCase, report, solve

GRID = {"cells_x": 64, "cells_y": 64}
EYRING = {"flow_law": "eyring", "eyring_stress_pa": 5e6}
SLIDING = {"slip_parameter": 1.5, "reduced_modulus_pa": 226e9}


def waves(orientation, wavelength, amplitude=0.2, response="both"):
    return {"orientation": orientation, "wavelength_over_a": wavelength, "amplitude_over_film": amplitude,
            "response": response}


class MeanFilm(TestCase):
    def test_marches(self):
        """Measured: 1.0, 0.5, 1.4, 0.2 and 0.2 %."""
        for name, waviness, conditions, lubricant in [
                ("transverse, 0.5 a", waves("transverse", 0.5), {}, {}),
                ("transverse, 2 a", waves("transverse", 2), {}, {}),
                ("longitudinal, a", waves("longitudinal", 1), {}, {}),
                ("transverse, 0.75 a, Ree-Eyring, S = 1.5", waves("transverse", 0.75), SLIDING, EYRING),
                ("transverse, a, Ree-Eyring, S = 1.5", waves("transverse", 1), SLIDING, EYRING)]:   # not a whole number of steps
            with self.subTest(case=name):
                result = solve(m=100, d=1, grid=GRID, waviness=waviness, conditions=conditions, lubricant=lubricant,
                               solver={"settling_periods": 4})
                rise = (result["mean_film"] - result["central_film"])/(0.2*result["central_film"])
                deviation = self.check_close(result["mean_film_rise"], rise, 0.03, name)
                report(f"{name}: rise {result['mean_film_rise']:.5f} of Ai, {100*deviation:.1f} % from the march")

    def test_quadratic(self):
        rises = [solve(m=100, d=0.35, grid=GRID, waviness=waves("isotropic", 1, amplitude, "harmonic"))["mean_film_rise"]
                 for amplitude in (0.1, 0.2)]
        self.check_close(rises[1], 2*rises[0], 1e-6, "rise over Ai at twice the amplitude")

    def test_patterns_that_stand_still(self):
        """The mean over their places, against the steady states of eight: 0.4 and 0.2 %. And whether they touch."""
        standing = {"m": 100, "d": 1, "grid": GRID, "conditions": {"slip_parameter": 0}}
        for orientation in ("transverse", "isotropic"):
            places = solve(**standing, waviness=waves(orientation, 1, 0.02, "transient"), solver={"error_estimate": "model", "tolerance": 1e-8})
            rise = (places["mean_film"] - places["central_film"])/(0.02*places["central_film"])
            small = solve(**standing, waviness=waves(orientation, 1, 0.02, "harmonic"))
            report(f"{orientation}: {self.check_close(small['mean_film_rise'], rise, 0.01, orientation):.2%} off")
            self.assertIs(small["surfaces_touch"], False)
        large = solve(**standing, waviness=waves("transverse", 1, 1, "harmonic"))
        self.assertEqual((large["surfaces_touch"], large["smallest_film"]), (True, None))
        self.assertIn("would touch the other surface", large["warning"])

    def test_waves_along_a_line_whose_mean_is_not_known(self):
        result = solve(m=50, d=0, grid={"cells_x": 64}, waviness=waves("isotropic", 1, 1, "harmonic"))
        self.assertGreater(result["harmonic_ratio"], 0)
        self.assertEqual((result["surfaces_touch"], result["smallest_film"]), (None, None))


if __name__ == "__main__":
    unittest.main()
