"""Sliding with a Ree-Eyring oil: an independent solver, symmetry between S and 2 - S, the Newtonian limit, identities."""

import math
import unittest

from ehlwave_program import IS_LONG, TestCase, report, solve
from reference_values import case_groups, case_name, rows

STEADY = 1e-5     # films, pressure and friction on the same grid
RESPONSE = 1e-3   # complex film over Ai on the same grid
LIMIT = 1e-9      # against a Newtonian oil
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
        for row in table if IS_LONG else table[::3]:
            with self.subTest(row=name_of(row)):
                result = solve(**oil(row), waviness={"orientation": row["orientation"], "response": "harmonic",
                                                     "wavelength_over_a": row["wavelength_over_a"]})
                deviation = abs(complex(result["harmonic_real"], result["harmonic_imaginary"])
                                - complex(row["film_real"], row["film_imaginary"]))
                self.assertLessEqual(deviation, RESPONSE)
                worst = max(worst, (deviation, name_of(row)))
        report(f"largest deviation {worst[0]:.1e} of Ai: {worst[1]}")

    def test_either_surface_the_faster_one(self):
        """S and 2 - S: the same film, friction the other way round."""
        eyring = {"flow_law": "eyring", "eyring_stress_pa": 5e6}
        carreau = {"flow_law": "carreau", "carreau_modulus_pa": 7e6, "carreau_exponent": 0.35}
        for lubricant in (eyring, carreau):
            fast, slow = (solve(**small(slip_parameter=s), lubricant=lubricant) for s in (1.3, 0.7))
            for key in ["central_film", "minimum_film", "max_pressure", "largest_b", "tangent_factor_x", "tangent_factor_y"]:
                self.check_close(fast[key], slow[key], 1e-9, key)
            self.check_close(fast["friction_coefficient"], -slow["friction_coefficient"], 1e-9, "friction")
            self.assertGreater(fast["friction_coefficient"], 0)

    def test_newtonian_limit(self):
        """A stress of 1e15 Pa, and Carreau's n = 1, flow like a Newtonian oil: film, friction, response."""
        waves = {"waviness": {"orientation": "isotropic", "wavelength_over_a": 1, "response": "harmonic"}}
        newtonian = solve(**small(slip_parameter=1.5), **waves)
        self.assertIsNone(newtonian["largest_b"])
        for lubricant in ({"flow_law": "eyring", "eyring_stress_pa": 1e15},
                          {"flow_law": "carreau", "carreau_modulus_pa": 7e6, "carreau_exponent": 1}):
            result = solve(**small(slip_parameter=1.5), lubricant=lubricant, **waves)
            for key in ["central_film", "minimum_film", "max_pressure", "friction_coefficient", "tangent_factor_x",
                        "tangent_factor_y", "harmonic_real", "harmonic_imaginary"]:
                self.check_close(result[key], newtonian[key], LIMIT, f"{key} of {lubricant}")

    def test_stiff_oils(self):
        """Gradients that a Newtonian film would bear drive this oil by factors of 1e9 and more, in rolling too; flow along sliding
        that is 26 times as easy as across, under pressures relaxed line by line."""
        def contact(cells, slip, stress, **solver):
            return solve(m=100, l=30, d=1, grid={"cells_x": cells, "cells_y": cells}, solver=solver,
                         conditions={"reduced_modulus_pa": 2.26e11, "slip_parameter": slip},
                         lubricant={"flow_law": "eyring", "eyring_stress_pa": stress})
        rolling = contact(32, 1, 0.6e6)
        self.assertEqual(rolling["rung"], "continuation")
        direct = [contact(32, 1, stress)["central_film"] for stress in (0.65e6, 0.7e6)]
        self.check_close(rolling["central_film"], 2*direct[0] - direct[1], 0.01, "film of 0.6 from those of 0.65 and 0.7 MPa")
        newton, fas = (contact(64, 1.5, 50e6, tolerance=1e-8, method=method) for method in ("newton", "fas"))
        self.assertEqual(fas["rung"], "direct")
        for key in ["central_film", "minimum_film", "max_pressure", "friction_coefficient"]:
            self.check_close(fas[key], newton[key], 1e-7, key)
        report(f"rolling, 0.7 MPa: {rolling['nonlinear_steps']} Newton steps; FAS, S = 1.5, 50 MPa: {fas['nonlinear_steps']} cycles")

    def test_film_that_spreads(self):
        """Nodes beside a flooded edge join the film in the last steps: their new equation is no step that went wrong."""
        found = solve(m=73.16, l=4.43, d=0.0475, grid={"cells_x": 192, "cells_y": 128, "edges": "flooded"},
                      conditions={"reduced_modulus_pa": 2.26e11, "slip_parameter": 0.18},
                      lubricant={"flow_law": "eyring", "eyring_stress_pa": 5e6})
        self.assertEqual(found["rung"], "direct")
        self.assertLess(found["nonlinear_steps"], 10)

    def test_line_loads(self):
        """A line contact given by its load per length equals the contact given by its M and L."""
        lubricant = {"flow_law": "eyring", "eyring_stress_pa": 5e6}
        groups = {"grid": {"cells_x": 256}, "solver": TIGHT, "lubricant": lubricant}
        given = solve(conditions={"radius_x_m": 0.01, "reduced_modulus_pa": 2.26e11, "load_n_per_m": 3e5, "slip_parameter": 1.2,
                                  "mean_speed_m_per_s": 1, "viscosity_pa_s": 0.05}, **groups)
        u2 = 0.05*2*1/(2.26e11*0.01)
        self.check_close(given["load_parameter_m"], 3e5/(2.26e11*0.01)*u2**-0.5, 1e-12, "M")
        self.check_close(given["lubricant_parameter_l"], 2.2e-8*2.26e11*u2**0.25, 1e-12, "L")
        a = (8*3e5*0.01/(math.pi*2.26e11))**0.5
        self.check_close(given["semi_axis_a_m"], a, 1e-12, "a")
        self.check_close(given["hertz_pressure_pa"], 2*3e5/(math.pi*a), 1e-12, "ph")
        same = solve(m=given["load_parameter_m"], l=given["lubricant_parameter_l"], d=0, **groups,
                     conditions={"reduced_modulus_pa": 2.26e11, "slip_parameter": 1.2})
        for key in ["central_film", "friction_coefficient"]:
            self.check_close(same[key], given[key], 1e-9, key)
        self.check_close(given["central_film_um"], given["central_film"]*a**2/0.02*1e6, 1e-12, "h(0,0)")
        self.assertNotIn("inlet_temperature_rise_k", same)
        self.assertGreater(given["contact_temperature_rise_k"], given["inlet_temperature_rise_k"])
        self.assertIn("the oil in the contact would warm", given["warning"])


if __name__ == "__main__":
    unittest.main()
