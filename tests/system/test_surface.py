"""A measured surface in the full simulation: reading, refusals, computation and output."""

import errno
import math
import os
import unittest
from pathlib import Path
from unittest import mock

from ehlwave_program import FolderTest, last_line, namelist, run
from hdf5_reading import h5py, read

CONTACT = {"radius_x_m": 12.52e-3, "radius_y_m": 12.52e-3, "reduced_modulus_pa": 1.17e11, "load_n": 39.2,
           "mean_speed_m_per_s": 0.024, "viscosity_pa_s": 1.22}
GRID = {"cells_x": 64, "cells_y": 64}
STEP = 8e-6                        # m; a is 184.6 um
POINTS = 97


def hump(r):
    return math.cos(0.5*math.pi*r)**4 if abs(r) < 1 else 0.0


def ridge():
    """A ridge of 20 nm in the middle, half as wide as the contact is long."""
    return [20e-9*hump((i - POINTS//2)*STEP/90e-6) for i in range(POINTS)]


def rough_map():
    """A map of 33 x 33 points with waves of 110 to 180 um, faded at its ends."""
    waves = [(1, 1, 0.3), (1, 2, 1.7), (2, 1, 4.0)]
    n = 33

    def height(i, j):
        fade = math.prod(math.sin(math.pi*k/(n - 1))**2 for k in (i, j))
        return 35e-9*fade*sum(math.cos(2*math.pi*(kx*i + ky*j)/n + phase) for kx, ky, phase in waves)

    return [[height(i, j) for i in range(n)] for j in range(n)]


class Surfaces(FolderTest):
    def write(self, heights, **replaced):
        """Surface file of rows of constant y."""
        arrays = {"height": heights, "x": [i*STEP for i in range(len(heights[0]))],
                  "y": [(j - (len(heights) - 1)/2)*STEP for j in range(len(heights))], **replaced}
        with h5py.File(self.folder/"s.h5", "w") as file:
            for name, values in arrays.items():
                if values is not None:
                    file[name] = values

    def run_case(self, *arguments, **groups):
        inputs = {"conditions": CONTACT, "surface": {"file": "s.h5"}, "grid": GRID, **groups}
        Path(self.folder, "case.nml").write_text(namelist({name: keys for name, keys in inputs.items() if keys}))
        return run("case", "case.nml", *arguments, folder=self.folder)

    @unittest.skipUnless(os.environ.get("EHLWAVE_FAULTS"), "no library to preload")
    def test_a_file_system_that_refuses_locks(self):
        """A surface is read as elsewhere; only a lock that somebody holds counts."""
        self.write([ridge()])
        for error in (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP, errno.EINVAL):
            refused = {"LD_PRELOAD": os.environ["EHLWAVE_FAULTS"], "EHLWAVE_FAULT": f"lock 1 {error} 1000000 s.h5"}
            with mock.patch.dict(os.environ, refused):
                self.check_status(self.run_case("--plan"))

    def test_files_that_another_program_holds(self):
        """A surface that is being written is refused with the way out; results that somebody has open are replaced."""
        self.write([ridge()])
        with h5py.File(self.folder/"s.h5", "r+"):
            held = self.run_case("--plan")
            with mock.patch.dict(os.environ, {"HDF5_USE_FILE_LOCKING": "FALSE"}):
                free = self.run_case("--plan")
        self.check_status(held, 2)
        self.assertRegex(held.stderr, r"&surface file = 's.h5': another program holds it open for writing[^\n]*HDF5_USE_FILE_LOCKING")
        self.check_status(free)
        with h5py.File(self.folder/"s.h5", "r"):
            self.check_status(self.run_case("--plan"))
        smooth = {"conditions": CONTACT, "surface": None, "grid": {"cells_x": 32, "cells_y": 32}}
        self.assertIn(self.run_case("--output", "r.h5", **smooth).returncode, (0, 1))
        before = (self.folder/"r.h5").stat().st_ino
        with h5py.File(self.folder/"r.h5", "r+"):
            again = self.run_case("--output", "r.h5", **smooth)
        self.assertIn(again.returncode, (0, 1), again.stderr)
        self.assertNotEqual((self.folder/"r.h5").stat().st_ino, before)

    def test_ridge_passes_the_centre(self):
        self.write([ridge()])
        outcome = self.run_case("--json", "--output", "out.h5")
        self.check_status(outcome)
        result = last_line(outcome)
        self.assertEqual(result["surface_file"], "s.h5")
        self.assertIn("97 x 1 points", outcome.stdout)
        attributes, data = read(self.folder/"out.h5")
        self.assertIn("file = 's.h5'", attributes["effective_input"])
        x, film, unit = data["surface_position_m"], data["film_at_centre"], float(data["hertz_approach_c_m"])
        # the leading end is at x_min at T = 0, the trailing end at the centre in the end
        self.assertAlmostEqual(x[0], (POINTS - 1)*STEP + 2.5*184.614e-6, delta=1e-9)
        self.assertTrue(-0.07*184.6e-6 <= x[-1] <= 1e-12)
        thinner = (result["central_film"] - film)*unit
        lowest = thinner.argmax()
        # the film is thinner where the ridge is: by part of its height, at most a quarter of a behind it
        self.assertTrue(6e-9 < thinner[lowest] < 14e-9, thinner[lowest])
        self.assertTrue(-50e-6 < x[lowest] - POINTS//2*STEP < 25e-6, x[lowest])
        # before it arrives nothing has happened
        self.assertLess(abs(thinner[0]), 1e-12)

    def test_map_that_does_not_vary_along_y_is_a_trace_on_the_whole_domain(self):
        self.write([ridge()])
        trace = last_line(self.run_case("--json", "--quiet"))
        # 1e-9 of unevenness forbids the half domain and changes nothing else
        rows = [[z*(1 + 1e-9*(j > 60)) for z in ridge()] for j in range(97)]
        self.write(rows)
        outcome = self.run_case("--json", "--quiet")
        whole = last_line(outcome)
        self.assertIn("(whole)", outcome.stdout)
        self.assertEqual(trace["time_steps"], whole["time_steps"])
        self.assertAlmostEqual(trace["mean_film"]/whole["mean_film"], 1, delta=1e-5)

    def test_map_with_an_accuracy(self):
        """The plan follows a map on few cells; films are within the accuracy of twice the cells and half the step."""
        self.write(rough_map())
        found = last_line(self.run_case("--json", "--quiet", "--output", "found.h5", grid=None, solver={"accuracy": 0.02}))
        self.assertEqual(found["status"], "converged")
        self.assertLessEqual(found["cells_x"], 64)
        self.assertLess(found["total_work_units"], 4000)
        fine = {"cells_x": 2*found["cells_x"], "cells_y": 2*found["cells_y"]}
        self.check_status(self.run_case("--quiet", "--output", "fine.h5", grid=fine, solver={"scheme": "fitted"}))
        films = [read(self.folder/name)[1]["film_at_centre"] for name in ("found.h5", "fine.h5")]
        skip = round((len(films[1]) - 1)/(len(films[0]) - 1))
        pairs = list(zip(films[0], films[1][::skip], strict=False))
        rms = math.sqrt(sum((a/b - 1)**2 for a, b in pairs)/len(pairs))
        self.assertTrue(1e-4 < rms < 0.01, rms)
        self.assertGreater(max(films[1])/min(films[1]), 1.1)

    def test_grid_is_refined_before_the_march(self):
        """The smooth film decides how fine the grid must be, so no march is repeated."""
        self.write(rough_map())
        inputs = {"grid": None, "solver": {"accuracy": 0.01}, "dynamics": {"end_time": 0.3}}
        plan = last_line(self.run_case("--plan", "--json", **inputs))
        found = last_line(self.run_case("--json", "--quiet", **inputs))
        self.assertEqual((found["status"], found["refinements"]), ("converged", 0))
        self.assertGreater(found["cells_x"], plan["cells_x"])
        self.assertLessEqual(found["error_estimate"], 0.01)
        self.assertGreater(found["total_work_units"], found["counted_work_units"])

    def test_default_accuracy(self):
        """Maps have an accuracy by default; given cells are kept without it."""
        self.write(rough_map())
        free = self.run_case("--plan", grid=None)
        self.assertIn("fitted scheme", free.stdout)
        self.assertRegex(free.stdout, r"X: for an accuracy of 0\.0034")
        self.assertNotIn("fitted scheme", self.run_case("--plan").stdout)

    def test_end_time_and_slip(self):
        self.write([ridge()])
        plan = last_line(self.run_case("--plan", "--json"))
        length = (POINTS - 1)*STEP/184.614e-6
        self.assertAlmostEqual(plan["time_steps"]/16, 2.5 + length, delta=1/16)
        plan = last_line(self.run_case("--plan", "--json", conditions={**CONTACT, "slip_parameter": 2.0}))
        self.assertAlmostEqual(plan["time_steps"]/16, (2.5 + length)/2, delta=1/16)
        plan = last_line(self.run_case("--plan", "--json", dynamics={"end_time": 1.0}))
        self.assertEqual(plan["time_steps"], 16)

    def assert_refused(self, message, **groups):
        outcome = self.run_case("--plan", **groups)
        self.check_status(outcome, 2)
        self.assertIn(message, outcome.stderr)

    def test_bad_surfaces_are_refused(self):
        self.assert_refused("No such file")
        (self.folder/"s.h5").write_text("nonsense")
        self.assert_refused("is not an HDF5 file")
        self.write([ridge()], x=None)
        self.assert_refused("needs height over (y, x), and x and y")
        self.write([ridge()], x=list(range(5)))
        self.assert_refused("do not have the numbers of points")
        self.write([ridge()], x=[i**1.01*STEP for i in range(POINTS)])
        self.assert_refused("x does not increase by equal steps")
        self.write([[*ridge()[:-1], 20e-9]])
        self.assert_refused("would enter the contact as a step")
        self.write([[*ridge()[:40], math.nan, *ridge()[41:]]])
        self.assert_refused("missing (NaN)")
        self.write([ridge()]*9)
        self.assert_refused("would enter the contact as a step")

    def test_contradictions_are_refused(self):
        self.write([ridge()])
        self.assert_refused("holds metres",
                            conditions={"load_parameter_m": 100, "lubricant_parameter_l": 10, "radius_ratio_d": 1})
        self.assert_refused("give one of the two", waviness={"orientation": "transverse", "wavelength_over_a": 0.5})
        self.assert_refused("remove &surface or set response to 'transient'", waviness={"response": "harmonic"})
        self.assert_refused("slip_parameter = 0", conditions={**CONTACT, "slip_parameter": 0})


if __name__ == "__main__":
    unittest.main()
