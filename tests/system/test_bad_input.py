"""Refusals of ehlwave-case: exit status 2, a message that names the key, nothing written."""

import copy
import unittest
from pathlib import Path

from ehlwave_program import FolderTest, namelist, run

GOOD = {"conditions": {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1},
        "waviness": {"orientation": "transverse", "wavelength_over_a": 0.5},
        "grid": {"cells_x": 32, "cells_y": 32}}


class Raw(str):
    """Written as it is, without quotes."""

    def __repr__(self):
        return str(self)


REMOVED = object()

# case, group, key, value, needle
CHANGES = [
    ("unknown key", "conditions", "load_paramter_m", 3, "load_paramter_m"),
    ("unknown group", "mesh", "cells", 3, "mesh"),
    ("missing key", "conditions", "radius_ratio_d", REMOVED, "radius_ratio_d"),
    ("missing number", "conditions", "load_parameter_m", Raw(""), "load_parameter_m"),
    ("NaN", "conditions", "load_parameter_m", Raw("NaN"), "load_parameter_m"),
    ("infinity", "conditions", "load_parameter_m", Raw("1e999"), "load_parameter_m"),
    ("negative", "conditions", "load_parameter_m", -5, "load_parameter_m"),
    ("beyond the model", "conditions", "load_parameter_m", 1e9, "give load_parameter_m of at most 1.47e6"),
    ("beyond numbers", "conditions", "load_parameter_m", Raw("1e-300"), "give a larger load_parameter_m"),
    ("zero", "conditions", "load_parameter_m", 0, "load_parameter_m"),
    ("negative L", "conditions", "lubricant_parameter_l", -1, "lubricant_parameter_l"),
    ("D too large", "conditions", "radius_ratio_d", 1.01, "radius_ratio_d"),
    ("D too small", "conditions", "radius_ratio_d", 0.001, "radius_ratio_d"),
    ("list for one value", "conditions", "load_parameter_m", Raw("100, 200"), "load_parameter_m"),
    ("text for a number", "conditions", "load_parameter_m", Raw("'high'"), "load_parameter_m"),
    ("slip above 2", "conditions", "slip_parameter", 2.1, "slip_parameter"),
    ("two ways to give conditions", "conditions", "load_n", 10, "load_parameter_m"),
    ("odd cells", "grid", "cells_x", 33, "cells_x"),
    ("few cells", "grid", "cells_y", 8, "cells_y"),
    ("eight cells", "grid", "cells_x", 8, "an even number from 16 to 8192"),
    ("many cells", "grid", "cells_x", 10000, "cells_x"),
    ("fraction of a cell", "grid", "cells_x", 64.5, "cells_x"),
    ("inlet inside the contact", "grid", "x_min", -0.5, "x_min"),
    ("unknown orientation", "waviness", "orientation", "traverse", "orientation"),
    ("orientation without quotes", "waviness", "orientation", Raw("transverse"), "orientation"),
    ("wavelength of a smooth surface", "waviness", "orientation", "none", "wavelength"),
    ("missing wavelength", "waviness", "wavelength_over_a", REMOVED, "wavelength_over_a"),
    ("zero wavelength", "waviness", "wavelength_over_a", 0, "wavelength_over_a"),
    ("wavelengths of a custom pattern", "waviness", "wavelength_y_over_a", 1, "wavelength_y_over_a"),
    ("oblique without custom", "waviness", "oblique", True, "oblique"),
    ("amplitude above the film", "waviness", "amplitude_over_film", 1.5, "amplitude_over_film"),
    ("custom without its wavelengths", "waviness", "orientation", "custom", "wavelength_x_over_a"),
    ("time step off the characteristics", "solver", "time_step_over_cell", 1.5, "time_step_over_cell"),
    ("no tolerance", "solver", "tolerance", 0, "tolerance"),
    ("no steps", "solver", "largest_steps", 0, "largest_steps"),
    ("unknown method", "solver", "method", "picard", "method"),
    ("unknown scheme", "solver", "scheme", "upwind", "scheme"),
    ("cycle of another method", "solver", "cycle", "w", "cycle"),
    ("modulus in GPa", "conditions", "reduced_modulus_pa", 226, "in Pa, at least"),
    ("no conduction", "heat", "oil_conductivity_w_per_m_k", 0, "0 is out of range"),
    ("no data of heat", "heat", "oil_conductivity_w_per_m_k", Raw(""), "oil_conductivity_w_per_m_k"),
    ("missing frequency", "dynamics", "load_balance", "equation_of_motion", "natural_frequency"),
    ("frequency of a force balance", "dynamics", "natural_frequency", 5, "natural_frequency"),
    ("unknown law", "lubricant", "viscosity_law", "eyring", "viscosity_law"),
    ("no alpha", "lubricant", "pressure_viscosity_per_pa", 0, "pressure_viscosity_per_pa"),
    ("not a logical", "output", "fields", 3, "fields"),
]


# group, key, value, needle: refusals of line contacts
LINE = {"conditions": {"load_parameter_m": 100, "lubricant_parameter_l": 11, "radius_ratio_d": 0},
        "waviness": {"orientation": "transverse", "wavelength_over_a": 0.5}, "grid": {"cells_x": 128}}
LINE_CHANGES = [
    ("waviness", "orientation", "isotropic", "orientation"),
    ("waviness", "orientation", "longitudinal", "orientation"),
    ("grid", "cells_y", 128, "cells_y"),
    ("grid", "y_max", 2, "y_max"),
    ("grid", "domain", "whole", "domain"),
    ("solver", "method", "fas", "method"),
    ("solver", "deformation", "mlmi", "deformation"),
    ("dynamics", "load_balance", "equation_of_motion", "load_balance"),
]

# conditions, waviness, waviness2, needle: pairs of rough surfaces
WAVES = {"orientation": "transverse", "wavelength_over_a": 1}
RIDGES = {"orientation": "longitudinal", "wavelength_over_a": 1}
PAIRS = [
    ({}, {"orientation": "none"}, WAVES, "without &waviness or &surface"),
    ({}, WAVES, {**WAVES, "wavelength_over_a_2": 2}, "'wavelength_over_a' in &waviness2: is the same key as wavelength_over_a_2"),
    ({}, WAVES, {**WAVES, "response": "harmonic"}, "unknown key 'response' in &waviness2: it belongs to &waviness, move it there"),
    ({}, WAVES, {"orientation_2": "isotropic"}, "&waviness2 wavelength_over_a is missing"),
    ({}, WAVES, RIDGES, "stands still"),
    ({}, RIDGES, WAVES, "stands still"),
    ({"slip_parameter": 2}, WAVES, WAVES, "stands still"),
    ({"slip_parameter": 1.3}, {**WAVES, "response": "periodic"}, {**WAVES, "wavelength_over_a": 0.83}, "no ratio of whole numbers"),
]


# waviness, groups, needle: keys without effect
SWINGS = {"load_balance": "equation_of_motion", "natural_frequency": 4}
IDLE = [
    ({}, {"dynamics": {"load_factor": 1.2}}, "&dynamics load_factor = 1.2 belongs to marches in time"),
    (RIDGES, {"dynamics": {"load_factor": 1.2}}, "&dynamics load_factor = 1.2 belongs to marches in time"),
    ({}, {"dynamics": SWINGS}, "&dynamics load_balance = 'equation_of_motion' belongs to marches in time"),
    ({**RIDGES, "response": "harmonic"}, {"dynamics": SWINGS}, "load_balance = 'equation_of_motion' belongs to"),
    ({"response": "harmonic"}, {}, "&waviness response = 'harmonic' belongs to waves"),
    ({}, {"lubricant": {"viscosity_law": "barus", "roelands_index": 0.6}}, "roelands_index = 0.6 belongs to viscosity_law = 'roelands'"),
    ({"amplitude_over_film": 0.1}, {}, "&waviness amplitude_over_film = 0.1 belongs to waves"),
    (WAVES, {"waviness2": {"amplitude_over_film": 0.1}}, "amplitude_over_film_2 = 0.1 belongs to waves"),
    (WAVES, {"heat": {"levels": 8}}, "&heat levels = 8 belongs to &heat with the data of the oil"),
    (WAVES, {"heat": {"body_conductivity_w_per_m_k": 21}}, "body_conductivity_w_per_m_k = 21 belongs to &heat with the data"),
]

# waviness, settings of the solution that have no effect
SETTINGS = [
    ({}, {"step_tolerance": 1e-3, "settling_periods": 2, "time_step_over_cell": 0.5, "response_tolerance": 1e-4,
          "error_estimate": "model"}),
    (RIDGES, {"step_tolerance": 1e-3, "settling_periods": 2, "time_step_over_cell": 0.5}),
    ({**WAVES, "response": "harmonic"}, {"step_tolerance": 1e-3, "settling_periods": 2, "time_step_over_cell": 0.5, "error_estimate": "model"}),
    (WAVES, {"response_tolerance": 1e-4}),
]


class BadInput(FolderTest):
    def write(self, name, content):
        mode = "wb" if isinstance(content, bytes) else "w"
        with Path(self.folder, name).open(mode) as file:
            file.write(content)

    def refuse(self, needle, *arguments):
        """Exit status 2, a line that begins with the program and holds the needle, no new files."""
        before = sorted(self.folder.iterdir())
        outcome = run("case", *arguments, folder=self.folder)
        self.check_status(outcome, 2)
        self.assertTrue(outcome.stderr.startswith("ehlwave-case: "), outcome.stderr)
        self.assertEqual(outcome.stderr.count("\n"), 1, outcome.stderr)
        self.assertIn(needle, outcome.stderr)
        self.assertEqual(outcome.stdout, "")
        self.assertEqual(sorted(self.folder.iterdir()), before)

    def test_good_input_is_good(self):
        self.write("case.nml", namelist(GOOD))
        self.assertEqual(run("case", "case.nml", "--plan", folder=self.folder).returncode, 0)

    def test_values(self):
        for what, group, key, value, needle in CHANGES:
            with self.subTest(what=what):
                groups = copy.deepcopy(GOOD)
                keys = groups.setdefault(group, {})
                if value is REMOVED:
                    del keys[key]
                else:
                    keys[key] = value
                text = namelist(groups)
                if isinstance(value, Raw):
                    text = text.replace(f"{key} = '{value}'", f"{key} = {value}")
                self.write("case.nml", text)
                self.refuse(needle, "case.nml", "--output", "case.h5")

    def test_keys_without_effect(self):
        """Keys of results are refused; unused settings are reported."""
        for waviness, groups, needle in IDLE:
            with self.subTest(needle=needle):
                self.write("case.nml", namelist({**GOOD, "waviness": waviness, **groups}))
                self.refuse(needle, "case.nml")
        for waviness, settings in SETTINGS:
            plans = []
            for solver in {}, settings:
                self.write("case.nml", namelist({**GOOD, "waviness": waviness, "solver": solver}))
                plans.append(run("case", "case.nml", "--plan", "--json", folder=self.folder).stdout)
            self.assertNotIn("No effect", plans[0])
            told = next(line for line in plans[1].split("\n") if line.startswith("No effect"))
            self.assertEqual([key for key in settings if f"&solver {key} = " not in told], [])

    def test_fitted_scheme(self):
        """It is written for flooded contacts."""
        groups = {**GOOD, "inlet": {"oil_over_flooded": 0.8}}
        self.write("case.nml", namelist(groups))
        self.assertEqual(run("case", "case.nml", "--plan", folder=self.folder).returncode, 0)
        self.write("case.nml", namelist({**groups, "solver": {"scheme": "fitted"}}))
        self.refuse("&solver scheme = 'fitted'", "case.nml")

    def test_pairs_of_surfaces(self):
        for conditions, first, second, needle in PAIRS:
            with self.subTest(needle=needle):
                groups = {**GOOD, "conditions": {**GOOD["conditions"], **conditions}, "waviness": first, "waviness2": second}
                self.write("case.nml", namelist(groups))
                self.refuse(needle, "case.nml")

    def test_line_contact(self):
        self.write("case.nml", namelist(LINE))
        self.assertEqual(run("case", "case.nml", "--plan", folder=self.folder).returncode, 0)
        for group, key, value, needle in LINE_CHANGES:
            with self.subTest(key=key, value=value):
                groups = copy.deepcopy(LINE)
                groups.setdefault(group, {})[key] = value
                self.write("case.nml", namelist(groups))
                self.refuse(needle, "case.nml")
                self.assertIn("line contact", run("case", "case.nml", folder=self.folder).stderr)

    def test_line_contact_with_custom_waves(self):
        groups = copy.deepcopy(LINE)
        groups["waviness"] = {"orientation": "custom", "wavelength_x_over_a": 1, "wavelength_y_over_a": 1}
        self.write("case.nml", namelist(groups))
        self.refuse("wavelength_y_over_a", "case.nml")

    def test_key_given_twice(self):
        self.write("case.nml", namelist(GOOD).replace("cells_x = 32", "cells_x = 32\n  cells_x = 64"))
        self.refuse("cells_x", "case.nml")

    def test_line_of_a_mistake(self):
        self.write("case.nml", namelist(GOOD).replace("cells_x = 32", "cells_q = 32"))
        line = namelist(GOOD).split("\n").index("  cells_x = 32") + 1
        self.refuse(f"case.nml:{line}:", "case.nml")

    def test_group_without_end(self):
        self.write("case.nml", namelist(GOOD).rstrip().rstrip("/"))
        self.refuse("grid", "case.nml")

    def test_files(self):
        self.refuse("missing.nml", "missing.nml")
        Path(self.folder, "folder.nml").mkdir()
        self.refuse("folder.nml", "folder.nml")
        self.write("empty.nml", "")
        self.refuse("empty.nml", "empty.nml")
        self.write("binary.nml", b"\x89HDF\r\n\x1a\n\x00\x00\x00")
        self.refuse("binary.nml", "binary.nml")

    def test_arguments(self):
        self.write("case.nml", namelist(GOOD))
        self.refuse("input file")
        self.refuse("input file", "case.nml", "case.nml")
        self.refuse("--plna", "case.nml", "--plna")
        self.refuse("--output", "case.nml", "--output")
        self.refuse("--output", "case.nml", "--output=")
        self.refuse("--json", "case.nml", "--json", "--json")
        self.refuse("--json=1", "case.nml", "--json=1")

    def test_output_that_cannot_be_written(self):
        self.write("case.nml", namelist(GOOD))
        self.refuse("no/such/folder/case.h5", "case.nml", "--output", "no/such/folder/case.h5")

    def test_output_that_is_a_folder(self):
        self.write("case.nml", namelist(GOOD))
        Path(self.folder, "results.h5").mkdir()
        self.refuse("results.h5", "case.nml", "--output", "results.h5", "--quiet")


if __name__ == "__main__":
    unittest.main()
