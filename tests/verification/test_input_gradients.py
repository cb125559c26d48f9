"""Derivatives by every input against centred differences of whole runs."""

import copy
import csv
import math
import os
import random
import unittest

from ehlwave_program import IS_LONG, TestCase, report, solve

STEP = 2e-5          # step in the logarithm of a key
AGREEMENT = 1e-4     # relative,
ABSOLUTE = 1e-6      # or this
TIGHT = {"tolerance": 1e-12, "response_tolerance": 1e-11, "largest_steps": 100}
RESULTS = {"central_film": "_um", "minimum_film": "_um", "friction_coefficient": "", "rolling_resistance_coefficient": "",
           "rolling_resistance": "", "harmonic_ratio": "", "touching_share": "", "mean_speed": "_m_per_s"}
DEFAULTS = {"pressure_viscosity_per_pa": ("lubricant", 2.2e-8), "roelands_index": ("lubricant", 0.68),
            "shear_limit_width": ("lubricant", 0.1), "solid_friction": ("touching", 0.1)}
HEAT = {"oil_conductivity_w_per_m_k": 0.14, "oil_heat_capacity_j_per_kg_k": 2000, "oil_density_kg_per_m3": 870, "viscosity_temperature_per_k": 0.04}
TOUCHING = 1000      # draws from this number on are of surfaces that touch
WITHOUT_SOLUTION = ("stalled", "diverged", "not_finite")
TWO_SOLUTIONS = {1019}   # a change of 2e-5 in the amplitude ends in another film, 0.59 times as thick
VISCOSITY = {
    "roelands": {"pressure_viscosity_per_pa": 1.8e-8, "roelands_index": 0.6},
    "barus": {"pressure_viscosity_per_pa": 1.2e-8},
    "mcewen": {"mcewen_coefficient_per_pa": 1.5e-8, "mcewen_exponent": 9},
    "yasutomi": {"yasutomi_c1": 16, "yasutomi_c2_k": 20, "yasutomi_above_glass_k": 90, "yasutomi_a1_k": 190,
                 "yasutomi_a2_per_pa": 0.7e-9, "yasutomi_b1_per_pa": 7e-9, "yasutomi_b2": -0.6},
    "doolittle": {"density_law": "tait", "doolittle_factor": 4, "doolittle_occupied_fraction": 0.66, "tait_modulus_pa": 1.7e9,
                  "tait_modulus_rate": 11},
}
FLOW = ({}, {"flow_law": "eyring", "eyring_stress_pa": 5e6}, {"flow_law": "carreau", "carreau_modulus_pa": 5e6, "carreau_exponent": 0.5})


def conditions(draw, is_line, is_dimensional):
    """Operating conditions of a light to medium load."""
    ratio = draw.choice([1, draw.uniform(0.1, 0.95)])
    if not is_dimensional:
        return {"load_parameter_m": 10**draw.uniform(*((0.7, 1.5) if is_line else (1.3, 2.2))), "reduced_modulus_pa": 2.26e11,
                "lubricant_parameter_l": draw.uniform(3, 12), "radius_ratio_d": 0 if is_line else ratio}
    radius, modulus, pressure = 10**draw.uniform(-2.3, -1.7), 2.26e11, draw.uniform(3, 8)*1e8
    given = {"radius_x_m": radius, "reduced_modulus_pa": modulus, "mean_speed_m_per_s": 10**draw.uniform(-0.5, 0.5),
             "viscosity_pa_s": 10**draw.uniform(-1.8, -0.7)}
    if is_line:
        return given | {"load_n_per_m": 2*math.pi*radius*pressure**2/modulus}
    return given | {"radius_y_m": radius/ratio, "load_n": 2/3*math.pi**3*pressure**3*(radius/(1 + ratio))**2/modulus**2}


def contact(number):
    """Draw a contact: point or line, in SI units or not, of any oil, rolling or sliding, flooded or starved, with waves or none."""
    draw = random.Random(number)
    if number >= TOUCHING:
        return touching(draw)
    is_line, is_dimensional, is_starved = (draw.random() < share for share in (0.25, 0.7, 0.25))
    groups = {"conditions": conditions(draw, is_line, is_dimensional), "solver": dict(TIGHT),
              "lubricant": {"viscosity_law": (law := draw.choice(list(VISCOSITY))), **VISCOSITY[law]},
              "grid": {"edges": draw.choice(["flooded", "truncated"]), **({"cells_x": 256} if is_line else {"cells_x": 48, "cells_y": 48})}}
    if slides := draw.random() < 0.6:
        groups["conditions"]["slip_parameter"] = draw.uniform(0.5, 1.5)
        groups["lubricant"] |= draw.choice(FLOW)
        if draw.random() < 0.2:
            groups["lubricant"]["shear_limit_over_pressure"] = 0.06
    if is_starved:
        groups["inlet"] = {"oil_layer_m": 10**draw.uniform(-6.7, -6)} if is_dimensional else {"oil_over_flooded": draw.uniform(0.5, 1.2)}
    elif draw.random() < 0.2:
        groups["solver"]["scheme"] = "fitted"
    if not (is_starved and slides) and draw.random() < 0.7:
        shape = "transverse" if is_line else draw.choice(["transverse", "isotropic", "longitudinal", "custom"])
        lengths = ("wavelength_x_over_a", "wavelength_y_over_a") if shape == "custom" else ("wavelength_over_a",)
        groups["waviness"] = {"orientation": shape, "response": "harmonic", **{key: draw.uniform(0.6, 2) for key in lengths}}
        if not is_line and shape == "transverse" and draw.random() < 0.3:
            groups["dynamics"] = {"load_balance": "equation_of_motion", "natural_frequency": 3}
    return groups


def touching(draw):
    """Draw surfaces that touch: hard or soft solids, with the share or the speed given, smooth or with waves that rest."""
    is_line, is_soft = draw.random() < 0.8, draw.random() < 0.3
    has_share = is_soft or draw.random() < 0.6
    groups = {"conditions": conditions(draw, is_line, True) | {"mean_speed_m_per_s": 10**draw.uniform(-1.8, -1.3), "slip_parameter": draw.uniform(0.6, 1.4),
                                                              "viscosity_pa_s": 0.04}, "solver": {"scheme": draw.choice(["fitted", "averaged"])},
              "lubricant": {"viscosity_law": (law := draw.choice(["roelands", "barus"])), **VISCOSITY[law]} | draw.choice(FLOW[:2]),
              "touching": {"film_m": 10**draw.uniform(-7.8, -7.3), **({"share": draw.uniform(0.05, 0.8)} if has_share else {})},
              "grid": {"edges": draw.choice(["flooded", "truncated"]), **({"cells_x": 96} if is_line else {"cells_x": 24, "cells_y": 24})}}
    if is_soft:
        groups["touching"] |= {"law": "soft", "softness_m": 10**draw.uniform(-7.8, -7.3), "stress_pa": 10**draw.uniform(7.3, 8)}
    if draw.random() < 0.5:
        rests = is_line or draw.random() < 0.5
        groups["waviness"] = {"orientation": "transverse" if rests else "longitudinal", "wavelength_over_a": draw.uniform(0.6, 1.5),
                              "amplitude_m": 10**draw.uniform(-7.8, -7.3)}
        if rests:
            groups["conditions"]["slip_parameter"] = 0
    return groups


def varied(groups, key, change):
    """Return the groups with ln(key) changed, or None where that is outside the model."""
    group = next((name for name in groups if key in groups[name]), None)
    group, value = DEFAULTS[key] if group is None else (group, groups[group][key])
    other = copy.deepcopy(groups)
    other[group][key] = value*math.exp(change)
    given = other["conditions"]
    ratio = given.get("radius_ratio_d", given.get("radius_x_m", 0)/given.get("radius_y_m", 1))
    return None if ratio > 1 else other


def difference(groups, key, name, at, runs):
    """Return d ln(result)/d ln(key) by centred differences, to one side where the other is outside the model; None: no result."""
    def value(change):
        if change not in runs:
            other = varied(groups, key, change)
            runs[change] = other and solve(**other)
        result = runs[change]
        return result and result[name] and math.log(abs(result[name]))

    up, down = value(STEP), value(-STEP)
    if up is not None and down is not None:
        return (up - down)/(2*STEP)
    side = STEP if down is None else -STEP
    return None if value(2*side) is None else (-1.5*at + 2*value(side) - 0.5*value(2*side))/side


def recorded(path):
    """Return derivatives and largest deviations of the draws of a table as record/gradients.csv, which is begun if it is not there."""
    if not os.path.exists(path):
        append(path, ["draw", "contact", "oil", "flow", "inlet", "waves", "derivatives", "largest_deviation"])
    with open(path, newline="", encoding="utf-8") as file:
        return {int(row["draw"]): (int(row["derivatives"]), float(row["largest_deviation"])) for row in csv.DictReader(file)}


def append(path, row):
    """Append a row to a table."""
    with open(path, "a", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerow(row)


def kind(groups):
    """Return contact, viscosity law, flow law, inlet and waves of a draw."""
    given = groups["conditions"]
    is_line = "load_n_per_m" in given or given.get("radius_ratio_d") == 0
    return ("line" if is_line else "point", groups["lubricant"]["viscosity_law"], groups["lubricant"].get("flow_law", "newtonian"),
            "touching" if "touching" in groups else "starved" if "inlet" in groups else "flooded", groups.get("waviness", {}).get("orientation", "none"))


class InputGradients(TestCase):
    def check(self, number):
        """Compare all derivatives of a drawn contact; returns how many there are, 0 without a solution, and the largest deviation."""
        groups = contact(number)
        try:
            result = solve(**groups, output={"sensitivities": True})
        except AssertionError as failed:
            if any(f'"status": "{status}"' in str(failed) for status in WITHOUT_SOLUTION):
                return 0, 0
            raise
        self.assertIn(result["status"], ("converged", "unresolved"))
        lengths = "load_n" in groups["conditions"] or "load_n_per_m" in groups["conditions"]
        keys = [name.removeprefix("sensitivity_central_film_") for name in result if name.startswith("sensitivity_central_film_")]
        if not IS_LONG:   # every third key, others in the next draws
            keys = sorted(keys)[number % 3::3]
        count, worst = 0, 0
        for key in keys:
            if key == "slide_to_roll_ratio" or (key == "slip_parameter" and key not in groups["conditions"]):
                continue
            runs = {}
            for of, unit in RESULTS.items():
                found = result.get(f"sensitivity_{of}_{key}")
                base = result.get(of + (unit if lengths else ""))
                if of == "touching_share" and groups.get("touching", {}).get(of.removeprefix("touching_")):
                    continue   # given
                if not base:
                    self.assertIsNone(found, f"{number}: {of} by {key} of a result that is not given")
                    continue
                expected = difference(groups, key, of + (unit if lengths else ""), math.log(abs(base)), runs)
                self.assertIsNotNone(found, f"{number}: {of} by {key}")
                deviation = abs(found - expected)/max(abs(expected), ABSOLUTE/AGREEMENT)
                if not deviation <= AGREEMENT:   # the other draws are computed first
                    report(f"{number}: {of} by {key}: {found} against {expected} in {groups}")
                count, worst = count + 1, max(worst, deviation)
        return count, worst

    def test_drawn_contacts(self):
        """Points and lines of any oil, sliding or not, flooded or starved, and surfaces that touch."""
        first = int(os.environ.get("EHLWAVE_FIRST_DRAW", "0"))
        numbers = [*range(first, first + (200 if IS_LONG else 6)), *range(TOUCHING + first, TOUCHING + first + (60 if IS_LONG else 3))]
        numbers = [number for number in numbers if number not in TWO_SOLUTIONS]
        path = os.environ.get("EHLWAVE_GRADIENTS")   # a table as record/gradients.csv, which goes on where it was stopped
        outcomes = recorded(path) if path else {}
        for number in numbers:
            with self.subTest(draw=number):   # a draw that fails leaves the others
                if number not in outcomes:
                    outcomes[number] = count, worst = self.check(number)
                    if path:
                        append(path, [number, *kind(contact(number)), count, f"{worst:.1e}"])
                self.assertLessEqual(outcomes[number][1], AGREEMENT)
        for least, is_touching, name in ((0.9, False, "full films"), (0.5, True, "touching surfaces")):
            counts = [outcomes.get(number, (0, 0))[0] for number in numbers if (number >= TOUCHING) == is_touching]
            self.assertGreater(sum(count > 0 for count in counts), least*len(counts), f"{name} with a solution")
        report(f"{len(outcomes)} contacts, {sum(count for count, _ in outcomes.values())} derivatives: "
               f"largest deviation {max(worst for _, worst in outcomes.values()):.1e}")

    def test_slide_to_roll_ratio(self):
        """Slip in other words: ln(S) and ln of the ratio are one change."""
        result = solve(conditions={**conditions(random.Random(1), False, True), "slide_to_roll_ratio": 0.4},
                       lubricant=FLOW[1], grid={"cells_x": 48, "cells_y": 48}, output={"sensitivities": True})
        for of in ("central_film", "friction_coefficient"):
            self.check_close(result[f"sensitivity_{of}_slide_to_roll_ratio"], result[f"sensitivity_{of}_slip_parameter"]*0.2/1.2, 1e-5, of)

    def test_dimensional_analysis(self):
        """Lengths, and stresses, scaled together leave all that has no unit."""
        groups = {"conditions": {**conditions(random.Random(2), False, True), "slip_parameter": 1.3}, "lubricant": FLOW[1] | VISCOSITY["mcewen"] |
                  {"viscosity_law": "mcewen", "density_law": "incompressible"}, "grid": {"cells_x": 48, "cells_y": 48}}
        result = solve(**groups, output={"sensitivities": True})
        powers = {"length": {"radius_x_m": 1, "radius_y_m": 1, "load_n": 2, "mean_speed_m_per_s": 1},
                  "stress": {"reduced_modulus_pa": 1, "load_n": 1, "viscosity_pa_s": 1, "mcewen_coefficient_per_pa": -1, "eyring_stress_pa": 1}}
        for unit, keys in powers.items():
            for of, expected in (("central_film", 1 if unit == "length" else 0), ("friction_coefficient", 0)):
                total = sum(power*result[f"sensitivity_{of}_{key}"] for key, power in keys.items())
                self.assertAlmostEqual(total, expected, delta=2e-5, msg=f"{of}, {unit}")

    def test_refusals(self):
        """Inputs without derivatives are refused with the key and the remedy."""
        groups = {"conditions": conditions(random.Random(3), False, True), "grid": {"cells_x": 48, "cells_y": 48}}
        waves = {"orientation": "transverse", "wavelength_over_a": 1}
        for more, words in (({"waviness": waves}, ("sensitivities", "harmonic")),
                            ({"heat": HEAT, "lubricant": {"temperature_k": 333}}, ("sensitivities", "temperatures", "&heat")),
                            ({"dynamics": {"end_time": 1}}, ("sensitivities", "end_time")),
                            ({"waviness": {**waves, "orientation": "longitudinal"}}, ("sensitivities", "harmonic"))):
            with self.assertRaises(AssertionError) as refused:
                solve(**groups, **more, output={"sensitivities": True})
            for word in words:
                self.assertIn(word, str(refused.exception).rsplit("ehlwave-case:", 1)[-1])


if __name__ == "__main__":
    unittest.main()
