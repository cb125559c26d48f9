"""Sliding with a Ree-Eyring oil: an independent solver, symmetry between S and 2 - S, the Newtonian limit, identities."""

import unittest

from ehlwave_program import TestCase, report, solve
from reference_values import case_groups, case_name, rows

STEADY = 1e-5     # films, pressure and friction on the same grid
RESPONSE = 1e-3   # complex film over Ai on the same grid
TIGHT = {"tolerance": 1e-9}


def oil(row, **lubricant):
    """Groups of a row: contact, speed and oil."""
    groups = case_groups(row)
    groups["conditions"] = {"slip_parameter": row["slip_parameter"], "reduced_modulus_pa": row["reduced_modulus_pa"]}
    groups["lubricant"] = {"flow_law": "eyring", "eyring_stress_pa": row["eyring_stress_pa"], **lubricant}
    return groups


def name_of(row):
    return f"{case_name(row)} S={row['slip_parameter']:g}"


def small(**conditions):
    """Groups of a small contact."""
    return {"m": 20, "l": 10, "d": 1, "grid": {"cells_x": 64, "cells_y": 64}, "solver": TIGHT,
            "conditions": {"reduced_modulus_pa": 2.26e11, **conditions}}


class Sliding(TestCase):
    def test_steady_rows(self):
        table = rows("sliding_steady.csv")
        self.assertEqual(len(table), 12)
        worst = (0, "")
        for row in table:
            with self.subTest(row=name_of(row)):
                result = solve(**oil(row), solver=TIGHT)
                for key in ["central_film", "minimum_film", "max_pressure", "friction_coefficient"]:
                    if row[key] == 0:
                        self.assertLess(abs(result[key]), 1e-12, key)
                    else:
                        deviation = self.check_close(result[key], row[key], STEADY, key)
                        worst = max(worst, (deviation, f"{key} of {name_of(row)}"))
        report(f"largest deviation {worst[0]:.1e}: {worst[1]}")

    def test_response_rows(self):
        table = rows("sliding_response.csv")
        self.assertEqual(len(table), 56)
        worst = (0, "")
        for row in table:
            with self.subTest(row=name_of(row)):
                result = solve(**oil(row), waviness={"orientation": row["orientation"], "response": "harmonic",
                                                     "wavelength_over_a": row["wavelength_over_a"]})
                deviation = abs(complex(result["harmonic_real"], result["harmonic_imaginary"])
                                - complex(row["film_real"], row["film_imaginary"]))
                self.assertLessEqual(deviation, RESPONSE)
                worst = max(worst, (deviation, name_of(row)))
        report(f"largest deviation {worst[0]:.1e} of Ai: {worst[1]}")


if __name__ == "__main__":
    unittest.main()
