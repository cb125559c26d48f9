"""The HDF5 file of a case: fields looked up by coordinates, history, and an input that repeats the run."""

import math
import unittest
from pathlib import Path

from ehlwave_program import FolderTest, last_line, namelist, run
from hdf5_reading import dimensions, read

CONDITIONS = {"load_parameter_m": 200, "lubricant_parameter_l": 12.05, "radius_ratio_d": 0.35}


class CaseFile(FolderTest):
    def run_case(self, text, output="case.h5"):
        Path(self.folder, "case.nml").write_text(text)
        outcome = run("case", "case.nml", "--json", "--quiet", "--output", output, folder=self.folder)
        self.check_status(outcome)
        self.assertEqual(list(self.folder.glob("*.part*")), [])
        return last_line(outcome), *read(self.folder / output)

    def test_smooth_fields(self):
        for domain, lowest in [("auto", 0), ("whole", -2)]:
            groups = {"conditions": CONDITIONS, "grid": {"cells_x": 64, "cells_y": 48, "domain": domain}}
            result, attributes, data = self.run_case(namelist(groups))
            self.assertEqual(attributes["status"], "converged")
            self.assertEqual(attributes["case_id"], result["case_id"])
            self.assertEqual(dimensions(self.folder / "case.h5", "film"), ["y", "x"])
            x, y = list(data["x"]), list(data["y"])
            self.assertEqual((x[0], x[-1], y[0], y[-1]), (-2.5, 1.5, lowest, 2))
            self.assertEqual(data["film"][y.index(0), x.index(0)], result["central_film"])
            self.assertEqual(data["film"].min(), result["minimum_film"])
            self.assertEqual(data["pressure"].max(), result["max_pressure"])
            self.assertEqual(abs(data["pressure"][:, -1]).max(), 0)
            self.assertGreater(data["pressure"][y.index(0), 0], 0)    # the edges are flooded
            self.assertEqual(float(data["central_film"]), result["central_film"])
            for name in ["central_film_error", "minimum_film_error"]:
                self.assertTrue(0 < result[name] < 0.5, result[name])
                self.assertEqual(float(data[name]), result[name])
            # the pressure spike is towards the outlet, the constriction behind the centre
            where = data["film"].argmin()
            self.assertGreater(x[where % len(x)], 0)

    def test_fields_over_time(self):
        groups = {"conditions": {"radius_x_m": 0.0125, "radius_y_m": 0.0125, "reduced_modulus_pa": 2.26e11, "load_n": 20,
                                 "mean_speed_m_per_s": 0.5, "viscosity_pa_s": 0.1, "slip_parameter": 1.2},
                  "grid": {"cells_x": 32, "cells_y": 32}, "dynamics": {"end_time": 2.5},
                  "waviness": {"orientation": "transverse", "wavelength_over_a": 1}}
        _, _, last = self.run_case(namelist(groups))
        self.assertNotIn("field_time", last)
        result, _, data = self.run_case(namelist(groups | {"output": {"fields_every": 6}}))
        self.assertEqual(result["time_steps"], 20)
        self.assertEqual(list(data["field_time"]), list(data["time"][::6]))
        names = ["pressure_over_time", "film_over_time", "mean_shear_stress_over_time_pa"]
        for name in names:
            self.assertEqual(dimensions(self.folder/"case.h5", name), ["field_time", "y", "x"])
        x, y = list(data["x"]), list(data["y"])
        centre = data["film_over_time"][:, y.index(0), x.index(0)]
        self.assertEqual(list(centre), list(data["film_at_centre"][::6]))
        # cases without these keys get the same numbers
        for name in ["pressure", "film", "film_at_centre"]:
            self.assertEqual(abs(data[name] - last[name]).max(), 0)
        # with steps up to the end the last set is the last solution
        _, _, every = self.run_case(namelist(groups | {"output": {"fields_every": 5}}))
        for name, over in zip(["pressure", "film", "mean_shear_stress_pa"], names, strict=True):
            self.assertEqual(abs(every[over][-1] - every[name]).max(), 0)

    def test_fields_over_time_of_a_case_without_steps(self):
        for waviness in [{"orientation": "none"}, {"orientation": "longitudinal", "wavelength_over_a": 1},
                         {"orientation": "transverse", "wavelength_over_a": 1, "response": "harmonic"},
                         {"orientation": "transverse", "wavelength_over_a": 1, "response": "periodic"}]:
            groups = {"conditions": CONDITIONS, "waviness": waviness, "output": {"fields_every": 2}}
            Path(self.folder, "case.nml").write_text(namelist(groups))
            outcome = run("case", "case.nml", "--plan", folder=self.folder)
            self.check_status(outcome, 2)
            self.assertIn("fields_every = 2", outcome.stderr)

    def test_history(self):
        groups = {"conditions": CONDITIONS, "grid": {"cells_x": 64, "cells_y": 48},
                  "waviness": {"orientation": "transverse", "wavelength_over_a": 1}}
        result, _, data = self.run_case(namelist(groups))
        self.assertEqual(len(data["time"]), result["time_steps"] + 1)
        self.assertEqual(dimensions(self.folder / "case.h5", "film_at_centre"), ["time"])
        self.assertEqual((data["time"][0], data["time"][-1]), (0, 5.5))
        self.assertEqual(data["film_at_centre"][0], result["central_film"])
        measured = data["film_at_centre"][data["time"] >= 4.5 - 1e-9]
        ratio = (measured.max() - measured.min())/2/(0.2*result["central_film"])
        self.assertAlmostEqual(ratio, result["amplitude_ratio"], delta=1e-12)
        x, y = list(data["x"]), list(data["y"])
        self.assertEqual(data["film"][y.index(0), x.index(0)], data["film_at_centre"][-1])

    def test_effective_input_repeats_the_run(self):
        for waviness in [{"orientation": "isotropic", "wavelength_over_a": 1/3},
                         {"orientation": "longitudinal", "wavelength_over_a": 0.7},
                         {"orientation": "custom", "wavelength_x_over_a": 0.6, "wavelength_y_over_a": 0.9, "oblique": True}]:
            with self.subTest(orientation=waviness["orientation"]):
                groups = {"conditions": {**CONDITIONS, "slip_parameter": 1.1}, "grid": {"cells_x": 32, "cells_y": 32},
                          "waviness": waviness}
                first, attributes, data = self.run_case(namelist(groups), "first.h5")
                second, _, again = self.run_case(attributes["effective_input"], "second.h5")
                for effort in ["seconds", "work_units", "peak_memory_mib"]:
                    del first[effort], second[effort]
                self.assertEqual(first, second)
                self.assertEqual(data["film_at_centre"].tobytes(), again["film_at_centre"].tobytes())
                self.assertEqual(data["film"].tobytes(), again["film"].tobytes())

    def test_dimensional_scales(self):
        groups = {"conditions": {"radius_x_m": 12.52e-3, "radius_y_m": 12.52e-3, "reduced_modulus_pa": 1.17e11,
                                 "load_n": 39.2, "mean_speed_m_per_s": 0.024, "viscosity_pa_s": 1.22},
                  "grid": {"cells_x": 64, "cells_y": 64}}
        result, _, data = self.run_case(namelist(groups))
        self.assertAlmostEqual(float(data["semi_axis_a_m"])*1e3, 0.185, delta=0.001)
        self.assertAlmostEqual(float(data["hertz_approach_c_m"])*result["central_film"]*1e6, result["central_film_um"], delta=1e-9)

    def test_sliding(self):
        """The example of sliding: the stress field adds up to the friction, and the report has both."""
        text = Path(__file__).resolve().parents[2].joinpath("inputs", "sliding.nml").read_text()
        result, _, data = self.run_case(text)
        cell = (data["x"][1] - data["x"][0])*(data["y"][1] - data["y"][0])
        bears = data["pressure"] > 1e-12
        rows = (data["mean_shear_stress_pa"]*bears).sum(axis=1)
        force = cell*(rows[0] + 2*rows[1:].sum())           # half of the domain is kept
        self.assertAlmostEqual(3/(2*math.pi)*force/result["hertz_pressure_pa"], result["friction_coefficient"], delta=1e-12)
        self.assertAlmostEqual(result["friction_coefficient"], 0.0578, delta=2e-4)
        self.assertGreater(result["largest_b"], result["tangent_factor_x"])
        self.assertGreater(result["tangent_factor_x"], result["tangent_factor_y"])
        self.assertIn("would warm by about 17 K", result["warning"])


if __name__ == "__main__":
    unittest.main()
