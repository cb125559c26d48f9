"""Full contacts with every law of viscosity and flow: all methods agree, films follow their coefficients."""

import unittest

from ehlwave_program import TestCase, report, run, solve

CONTACT = {"reduced_modulus_pa": 2.26e11, "mean_speed_m_per_s": 0.5, "viscosity_pa_s": 0.05, "radius_x_m": 0.0125}
ELLIPTICAL = {**CONTACT, "radius_y_m": 0.02, "load_n": 20}
LINE = {**CONTACT, "load_n_per_m": 1.5e5}
SHAPES = {"elliptical": (ELLIPTICAL, {"cells_x": 64, "cells_y": 64}), "line": (LINE, {"cells_x": 512})}
TAIT = {"density_law": "tait", "tait_modulus_pa": 1.7e9, "tait_modulus_rate": 11}
LAWS = {
    "doolittle": {"doolittle_factor": 4.7, "doolittle_occupied_fraction": 0.66, **TAIT},
    "mcewen": {"mcewen_coefficient_per_pa": 2.2e-8, "mcewen_exponent": 9},
    "yasutomi": {"yasutomi_c1": 16.09, "yasutomi_c2_k": 26, "yasutomi_above_glass_k": 140, "yasutomi_a1_k": 188.9,
                 "yasutomi_a2_per_pa": 0.719e-9, "yasutomi_b1_per_pa": 8.2e-9, "yasutomi_b2": -0.5278},
}
EYRING = {"flow_law": "eyring", "eyring_stress_pa": 5e6}
FILMS = ["central_film", "minimum_film", "max_pressure", "friction_coefficient"]


class Oils(TestCase):
    def test_methods(self):
        """FAS and PETSc find the solution of Newton's method, with a Ree-Eyring oil that slides."""
        has_petsc = "PETSc" in run("case", "--version", "--verbose").stdout
        methods = ["fas", "petsc"] if has_petsc else ["fas"]
        for m, d in ((100, 1), (200, 0.35)):
            groups = {"m": m, "d": d, "grid": {"cells_x": 64, "cells_y": 64}, "lubricant": EYRING,
                      "conditions": {"slip_parameter": 1.5, "reduced_modulus_pa": 2.26e11}}
            newton = solve(**groups, solver={"tolerance": 1e-9})
            for method in methods:
                with self.subTest(m=m, d=d, method=method):
                    other = solve(**groups, solver={"tolerance": 1e-9, "method": method})
                    self.assertEqual(other["status"], "converged")
                    worst = max(self.check_close(other[name], newton[name], 1e-8, name) for name in FILMS)
                    report(f"M = {m}, D = {d}: {method} within {worst:.1e} of Newton")

    def test_small_stress(self):
        """0.5 MPa under 3.8 GPa: the flow at the steep end grows exponentially with the gradient."""
        result = solve(m=300, l=12, d=0, conditions={"reduced_modulus_pa": 2.26e11}, grid={"cells_x": 1024},
                       lubricant={"flow_law": "eyring", "eyring_stress_pa": 5e5})
        self.assertEqual((result["status"], result["rung"]), ("converged", "direct"))
        self.assertLessEqual(result["nonlinear_steps"], 12)

    def test_viscosity_laws(self):
        """Roelands' oil with the same film-forming coefficient has the same film within 6 %; less the more alike the laws are."""
        for shape, (conditions, grid) in SHAPES.items():
            for law, keys in LAWS.items():
                with self.subTest(shape=shape, law=law):
                    result = solve(conditions=conditions, grid=grid, lubricant={"viscosity_law": law, **keys})
                    self.assertEqual((result["status"], result["rung"]), ("converged", "direct"))
                    alpha = result["alphabar"]/result["hertz_pressure_pa"]
                    density = TAIT if law == "doolittle" else {}
                    roelands = solve(conditions=conditions, grid=grid, lubricant={"pressure_viscosity_per_pa": alpha, **density})
                    self.check_close(roelands["lubricant_parameter_l"], result["lubricant_parameter_l"], 1e-9, "L")
                    deviation = self.check_close(result["central_film"], roelands["central_film"], 0.06, "film")
                    report(f"{shape}, {law}: alpha {alpha:.3g} 1/Pa, film {100*deviation:.1f} % from Roelands'")

    def test_carreau(self):
        """S = 0.5: converges, the film a little thinner than the Newtonian film, friction below 1 and against the
        motion. The Newtonian oil would have more than 1, which is not given.
        """
        carreau = {"flow_law": "carreau", "carreau_modulus_pa": 7e6, "carreau_exponent": 0.4}
        for shape, (conditions, grid) in SHAPES.items():
            with self.subTest(shape=shape):
                groups = {"conditions": {**conditions, "slip_parameter": 0.5}, "grid": grid}
                newtonian = solve(**groups)
                result = solve(**groups, lubricant=carreau)
                self.assertEqual((result["status"], result["rung"]), ("converged", "direct"))
                thinning = 1 - result["central_film"]/newtonian["central_film"]
                self.assertGreater(thinning, 0)
                self.assertLess(thinning, 0.05)
                self.assertLess(result["friction_coefficient"], 0)
                self.assertIsNone(newtonian["friction_coefficient"])
                self.assertLess(-result["friction_coefficient"], 0.3)
                self.assertGreater(result["tangent_factor_x"], result["tangent_factor_y"])
                report(f"{shape}: film {100*thinning:.1f} % thinner, friction {result['friction_coefficient']:.3f}")


if __name__ == "__main__":
    unittest.main()
