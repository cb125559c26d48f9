"""Points of Figures 1 and 2: marched waves beside linear responses, and the record of the full study beside the programs.

Both ways to a point share the smooth contact and nothing else. The findings of the READMEs come from the record
(postprocess/record/full). It has to match the present programs, with the settings of the record.
"""

import csv
import unittest
from collections import defaultdict
from pathlib import Path

from ehlwave_program import IS_LONG, TestCase, report, solve

RECORD = Path(__file__).parents[2] / "postprocess" / "record" / "full" / "tables" / "points.csv"
QUICK = [(m, d, orientation, wave) for m in (50, 200) for d in (1, 0.12)
         for orientation in ("transverse", "isotropic", "longitudinal") for wave in (0.7, 1.4)]
RESOLVED = [(m, d, orientation, wave) for m, d in ((50, 1), (200, 0.35), (500, 0.12))
            for orientation in ("transverse", "isotropic", "longitudinal") for wave in (1, 2)]
PAPER_GRID = [(50, 1, "transverse", 0.5), (50, 1, "longitudinal", 0.5), (200, 0.35, "longitudinal", 1),
              (1000, 0.04, "longitudinal", 2)]
if not IS_LONG:   # every value of most columns once
    QUICK = [point for place, point in enumerate(QUICK) if place%7 == 0]
    RESOLVED = [point for place, point in enumerate(RESOLVED) if place%7 == 0]
    PAPER_GRID = PAPER_GRID[::3]
# Marched waves have Ai = 20 % of the film, linear responses belong to small waves. Measured: at most 0.0055,
# longitudinal waves with M = 50, D = 0.12, lambda = 1.4 a.
FINITE_AMPLITUDE = 0.0065
SAME_SETTINGS = 5e-4    # compilers and FFT libraries differ in last bits, tolerances leave 1e-4


def read_record():
    """Values of each point by their names; the file has a column for each wavelength."""
    points = defaultdict(dict)
    with RECORD.open(newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            contact = float(row.pop("M")), float(row.pop("D")), row.pop("orientation")
            name = row.pop("lambda/a")
            for wave, value in row.items():
                points[(*contact, float(wave))][name] = float(value) if value else None
    return points


class FullRecord(TestCase):
    @classmethod
    def setUpClass(cls):
        cls.record = read_record()

    def test_marched_waves_are_the_linear_responses(self):
        worst = (0, "")
        for point in QUICK:
            with self.subTest(point=point):
                m, d, orientation, wave = point
                result = solve(m=m, d=d, grid={"cells_x": 0, "cells_y": 0, "largest_cells": 256}, solver={"error_estimate": "model"},
                               waviness={"orientation": orientation, "wavelength_over_a": wave, "response": "both"})
                off = abs(result["amplitude_ratio_fit"] - result["harmonic_ratio"])
                self.assertLess(off, FINITE_AMPLITUDE)
                worst = max(worst, (off, str(point)))
        report(f"marched waves less linear responses: at most {worst[0]:.1e} at {worst[1]}")

    def test_resolved_points(self):
        worst = (0, "")
        for point in RESOLVED:
            row = self.record[point]
            with self.subTest(point=point):
                m, d, orientation, wave = point
                result = solve(m=m, d=d, solver={"accuracy": 0.003},
                               waviness={"orientation": orientation, "wavelength_over_a": wave, "response": "harmonic"},
                               grid={"cells_x": 0, "cells_y": 0, "largest_cells": 768})
                off = self.check_close(result["harmonic_extrapolated"], row["resolved"], SAME_SETTINGS, "Ad/Ai")
                worst = max(worst, (off, str(point)))
        report(f"resolved points: largest deviation {worst[0]:.1e} at {worst[1]}")

    def test_paper_grid(self):
        worst = (0, "")
        for point in PAPER_GRID:
            row = self.record[point]
            with self.subTest(point=point):
                m, d, orientation, wave = point
                result = solve(m=m, d=d, waviness={"orientation": orientation, "wavelength_over_a": wave, "response": "periodic"},
                               grid={"cells_x": 256, "cells_y": 256}, solver={"error_estimate": "model"})
                expected = row["paper's grid"]
                worst = max(worst, (self.check_close(result["amplitude_ratio"], expected, SAME_SETTINGS, "Ad/Ai"), str(point)))
        report(f"paper's grid: largest deviation {worst[0]:.1e} at {worst[1]}")


if __name__ == "__main__":
    unittest.main()
