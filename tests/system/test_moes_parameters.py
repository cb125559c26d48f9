"""The Moes parameters and Hertz lengths of ehlwave equal the values of ehlwave-case."""

import re
import sys
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import SKIPPED, last_line, namelist, run

try:
    from ehlwave.surface import conditions_from_keys, read_conditions
except ImportError as error:
    print(f"SKIPPED: ehlwave cannot be imported ({error})")
    sys.exit(SKIPPED)

CONTACTS = [
    {"radius_x_m": 12.52e-3, "radius_y_m": radius_y, "reduced_modulus_pa": 1.17e11, "load_n": load,
     "mean_speed_m_per_s": speed, "viscosity_pa_s": 1.22}
    for radius_y, load, speed in ((12.52e-3, 39.2, 0.024), (12.521e-3, 39.2, 0.024), (0.05, 100.0, 1.0), (1.0, 500.0, 0.2))
]


class MoesParameters(unittest.TestCase):
    def plan(self, conditions, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "case.nml")
            path.write_text(namelist({"conditions": conditions, "lubricant": {"pressure_viscosity_per_pa": 2.25e-8},
                                      "grid": {"cells_x": 64, "cells_y": 64}}))
            outcome = run("case", path, "--json", *arguments)
            self.assertEqual(outcome.returncode, 0, outcome.stderr)
            return outcome, read_conditions([str(path)])

    def test_plan(self):
        for contact in CONTACTS:
            outcome, ours = self.plan(contact, "--plan")
            theirs = last_line(outcome)
            for name, value in (("load_parameter_m", ours.m), ("lubricant_parameter_l", ours.l), ("radius_ratio_d", ours.d),
                                ("kappa", ours.kappa), ("gamma", ours.gamma)):
                self.assertAlmostEqual(value/theirs[name], 1, delta=1e-11, msg=f"{name} of {contact}")
            # lengths are printed with five digits
            a, b, c = map(float, re.search(r"a = (\S+) mm, b = (\S+) mm, c = (\S+) um", outcome.stdout).groups())
            for value, printed in ((ours.semi_axis_a_m*1e3, a), (ours.semi_axis_b_m*1e3, b),
                                   (ours.hertz_approach_c_m*1e6, c)):
                self.assertAlmostEqual(value/printed, 1, delta=1e-4)

    def test_film_thickness_formula(self):
        """The formula is a fit, up to 20 % above converged films; 64 cells add a few per cent."""
        for contact in CONTACTS[:2]:
            outcome, ours = self.plan(contact, "--quiet")
            self.assertAlmostEqual(ours.central_film_m*1e6/last_line(outcome)["central_film_um"], 1.1, delta=0.1)

    def test_moes_form(self):
        keys = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 0.35}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "case.nml")
            path.write_text(namelist({"conditions": keys}))
            outcome = run("case", path, "--json", "--plan")
        ours = conditions_from_keys({**keys, "semi_axis_a_m": 1e-4})
        self.assertAlmostEqual(ours.gamma/last_line(outcome)["gamma"], 1, delta=1e-11)


if __name__ == "__main__":
    unittest.main()
