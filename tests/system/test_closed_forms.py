"""Closed forms in Fortran and Python agree to round-off, in random contacts."""

import math
import random
import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

from ehlwave_program import IS_LONG, SKIPPED, last_line, namelist, run

try:
    import h5py
    import numpy as np
    from ehlwave.contact import formula
    from ehlwave.contact import conditions_from_keys, hertz_medium
    from ehlwave.contact.scales import moes_film
except ImportError as error:
    print(f"SKIPPED: ehlwave cannot be imported ({error})")
    sys.exit(SKIPPED)

SEED = 340034
CONTACTS = 40 if IS_LONG else 15      # contacts of each kind
ROUND_OFF = 1e-12
OILS = ({}, {"flow_law": "eyring", "eyring_stress_pa": 4e6}, {"flow_law": "carreau", "carreau_modulus_pa": 2e6, "carreau_exponent": 0.6})


def between(draw, low, high):
    """A number whose logarithm is uniform."""
    return math.exp(draw.uniform(math.log(low), math.log(high)))


def moes(draw):
    return {"load_parameter_m": between(draw, 5, 2000), "lubricant_parameter_l": between(draw, 0.5, 20),
            "radius_ratio_d": draw.choice([1, between(draw, 0.005, 1), 1 - between(draw, 1e-7, 1e-3)])}


def moes_line(draw):
    return {"load_parameter_m": between(draw, 5, 1000), "lubricant_parameter_l": between(draw, 0.5, 20), "radius_ratio_d": 0}


def dimensional(draw):
    radius = between(draw, 5e-3, 5e-2)
    return {"radius_x_m": radius, "radius_y_m": radius*between(draw, 1, 100), "reduced_modulus_pa": between(draw, 1e11, 3e11),
            "load_n": between(draw, 5, 200), "mean_speed_m_per_s": between(draw, 0.05, 5), "viscosity_pa_s": between(draw, 0.01, 1)}


def dimensional_line(draw):
    keys = dimensional(draw)
    del keys["radius_y_m"], keys["load_n"]
    return {**keys, "load_n_per_m": between(draw, 1e4, 5e5)}


def wave(draw, is_line):
    if is_line:
        return between(draw, 0.1, 4), 0
    return draw.choice([(between(draw, 0.1, 4), 0), (0, between(draw, 0.1, 4)), (between(draw, 0.1, 4), between(draw, 0.1, 4))])


class ClosedForms(unittest.TestCase):
    def check(self, name, found, expected):
        error = abs(found - expected)/abs(expected)
        self.assertLess(error, ROUND_OFF, f"{name}: {found} in Python, {expected} in Fortran, relative difference {error:.2g}")

    def plan(self, conditions, waves):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "case.nml").write_text(namelist({
                "conditions": conditions, "waviness": {"orientation": "custom", "wavelength_x_over_a": waves[0],
                                                       "wavelength_y_over_a": waves[1], "response": "harmonic"}}))
            outcome = run("case", "case.nml", "--plan", "--json", folder=folder)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        return last_line(outcome)

    def test_scales_and_formulas(self):
        for make in (moes, moes_line, dimensional, dimensional_line):
            draw = random.Random(SEED + len(make.__name__))
            for count in range(CONTACTS):
                keys = make(draw)
                waves = wave(draw, "line" in make.__name__)
                with self.subTest(make.__name__, count=count, **keys):
                    theirs = self.plan(keys, waves)
                    self.compare(conditions_from_keys(keys, needs_lengths=False), waves, theirs)

    def compare(self, ours, waves, theirs):
        shortest = min(one for one in waves if one > 0)
        v = formula.v(shortest, ours.m, ours.l, ours.gamma)
        f_r = formula.f_of_r(formula.wavelength_ratio(*waves))
        found = {
            "load_parameter_m": ours.m, "lubricant_parameter_l": ours.l, "radius_ratio_d": ours.d, "kappa": ours.kappa,
            "gamma": ours.gamma, "alphabar": ours.alphabar, "lambdabar": ours.lambdabar,
            "central_film_formula": moes_film(ours.m, ours.l, ours.d), "v": v, "v2": formula.v2(shortest, ours.m, ours.l),
            "f_r": f_r, "formula_ratio": formula.amplitude_ratio_formula(f_r*v)}
        if "semi_axis_a_m" in theirs:
            found |= {"semi_axis_a_m": ours.semi_axis_a_m, "hertz_approach_c_m": ours.hertz_approach_c_m,
                      "moes_film_factor": ours.hertz_approach_c_m/ours.metres_per_moes}
            if not ours.is_line:
                found["semi_axis_b_m"] = ours.semi_axis_b_m
        for name, value in found.items():
            if theirs[name] == 0:
                self.assertEqual(float(value), 0, name)
            else:
                self.check(name, float(value), theirs[name])

    def test_waves_under_slip(self):
        """The attenuated wave and psi, of pressure and film at the computed centre."""
        draw = random.Random(SEED)
        for count in range(12):
            is_line, oil = count % 4 == 3, OILS[count % 3]
            conditions = {**(moes_line if is_line else moes)(draw), "load_parameter_m": between(draw, 20, 200),
                          "lubricant_parameter_l": between(draw, 3, 12), "slip_parameter": draw.uniform(0.4, 1.6)}
            if not is_line:
                conditions["radius_ratio_d"] = between(draw, 0.2, 1)
            if oil:
                conditions["reduced_modulus_pa"] = 2.2e11
            waves = between(draw, 0.4, 2), 0 if is_line else draw.choice([0, between(draw, 0.4, 2)])
            with self.subTest(count=count, oil=oil, waves=waves, **conditions):
                self.compare_waves(conditions, oil, waves)

    def compare_waves(self, keys, oil, waves):
        flow = {name: value for name, value in oil.items() if name != "flow_law"}
        ours = conditions_from_keys({**keys, **flow}, needs_lengths=False)
        slip = ours.slip_parameter
        groups = {"conditions": keys, "lubricant": oil, "grid": {"cells_x": 256 if ours.is_line else 48},
                  "waviness": {"orientation": "custom", "wavelength_x_over_a": waves[0], "wavelength_y_over_a": waves[1],
                               "response": "harmonic"}}
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "case.nml").write_text(namelist(groups))
            theirs = last_line(run("case", "case.nml", "--json", "--quiet", "--output", "case.h5", folder=folder))
            with h5py.File(Path(folder, "case.h5")) as file:
                x, y, pressure, film = (file[name][...] for name in ("x", "y", "pressure", "film"))
        place = np.abs(y).argmin(), np.abs(x).argmin()
        medium = hertz_medium(replace(ours.oil, stress_modulus_pa2=None), ours.kappa, ours.alphabar, ours.lambdabar,
                              film[place], slip, pressure[place])
        if oil:   # with the pressure gradient of the place
            medium = replace(medium, eps_x=medium.eps_x*theirs["tangent_factor_x"], eps_y=medium.eps_y*theirs["tangent_factor_y"])
        kx = 2*math.pi/waves[0]
        ky = 2*math.pi/waves[1] if waves[1] else 0
        for name, found in (("attenuated_formula", medium.attenuated(kx, ky, slip)),
                            ("psi_formula", medium.complementary_number(kx*slip, ky))):
            self.check(name, complex(found), complex(theirs[f"{name}_real"], theirs[f"{name}_imaginary"]))


if __name__ == "__main__":
    unittest.main()
