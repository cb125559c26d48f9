"""Every operating condition of the published figures has a steady solution on 256 x 256 cells."""

import unittest

from ehlwave_program import TestCase, report, solve

LOADS = [50, 100, 200, 500, 1000, 2000]
RADIUS_RATIOS = [1, 0.35, 0.12, 0.04]


class PaperConditions(TestCase):
    def test_converges(self):
        slowest = 0
        for d in RADIUS_RATIOS:
            films = []
            for m in LOADS:
                with self.subTest(m=m, d=d):
                    result = solve(m=m, d=d, grid={"cells_x": 256, "cells_y": 256})
                    self.assertEqual(result["status"], "converged")
                    self.assertLessEqual(result["residual"], 1e-6)
                    self.assertLessEqual(result["load_error"], 1e-6)
                    self.assertGreater(result["minimum_film"], 0)
                    self.assertLessEqual(result["minimum_film"], result["central_film"])
                    slowest = max(slowest, result["nonlinear_steps"])
                    films.append(result["central_film"])
            self.assertEqual(films, sorted(films, reverse=True), f"D = {d}: the film falls with the load")
        report(f"most Newton steps on the finest grid: {slowest}")


if __name__ == "__main__":
    unittest.main()
