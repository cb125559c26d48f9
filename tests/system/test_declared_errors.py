"""Random inputs whose numbers were once further off than they said, each of a class of its own."""

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


if __name__ == "__main__":
    unittest.main()
