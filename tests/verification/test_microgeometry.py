"""Deformed roughness, predicted by superposition and by a call of Contact, beside marches on a coarse grid."""

import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

from ehlwave_program import IS_LONG, SKIPPED, run

try:
    import numpy as np
    from ehlwave import Contact
    from ehlwave.results.case_file import read_contact
    from ehlwave.results.points import select_points
    from ehlwave.results.read import read_results
    from ehlwave.surface import FormulaTransfer, TableTransfer, deform_surface, read_surface, read_table, trace_surface
    from ehlwave.surface.harmonics import write_harmonic_table
    from ehlwave.surface.prepare import TAPERED_SHARE, taper
    from studies.sweeps import fields_file, read_sweep, surface_file, write_surface, write_sweep
except ImportError as error:
    print(f"SKIPPED: ehlwave cannot be imported ({error})")
    sys.exit(SKIPPED)

EXPERIMENT = {"radius_x_m": 12.52e-3, "radius_y_m": 12.52e-3, "reduced_modulus_pa": 1.17e11, "load_n": 39.2,
              "viscosity_pa_s": 1.22, "mean_speed_m_per_s": 0.024,
              "pressure_viscosity_per_pa": 2.25e-8, "roelands_index": 0.484}
BALL = {"radius_x_m": 12.5e-3, "radius_y_m": 12.5e-3, "reduced_modulus_pa": 2.2e11, "load_n": 20.0,
        "viscosity_pa_s": 0.1, "mean_speed_m_per_s": 0.5}
SHARED = {"grid": {"cells_x": 64, "cells_y": 64, "edges": "flooded"}, "solver": {"error_estimate": "model"}}
FIELDS = {**SHARED, "output": {"fields": True}}
WAVES = (0.5, 0.8, 1.3, 2.1, 3.4)


def swept(folder, name, rows, groups):
    outcome = run("sweep", write_sweep(folder, name, rows, groups))
    if outcome.returncode != 0:
        raise AssertionError(outcome.stdout + outcome.stderr)
    return read_sweep(folder, name, len(rows))


class Superposition(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.conditions = Contact(**EXPERIMENT).conditions
        waviness = {"orientation": "custom", "response": "harmonic", "wavelength_y_over_a": 0.0, "oblique": False}
        rows = [{"wavelength_x_over_a": wave} for wave in WAVES]
        swept(cls.folder, "waves", [EXPERIMENT | row for row in rows], {**SHARED, "waviness": waviness})
        points = select_points(read_results([cls.folder/"waves.h5"]), include_unresolved=True)
        write_harmonic_table(cls.folder/"harmonics.csv", points)
        cls.table = read_table(cls.folder/"harmonics.csv")

    def errors(self, name, heights, step):
        """Rms errors of table and formula over the undeformed Rq, along y = 0 of the surface without its faded ends."""
        surface = trace_surface(heights, step, name=name)
        keys = {"file": str(write_surface(self.folder, surface).resolve())}
        row, = swept(self.folder, name, [EXPERIMENT], {**FIELDS, "surface": keys})
        moved = read_surface(surface_file(self.folder, surface))
        scale = self.conditions.hertz_approach_c_m
        film_m = row["central_film"]*scale
        known = replace(self.conditions, central_film_m=film_m, film_source="simulated smooth contact")
        table, formula = (deform_surface(moved, known, one, "none", "none")
                          for one in (TableTransfer(known, self.table), FormulaTransfer(known)))
        marched = read_contact(fields_file(self.folder, name, row))
        at_centre, film = marched["surface_position_m"].values, marched["film_at_centre"].values*scale
        positions = np.arange(moved.height.shape[0])*moved.step_x_m
        inside = np.abs(at_centre/positions[-1] - 0.5) <= 0.5 - TAPERED_SHARE
        before, by_table, by_formula = (np.interp(at_centre[inside], positions, one.height[:, one.height.shape[1]//2])
                                        for one in (moved, table, formula))
        # The ends of the surface are faded: the waves inside are higher than the mean over the surface.
        share = np.std(before)/table.statistics.rq_before_m
        by_table = by_table - (table.statistics.mean_rise_m or 0.0)*share**2
        simulated = film_m - film[inside]
        return [np.sqrt(np.mean((one - simulated)**2))/np.std(before) for one in (by_table, by_formula)]

    def test_superposition_of_the_table_is_the_simulated_roughness(self):
        a = self.conditions.semi_axis_a_m
        step = a/32
        x = np.arange(193)*step
        waves = [(0.6, 12e-9, 0.3), (0.9, 15e-9, 2.0), (1.7, 15e-9, 4.0)]
        rough = sum(height*np.cos(2*np.pi*x/(wave*a) + phase) for wave, height, phase in waves)
        ridge = 40e-9*np.exp(-((x - x[-1]/2)/(0.3*a))**2)
        for name, heights in (("rough", rough), ("ridge", ridge))[0 if IS_LONG else 1:]:
            by_table, by_formula = self.errors(name, heights, step)
            self.assertLess(by_table, 0.10, name)
            # The formula has amplitudes only: most of its error is the missing phase.
            self.assertGreater(by_formula, 2*by_table, name)

    def test_table_has_the_amplitudes_of_the_paper_and_the_lag_of_the_film(self):
        self.assertEqual(len(self.table), len(WAVES))
        amplitude = np.hypot(self.table["transfer_real"], self.table["transfer_imag"])
        self.assertTrue((np.diff(amplitude) < 0).all(), amplitude)
        self.assertTrue((self.table["transfer_imag"] > 0).all())


class LambdaRatio(unittest.TestCase):
    def test_the_lambda_ratio_in_one_call_is_the_simulated_one(self):
        contact = Contact(**BALL)
        a, film_m = contact.conditions.semi_axis_a_m, contact.conditions.central_film_m
        heights = self.worn(8, 24)
        heights *= 0.1*film_m/np.sqrt(2)/np.std(heights)
        step = a/24
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            trace = folder/"trace.csv"
            np.savetxt(trace, np.column_stack([1e3*step*np.arange(heights.size), 1e6*heights]), delimiter=",",
                       header="x [mm],z [um]", comments="")
            keys = {"file": str(write_surface(folder, trace_surface(heights, step, name="worn")).resolve())}
            row, = swept(folder, "traces", [BALL], {**FIELDS, "surface": keys})
            marched = read_contact(fields_file(folder, "traces", row))
            at_centre, film = marched["surface_position_m"].values, marched["film_at_centre"].values
            passing = film[(at_centre >= 0) & (at_centre <= step*(heights.size - 1))]
            rq_m = np.std(passing)*contact.conditions.hertz_approach_c_m
            simulated = np.mean(passing)/np.std(passing)*(1 + row["central_film_error"])
            self.assertAlmostEqual(contact.deform(trace).statistics.rq_after_m/rq_m, 1, delta=0.05)
            error = abs(contact.lambda_ratio(trace)/simulated - 1)
            self.assertLess(error, 0.05)
            self.assertGreater(abs(contact.lambda_ratio(trace, by="paper")/simulated - 1), error)

    @staticmethod
    def worn(length, points):
        """Heights with waves of 0.35 to 3.2 a and two of the same length, which run out to zero at both ends."""
        x = np.arange(length*points + 1)/points
        waves = np.fft.rfftfreq(x.size, 1/points)
        parts = np.fft.rfft(np.random.default_rng([4, 21920]).standard_normal(x.size))*(1 + (waves/0.3)**2)**-0.7
        parts[(waves > 1/0.35) | (waves < 1/3.2)] = 0
        noise = np.fft.irfft(parts, x.size)
        heights = noise/np.std(noise) + np.cos(2*np.pi*x/0.8) + 0.6*np.cos(2*np.pi*x/2.9)
        return (heights - heights.mean())*taper(x.size)


if __name__ == "__main__":
    unittest.main()
