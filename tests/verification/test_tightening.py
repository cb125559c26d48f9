"""Settings that must not change a result, or must change it by a known order."""

import math
import unittest

from ehlwave_program import IS_LONG, TestCase, report, solve

TIGHT = {"tolerance": 1e-8, "step_tolerance": 1e-7}
RATIOS = ["amplitude_ratio", "amplitude_ratio_fit"]


def wavy(cells, orientation="transverse", wavelength=0.5, m=100, **groups):
    """D = 1 with a moving pattern of 20 % of the film."""
    groups["grid"] = {"cells_x": cells, "cells_y": cells, **groups.get("grid", {})}
    groups.setdefault("waviness", {"orientation": orientation, "wavelength_over_a": wavelength})
    return solve(m=m, d=1, **groups)


class Tightening(TestCase):
    def test_default_step_tolerance_is_tight_enough(self):
        cells = 128 if IS_LONG else 64
        default, tight = wavy(cells), wavy(cells, solver={"step_tolerance": 1e-6})
        for key in RATIOS:
            report(f"{key}: step tolerance 1e-3 against 1e-6: {self.check_close(default[key], tight[key], 1e-3, key):.1e}")

    def test_half_domain_equals_whole_domain(self):
        half = wavy(64, "isotropic", solver=TIGHT)
        whole = wavy(64, "isotropic", solver=TIGHT, grid={"domain": "whole"})
        for key in ["central_film", "minimum_film", "max_pressure", *RATIOS]:
            report(f"{key}: half against whole {self.check_close(half[key], whole[key], 1e-6, key):.1e}")

    def test_order_with_other_time_steps(self):
        # M = 20 reaches the asymptotic range of its error on coarser grids than M = 100, at a seventh of the work.
        for ratio in [0.5, 2] if IS_LONG else [2]:
            with self.subTest(time_step_over_cell=ratio):
                fits = [wavy(cells, m=20, wavelength=2, dynamics={"end_time": 7.5},
                             solver={**TIGHT, "step_tolerance": 1e-5, "time_step_over_cell": ratio})["amplitude_ratio_fit"]
                        for cells in [32, 64, 128]]
                report(f"dT/hX = {ratio}: order {self.check_order(fits, 1.7, 'Ad/Ai'):.2f} of {fits}")

    def test_slip_runs(self):
        for slip in [0.5, 1.5] if IS_LONG else [1.5]:
            with self.subTest(slip=slip):
                result = wavy(64, "isotropic", 1, conditions={"slip_parameter": slip})
                self.assertEqual(result["status"], "converged")
                self.assertTrue(0 < result["amplitude_ratio_fit"] < 1, result["amplitude_ratio_fit"])
                report(f"slip {slip}: Ad/Ai = {result['amplitude_ratio_fit']:.4f}")

    def test_stiff_mounting_is_force_balance(self):
        static = wavy(64, solver=TIGHT)["amplitude_ratio_fit"]
        deviations = []
        for frequency in [100, 1000]:
            dynamics = {"load_balance": "equation_of_motion", "natural_frequency": frequency}
            moving = wavy(64, solver=TIGHT, dynamics=dynamics)["amplitude_ratio_fit"]
            deviations.append(abs(moving/static - 1))
        report(f"deviation from force balance at Omega = 100, 1000: {deviations[0]:.1e}, {deviations[1]:.1e}")
        self.assertLess(deviations[1], 1e-6)
        self.assertGreater(deviations[0], deviations[1])

    def test_load_step(self):
        """After a step of the load the film soon settles by force balance; a mass swings on it, with a warning."""
        step = {"load_factor": 1.5, "end_time": 7.5}
        settled = wavy(48, wavelength=1, dynamics=step)
        swinging = wavy(48, wavelength=1, dynamics=step | {"load_balance": "equation_of_motion", "natural_frequency": 4})
        true = abs(swinging["amplitude_ratio_fit"]/settled["amplitude_ratio_fit"] - 1)
        self.assertGreater(true, 0.1)
        self.assertLess(settled["ratio_error_settling"], 0.05)
        self.assertGreater(swinging["ratio_error_settling"], true)
        self.assertNotIn("still changes", settled["validity"])
        self.assertIn("still changes", swinging["validity"])
        report(f"swing after a load step: Ad/Ai {true:.2f} off, said {swinging['ratio_error_settling']:.2f}")

    def test_oblique_pattern_tends_to_transverse(self):
        transverse = wavy(64, solver=TIGHT)
        deviations = []
        for wavelength_y in [10.0, 1e4]:
            waviness = {"orientation": "custom", "wavelength_x_over_a": 0.5, "wavelength_y_over_a": wavelength_y,
                        "oblique": True}
            oblique = wavy(64, waviness=waviness, solver=TIGHT)
            deviations.append(abs(oblique["amplitude_ratio_fit"]/transverse["amplitude_ratio_fit"] - 1))
        report(f"oblique against transverse for lambda_y/a = 10, 1e4: {deviations[0]:.1e}, {deviations[1]:.1e}")
        self.assertTrue(all(map(math.isfinite, deviations)))
        self.assertLess(deviations[1], 1e-7)
        self.assertGreater(deviations[0], 1e-5)

    def test_small_amplitudes_respond_linearly(self):
        small, large = (wavy(64, waviness={"orientation": "transverse", "wavelength_over_a": 0.5,
                                           "amplitude_over_film": amplitude}, solver=TIGHT)["amplitude_ratio_fit"]
                        for amplitude in [0.01, 0.2])
        report(f"Ad/Ai at 1 % against 20 % of the film: {self.check_close(small, large, 5e-3, 'response'):.1e}")


if __name__ == "__main__":
    unittest.main()
