"""Files with linear responses: fields of a case, and rows of a sweep whatever the number of ranks."""

import unittest

from ehlwave_program import FolderTest, namelist, run
from hdf5_reading import read

CONTACT = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
GRID = {"cells_x": 32, "cells_y": 32}
EFFORT = {"seconds", "work_units", "harmonic_work_units", "peak_memory_mib", "rank"}   # may differ from run to run


class ResponseFiles(FolderTest):
    def test_fields(self):
        case, output = self.folder/"case.nml", self.folder/"case.h5"
        case.write_text(namelist({"conditions": CONTACT, "grid": GRID, "waviness": {
            "orientation": "transverse", "wavelength_over_a": 1, "response": "harmonic"}}))
        outcome = run("case", case, "--output", output)
        self.check_status(outcome)
        _, data = read(output)
        x, y = data["x"].tolist().index(0), data["y"].tolist().index(0)
        where = (x, y) if data["film_response"].shape[0] == len(data["x"]) else (y, x)
        self.check_close(data["film_response"][where], float(data["harmonic_ratio"]), 1e-12, "film at the centre")
        self.assertAlmostEqual(data["film_phase"][where], float(data["harmonic_phase"]), delta=1e-12)
        self.assertGreater(data["pressure_response"].max(), 0)
        self.assertEqual(data["pressure_phase"].shape, data["pressure"].shape)

    def sweep(self, ranks):
        path, output = self.folder/"sweep.nml", self.folder/f"r{ranks}.h5"
        path.write_text(namelist({"sweep": {
            "load_parameter_m": [50, 100], "lubricant_parameter_l": 12.05, "radius_ratio_d": [1, 0.35],
            "orientation": ["transverse", "isotropic", "longitudinal"], "wavelength_over_a": [1, 2]},
            "waviness": {"response": "harmonic"}, "grid": GRID}))
        outcome = run("sweep", path, "--output", output, ranks=ranks)
        self.check_status(outcome)
        return read(output)[1]

    def test_numbers_do_not_depend_on_ranks(self):
        """Each rank shares steady states between the cases it happens to get; a case alone has its own."""
        one, three = self.sweep(1), self.sweep(3)
        self.assertEqual(len(one["case"]), 24)
        compared = 0
        for name, values in one.items():
            if getattr(values, "dtype", None) is not None and values.dtype.kind in "fi" and name not in EFFORT:
                self.assertTrue(((values == three[name]) | ((values != values) & (three[name] != three[name]))).all(), name)
                compared += 1
        self.assertGreater(compared, 30)
        self.assertTrue((one["harmonic_ratio"] > 0).all())
        for case in (0, 13):
            path, output = self.folder/"one.nml", self.folder/f"one{case}.h5"
            path.write_text(one["effective_input"][case])
            self.assertEqual(run("case", path, "--output", output).returncode, 0)
            self.assertEqual(float(read(output)[1]["harmonic_ratio"]), one["harmonic_ratio"][case])


if __name__ == "__main__":
    unittest.main()
