"""Response to waviness of 1 % of the film against the linearised equations, for all contacts and orientations."""

import unittest

from compare_linear_response import CHOSEN, RELATIVE, chosen_rows, respond
from ehlwave_program import IS_LONG, TestCase, report
from reference_values import case_name


class LinearResponse(TestCase):
    def test_chosen_rows(self):
        table = chosen_rows()
        self.assertEqual(len(table), sum(map(len, CHOSEN.values())))
        if not IS_LONG:   # test_harmonic compares rows with the linear response, and marches with that
            table = [row for row in table if row["points"] == 65]
        worst = (0, "")
        for row in table:
            with self.subTest(row=case_name(row)):
                ratio = respond(row)["amplitude_ratio_fit"]
                worst = max(worst, (self.check_close(ratio, row["amplitude_ratio"], RELATIVE, "Ad/Ai"), case_name(row)))
        report(f"largest deviation {worst[0]:.1e} at {worst[1]}")


if __name__ == "__main__":
    unittest.main()
