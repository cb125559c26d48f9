"""Moving patterns of finite amplitude, as a user runs them, against an independent solver.

Rows with Ai = 1 % of the film are left to test_reference_march: the reference starts with a first-order step, which
moves its Ad/Ai by up to 0.6 % there (README of the reference folder). The reference measures in the first period
after T = 3.5, so settling_periods is 0 here; in the second period Ad/Ai of its rows differs by up to 0.6 %.
"""

import unittest

from ehlwave_program import TestCase, report, solve
from reference_values import case_groups, case_name, rows

RELATIVE = 3e-3


class Transient(TestCase):
    def test_all_rows(self):
        table = [row for row in rows("transient.csv") if row["amplitude_over_film"] > 0.1]
        self.assertEqual(len(table), 8)
        worst = {"amplitude_ratio": 0, "amplitude_ratio_fit": 0}
        for row in table:
            result = solve(**case_groups(row), solver={"settling_periods": 0},
                           waviness={"orientation": row["orientation"], "wavelength_over_a": row["wavelength_over_a"],
                                     "amplitude_over_film": row["amplitude_over_film"]})
            for column in worst:
                with self.subTest(row=case_name(row), column=column):
                    worst[column] = max(worst[column], self.check_close(result[column], row[column], RELATIVE, column))
            with self.subTest(row=case_name(row), column="f_v"):
                self.check_close(result["f_r"]*result["v"], row["f_v"], 1e-6, "f(r) V")
        for column, deviation in worst.items():
            report(f"{column}: largest deviation {deviation:.1e}")


if __name__ == "__main__":
    unittest.main()
