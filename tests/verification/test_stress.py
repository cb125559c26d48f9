"""Stresses below a rough contact, predicted from the atlas, against a march of the same trace."""

import sys
import unittest

from ehlwave_program import IS_LONG, SKIPPED, FolderTest, namelist, run

try:
    import numpy as np
    from ehlwave import Contact
    from ehlwave.surface import trace_surface
    from ehlwave.surface.simulation import write_simulation_surface
    from ehlwave.stress import (
        COMPONENTS,
        dang_van_factor,
        fatigue_shear,
        largest_shear,
        line_stress_over_time,
        point_histories,
    )
    from ehlwave.stress.body import INNER
except ImportError as error:
    print(f"SKIPPED: ehlwave cannot be imported ({error})")
    sys.exit(SKIPPED)

CONDITIONS = {"radius_x_m": 12.5e-3, "radius_y_m": 12.5e-3, "reduced_modulus_pa": 2.26e11, "load_n": 30,
              "mean_speed_m_per_s": 0.5, "viscosity_pa_s": 0.05}
SLENDER = CONDITIONS | {"radius_y_m": 0.03, "load_n": 60, "mean_speed_m_per_s": 1.1}
EYRING_PA = 5e6
POINTS, LENGTH = 320, 4.5     # samples of the trace, LENGTH in units of a
CYCLES = 1e8


def heights(amplitude, seed=11):
    """Random waves of 1.5 to 0.45 a, faded out at both ends; sqrt(2) Rq is the amplitude."""
    x, random = np.arange(POINTS)/POINTS, np.random.default_rng(seed)
    waves = sum(np.cos(2*np.pi*n*x + random.uniform(0, 2*np.pi))/n for n in range(3, 11))
    waves *= np.sin(0.5*np.pi*np.clip(np.minimum(x, x[-1] - x)/0.15, 0, 1))**2
    return amplitude*waves/np.std(waves)/np.sqrt(2)


class Stress(FolderTest):
    def march(self, slip, trace, conditions, stress):
        """File of a march of the trace with fields over time."""
        write_simulation_surface(trace, self.folder/"trace.h5")
        groups = {"conditions": conditions | {"slip_parameter": slip},
                  "lubricant": {"flow_law": "eyring", "eyring_stress_pa": stress},
                  "surface": {"file": "trace.h5"}, "grid": {"cells_x": 96, "cells_y": 64}, "output": {"fields_every": 3}}
        (self.folder/"case.nml").write_text(namelist(groups))
        outcome = run("case", "case.nml", "--quiet", "--output", "case.h5", folder=self.folder)
        self.check_status(outcome)
        return self.folder/"case.h5"

    def compare(self, slip, conditions=CONDITIONS, stress=EYRING_PA, amplitude=0.25, seed=11):
        contact = Contact(**conditions, eyring_stress_pa=stress, slip_parameter=slip)
        a, film = contact.conditions.semi_axis_a_m, contact.film().central_m
        trace = trace_surface(heights(amplitude*film, seed), LENGTH*a/POINTS)
        predicted = contact.stress(trace, form="none", ends="none")
        case = self.march(slip, trace, conditions, stress)
        for body, expected in enumerate(predicted.bodies, 1):
            own = slip if body == 1 else 2 - slip
            depths = expected.risk["z"].values
            over = line_stress_over_time(case, depths, body)
            inner = over.sel(x=slice(-INNER*a, INNER*a))
            shear = float(largest_shear({name: inner[name] - inner[name + "_smooth"] for name in COMPONENTS}).max())
            way = float(over["time"][-1])
            # Points that come from before the contact and have left it in the end; on the rough body the points of the
            # trace.
            starts = np.linspace(1.1*a - own*way, -1.4*a, 160)
            factor = dang_van_factor(point_histories(over, own, starts), float(fatigue_shear(CYCLES)))
            found = float(factor.max())
            print(f"  measured: S = {slip:g}, body {body}: ripple shear {expected.ripple_shear.value_pa*1e-6:.1f} predicted, "
                  f"{shear*1e-6:.1f} MPa marched (bar {expected.ripple_shear_error_pa*1e-6:.1f}); Dang Van "
                  f"{expected.dang_van:.3f} and {found:.3f} (bar {expected.dang_van_error:.3f})", flush=True)
            self.assertLessEqual(abs(expected.ripple_shear.value_pa/shear - 1), 0.1)
            self.assertLessEqual(abs(expected.ripple_shear.value_pa - shear), expected.ripple_shear_error_pa)
            self.assertLessEqual(abs(expected.dang_van/found - 1), 0.1)
            self.assertLessEqual(abs(expected.dang_van - found), expected.dang_van_error)

    @unittest.skipUnless(IS_LONG, "EHLWAVE_LONG_TESTS is not set")
    def test_rolling(self):
        self.compare(1.0)

    @unittest.skipUnless(IS_LONG, "EHLWAVE_LONG_TESTS is not set")
    def test_faster_rough_body(self):
        self.compare(1.2)

    def test_slender_contact(self):
        self.compare(1.4, SLENDER, 7e6, 0.2, 5)

    @unittest.skipUnless(IS_LONG, "EHLWAVE_LONG_TESTS is not set")
    def test_slower_rough_body(self):
        self.compare(0.8)


if __name__ == "__main__":
    unittest.main()
