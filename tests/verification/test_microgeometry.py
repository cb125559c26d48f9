"""Roughness predicted by a harmonic table against the full transient, on a coarse grid.

scripts/study microgeometry does the same for four surfaces at two conditions on finer grids.
"""

import sys
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import SKIPPED, run

try:
    import numpy as np
    from ehlwave.surface import read_table, trace_surface
    from studies.microgeometry.compare import compare_speeds
    from studies.microgeometry.traces import compare_traces, write_traces
    from studies.microgeometry.simulate import conditions_at, table_file, write_surface, write_tables, write_waves
except ImportError as error:
    print(f"SKIPPED: ehlwave cannot be imported ({error})")
    sys.exit(SKIPPED)

SPEEDS = (0.024,)
CELLS = 64
WAVES = (0.5, 0.8, 1.3, 2.1, 3.4)


class Microgeometry(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.sweep(write_waves(cls.folder, CELLS, SPEEDS, ratios=(0.0,), waves=WAVES))
        write_tables(cls.folder, SPEEDS)

    @staticmethod
    def sweep(path):
        outcome = run("sweep", path)
        if outcome.returncode != 0:
            raise AssertionError(outcome.stdout + outcome.stderr)

    def compare(self, name, heights, step):
        surface = trace_surface(heights, step, name=name)
        self.sweep(write_surface(self.folder, surface, CELLS, SPEEDS))
        return compare_speeds(self.folder, surface, self.folder, SPEEDS)[0]

    def test_superposition_of_the_table_is_the_simulated_roughness(self):
        a = conditions_at(*SPEEDS).semi_axis_a_m
        step = a/32
        x = np.arange(193)*step
        waves = [(0.6, 12e-9, 0.3), (0.9, 15e-9, 2.0), (1.7, 15e-9, 4.0)]
        rough = sum(height*np.cos(2*np.pi*x/(wave*a) + phase) for wave, height, phase in waves)
        ridge = 40e-9*np.exp(-((x - x[-1]/2)/(0.3*a))**2)
        for name, heights, amplitude in (("rough", rough, 0.15), ("ridge", ridge, 0.17)):
            found = self.compare(name, heights, step)
            self.assertAlmostEqual(found.amplitude_over_film, amplitude, delta=0.04)
            self.assertLess(found.error("table"), 0.10, name)
            # the formula has amplitudes only, and its error is mostly the phase it does not have
            self.assertGreater(found.error("formula"), 2*found.error("table"), name)

    def test_the_lambda_ratio_in_one_call_is_the_simulated_one(self):
        self.sweep(write_traces(self.folder, CELLS, ("measured",), ("ball",), points_per_a=24))
        found, = compare_traces(self.folder, points_per_a=24)
        self.assertAlmostEqual(found.rq_over_simulated, 1, delta=0.05, msg=found)
        self.assertLess(abs(found.error), 0.05, found)
        self.assertGreater(abs(found.by_formula/found.at_mesh_zero - 1), abs(found.error), found)

    def test_table_has_the_amplitudes_of_the_paper_and_the_lag_of_the_film(self):
        table = read_table(table_file(self.folder, *SPEEDS))
        self.assertEqual(len(table), len(WAVES))
        amplitude = np.hypot(table["transfer_real"], table["transfer_imag"])
        self.assertTrue((np.diff(amplitude) < 0).all(), amplitude)
        self.assertTrue((table["transfer_imag"] > 0).all())


if __name__ == "__main__":
    unittest.main()
