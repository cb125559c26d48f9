"""Random inputs whose errors once exceeded their estimates, each of a different class."""

import tempfile
import unittest
from pathlib import Path

from ehlwave_program import last_line, namelist, report, run
from studies.all_keys.compare import FACTOR, SLACK, findings

LINE = {"radius_x_m": 0.01, "reduced_modulus_pa": 2.26e11, "load_n_per_m": 148488, "mean_speed_m_per_s": 0.233566, "viscosity_pa_s": 0.04}
SMOOTH_LINE = {"conditions": LINE, "grid": {"x_min": -3.016}}
LIGHT = {"conditions": {"radius_x_m": 0.01, "radius_y_m": 0.136949, "reduced_modulus_pa": 2.26e11, "load_n": 6.69419,
                        "mean_speed_m_per_s": 0.557621, "viscosity_pa_s": 0.04},
         "lubricant": {"flow_law": "eyring", "eyring_stress_pa": 1.561e6},
         "waviness": {"orientation": "transverse", "wavelength_over_a": 1.991, "response": "harmonic"}, "grid": {"x_min": -5, "x_max": 2.1213, "y_max": 4},
         "solver": {"time_step_over_cell": 0.5}}
FINE_MARCH = {"conditions": {"load_parameter_m": 7.312, "lubricant_parameter_l": 6.949, "radius_ratio_d": 0},
              "waviness": {"orientation": "transverse", "wavelength_over_a": 0.5829, "amplitude_over_film": 0.0117},
              "grid": {"cells_x": 432}, "solver": {"error_estimate": "model", "settling_periods": 4}}
STRESS_LIMIT = {"conditions": {"radius_x_m": 0.01, "radius_y_m": 0.119689, "reduced_modulus_pa": 2.26e11, "load_n": 33.3046,
                               "mean_speed_m_per_s": 1.89546, "viscosity_pa_s": 0.04, "slip_parameter": 0.68},
                "lubricant": {"density_law": "incompressible", "shear_limit_over_pressure": 0.1488, "shear_limit_width": 0.1181},
                "waviness": {"orientation": "transverse", "wavelength_over_a": 2.846, "response": "harmonic"},
                "grid": {"cells_x": 64, "cells_y": 96}}
FITTED = {"conditions": {"reduced_modulus_pa": 1.323e11, "load_parameter_m": 53.42, "lubricant_parameter_l": 2.095, "radius_ratio_d": 0.1313,
                         "slip_parameter": 0.71},
          "lubricant": {"viscosity_law": "isoviscous", "density_law": "incompressible"},
          "grid": {"cells_x": 64, "cells_y": 50, "x_max": 2.24}, "solver": {"scheme": "fitted"}}
HOT = {"conditions": {"radius_x_m": 0.01, "radius_y_m": 0.0103252, "reduced_modulus_pa": 2.26e11, "load_n": 1832.76, "mean_speed_m_per_s": 555.302,
                      "viscosity_pa_s": 0.04},
       "lubricant": {"viscosity_law": "roelands", "pressure_viscosity_per_pa": 5e-9, "temperature_k": 355.9},
       "heat": {"oil_conductivity_w_per_m_k": 0.1352, "oil_heat_capacity_j_per_kg_k": 2193, "oil_density_kg_per_m3": 913.8,
                "viscosity_temperature_per_k": 0.05999, "body2_conductivity_w_per_m_k": 44.95, "body2_density_kg_per_m3": 6932},
       "grid": {"cells_x": 64, "cells_y": 24}}
WARM_ROLLING = {"conditions": {"radius_x_m": 0.01, "radius_y_m": 0.0621891, "reduced_modulus_pa": 2.26e11, "load_n": 5.64617,
                               "mean_speed_m_per_s": 0.144324, "viscosity_pa_s": 0.04},
                "lubricant": {"density_law": "incompressible", "flow_law": "eyring", "eyring_stress_pa": 161700, "temperature_k": 316.2},
                "heat": {"oil_conductivity_w_per_m_k": 0.1209, "oil_heat_capacity_j_per_kg_k": 2286, "oil_density_kg_per_m3": 920.5,
                         "viscosity_temperature_per_k": 0.04635, "body_heat_capacity_j_per_kg_k": 756.1, "body2_density_kg_per_m3": 3189},
                "grid": {"cells_x": 48, "cells_y": 40, "edges": "truncated"}}


class DeclaredErrors(unittest.TestCase):
    def solve(self, groups):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "case.nml").write_text(namelist(groups))
            outcome = run("case", "case.nml", "--json", "--quiet", folder=folder)
        self.assertEqual(outcome.returncode, 0, outcome.stdout + outcome.stderr)
        return last_line(outcome)

    def check_on_twice_the_cells(self, groups, **cells):
        one, finer = (self.solve({**groups, "grid": {**groups["grid"], **{key: factor*n for key, n in cells.items()}}}) for factor in (1, 2))
        for found in findings(one | {"response_tolerance": 1e-5}, finer):
            report(f"{found.number}: off {found.off:.2%}, declared {found.declared:.2%}")
            self.assertFalse(found.is_offender, found)

    def check_against(self, finer, groups):
        """A case against numbers of the same on twice the cells, which would take long."""
        one = self.solve(groups)
        all_of_it = findings(one | {"response_tolerance": 1e-5}, dict.fromkeys(one) | finer)
        self.assertTrue(all_of_it)
        for found in all_of_it:
            report(f"{found.number}: off {found.off:.2%}, declared {found.declared:.2%}")
            self.assertFalse(found.is_offender, found)

    def test_response_where_the_stress_is_at_its_limit(self):
        self.check_against({"harmonic_real": 0.976001, "harmonic_imaginary": -0.227842}, STRESS_LIMIT)

    def test_friction_with_the_fitted_scheme_and_no_coarser_grid(self):
        self.check_against({"central_film": 0.178395, "minimum_film": 0.138555, "friction_coefficient": -0.000259728}, FITTED)

    def test_friction_of_warm_oil_in_pure_rolling(self):
        self.check_on_twice_the_cells(WARM_ROLLING, cells_x=48, cells_y=40)

    def test_friction_of_warm_oil_that_is_next_to_nothing(self):
        """7.1e-8, 8.1e-8 and 8.6e-8 on 96 to 288 cells."""
        self.check_on_twice_the_cells({**WARM_ROLLING, "conditions": {**WARM_ROLLING["conditions"], "mean_speed_m_per_s": 0.5},
                                       "lubricant": {**WARM_ROLLING["lubricant"], "eyring_stress_pa": 5e6}}, cells_x=96, cells_y=80)

    def test_film_with_the_fitted_scheme_and_grids_that_agree_by_chance(self):
        conditions = {"load_parameter_m": 221.3, "lubricant_parameter_l": 2.328, "radius_ratio_d": 0.8511}
        self.check_against({"central_film": 0.0226771}, {"conditions": conditions, "lubricant": {"viscosity_law": "isoviscous"},
                                                         "grid": {"cells_x": 64, "cells_y": 64}, "solver": {"scheme": "fitted"}})

    def test_smallest_film_that_heat_thins(self):
        self.check_against({"central_film": 0.0332049, "minimum_film": 0.0226208}, HOT)

    def test_smallest_film_of_a_line_contact(self):
        self.check_on_twice_the_cells(SMOOTH_LINE, cells_x=192)

    def test_response_where_the_coarser_grid_has_few_points_on_a_wave(self):
        self.check_on_twice_the_cells(LIGHT, cells_x=64, cells_y=64)

    def test_march_whose_steps_change_little(self):
        """On the same grid the linear response has the mesh error of the march, and none of its steps."""
        march = self.solve(FINE_MARCH)
        response = self.solve({**FINE_MARCH, "waviness": {**FINE_MARCH["waviness"], "response": "harmonic"}})
        off = abs(march["amplitude_ratio_fit"]/response["harmonic_ratio"] - 1)
        declared = sum(march[f"ratio_error_{part}"] for part in ("time", "amplitude", "settling", "algebraic"))
        report(f"Ad/Ai: off {off:.3%}, declared {declared:.3%} without the mesh")
        self.assertLessEqual(off, FACTOR*declared + SLACK/10)

    def test_waves_longer_than_the_inlet(self):
        """A larger domain with equal mesh size changes Ad/Ai by 0.2 to 1 of the part by the domain."""
        for contact, usual, wide in (({"load_parameter_m": 10, "lubricant_parameter_l": 8, "radius_ratio_d": 0}, {"cells_x": 512},
                                      {"x_min": -20, "x_max": 2, "cells_x": 2816}),
                                     ({"load_parameter_m": 50, "lubricant_parameter_l": 8, "radius_ratio_d": 1}, {"cells_x": 64, "cells_y": 64},
                                      {"x_min": -6, "x_max": 2, "y_max": 4, "cells_x": 128, "cells_y": 128})):
            for slip in (1, 1.5):
                with self.subTest(contact=contact, slip=slip):
                    waves = {"orientation": "transverse", "wavelength_over_a": 4, "response": "harmonic"}
                    one, wider = (self.solve({"conditions": {**contact, "slip_parameter": slip}, "waviness": waves,
                                              "output": {"mean_rise": False}, "grid": grid}) for grid in (usual, wide))
                    off = abs(one["harmonic_ratio"]/wider["harmonic_ratio"] - 1)
                    report(f"S = {slip}: off {off:.3%}, declared {one['ratio_error_domain']:.3%}, then {wider['ratio_error_domain']:.3%}")
                    self.assertLess(off, one["ratio_error_domain"])
                    self.assertLess(one["ratio_error_domain"], 5*off)
                    self.assertLess(wider["ratio_error_domain"], 0.1*one["ratio_error_domain"])


if __name__ == "__main__":
    unittest.main()
