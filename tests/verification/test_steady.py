"""Smooth contacts against an independent solver with the same discretisation."""

import unittest

from ehlwave_program import TestCase, report, solve
from reference_values import case_groups, case_name, rows

# The acceptance criterion is 5e-3; the same discretisation leaves the tolerances of the two solvers.
RELATIVE = 1e-5
COLUMNS = ["central_film", "minimum_film", "max_pressure", "central_film_moes", "kappa", "gamma", "alphabar", "lambdabar"]


class Steady(TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pairs = [(row, solve(**case_groups(row))) for row in rows("steady.csv")]

    def test_all_rows(self):
        self.assertEqual(len(self.pairs), 12)
        for column in COLUMNS:
            worst = 0
            for row, result in self.pairs:
                with self.subTest(row=case_name(row), column=column):
                    worst = max(worst, self.check_close(result[column], row[column], RELATIVE, column))
            report(f"{column}: largest deviation {worst:.1e}")

    def test_order_of_central_film(self):
        for first in range(0, 12, 3):
            row, _ = self.pairs[first]
            with self.subTest(row=case_name(row)):
                films = [result["central_film"] for _, result in self.pairs[first:first + 3]]
                report(f"D = {row['radius_ratio_d']:g}: order {self.check_order(films, 1.8, 'central film'):.3f}")

    def test_equations_hold(self):
        for row, result in self.pairs:
            with self.subTest(row=case_name(row)):
                self.assertLessEqual(result["residual"], 1e-6)
                self.assertLessEqual(result["load_error"], 1e-6)


if __name__ == "__main__":
    unittest.main()
