"""Warning of a warm inlet: the program's numbers are the package's, and contacts that are computed with heat lie within them."""

import random
import sys
import unittest

from ehlwave_program import SKIPPED, TestCase, report, solve

try:
    from ehlwave.contact import conditions_from_keys
    from ehlwave.laws.inlet_warming import inlet_warming
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(SKIPPED)

README = {"radius_x_m": 0.0127, "radius_y_m": 0.0127, "reduced_modulus_pa": 2.26e11, "load_n": 40, "mean_speed_m_per_s": 4,
          "viscosity_pa_s": 0.05}
HEAT = {"viscosity_temperature_per_k": 0.04, "oil_conductivity_w_per_m_k": 0.14, "oil_heat_capacity_j_per_kg_k": 2000,
        "oil_density_kg_per_m3": 870, "oil_expansion_per_k": 7e-4, "body_density_kg_per_m3": 7800}
FLOODED = {"edges": "flooded", "x_min": -5, "y_max": 4, "cells_x": 128, "cells_y": 128}


class InletWarming(TestCase):
    def test_program_and_package(self):
        """Random contacts, some beyond the law: factor, error and rise alike."""
        draw = random.Random(5)
        beyond = 0
        for _ in range(12):
            given = {**README, "load_n": 10**draw.uniform(1.5, 2.7), "mean_speed_m_per_s": 10**draw.uniform(-0.3, 0.7),
                     "viscosity_pa_s": 10**draw.uniform(-1.7, -1), "radius_y_m": 0.0127*10**draw.uniform(0, 0.7),
                     "slip_parameter": draw.choice((1, 1.05, 1.3, 1.97))}   # the law ends at 1.95
            result = solve(conditions=given, lubricant={"flow_law": "eyring", "eyring_stress_pa": 5e6},
                           grid={"edges": "flooded", "cells_x": 64, "cells_y": 64})
            found = inlet_warming(conditions_from_keys(given), film_m=result["central_film_um"]*1e-6)
            self.check_close(result["inlet_film_factor"], 1 - found.loss, 1e-9, "film factor")
            self.check_close(result["inlet_temperature_rise_k"], found.rise_k, 1e-6, "rise")
            if found.error is None:
                beyond += 1
                self.assertIsNone(result["inlet_film_factor_error"])
            else:
                self.check_close(result["inlet_film_factor_error"], found.error, 1e-6, "error")
        self.assertTrue(0 < beyond < 12, beyond)

    def test_contacts_computed_with_heat(self):
        for name, given in {"ball": README, "heavier ball": README | {"load_n": 200},
                            "thicker oil": README | {"load_n": 100, "mean_speed_m_per_s": 2, "viscosity_pa_s": 0.1},
                            "roller": {"radius_x_m": 0.01, "reduced_modulus_pa": 2.26e11, "load_n_per_m": 2e5, "mean_speed_m_per_s": 4,
                                       "viscosity_pa_s": 0.03}}.items():
            grid = FLOODED if name != "roller" else {"edges": "flooded", "x_min": -6, "cells_x": 768}
            warned = solve(conditions=given, grid=grid)
            computed = solve(conditions=given, grid=grid, lubricant={"temperature_k": 313.15}, heat=HEAT)
            factor = computed["central_film"]/computed["isothermal_central_film"]
            report(f"{name}: warned {100*(1 - warned['inlet_film_factor']):.1f} +- {100*warned['inlet_film_factor_error']:.1f} %, "
                   f"computed {100*(1 - factor):.1f} %")
            self.assertLess(abs(warned["inlet_film_factor"] - factor), warned["inlet_film_factor_error"])
            self.assertIn("the inlet would warm", warned["warning"])
            self.assertNotIn("the inlet would warm", computed["warning"])


class LargeErrors(TestCase):
    def test_a_film_that_is_hardly_known(self):
        """Slender and heavy, with an accuracy that the central film reaches: a warning of the smallest film alone."""
        result = solve(m=20000, l=13.2, d=0.03, grid={"edges": "flooded"}, solver={"accuracy": 0.02})
        self.assertLess(result["central_film_error"], 0.02)
        self.assertGreater(result["minimum_film_error"], 0.3)
        self.assertIn(f"large errors: smallest H {100*result['minimum_film_error']:.2g} %;", result["warning"])

    def test_a_fine_grid_has_no_warning(self):
        self.assertNotIn("large errors", solve(m=50, l=8, d=1, grid={"cells_x": 128, "cells_y": 128})["warning"])


if __name__ == "__main__":
    unittest.main()
