"""Error estimates of results, and errors expected by plans, against the errors of the recorded table.

The recorded references are Richardson values from the two finest grids of postprocess/record/error-vs-time.
"""

import csv
import unittest
from pathlib import Path

from ehlwave_program import TestCase, report, solve

RECORD = Path(__file__).resolve().parents[2] / "postprocess" / "record" / "error-vs-time" / "estimates.csv"
FACTOR = 3
LEAST, MOST = 1/1.5, 3.5   # of declared errors over errors: 99 % of a sample are above 1
# Errors below this are close to the errors of the references and of the default step tolerance.
SMALLEST_ERROR = 1e-3
ESTIMATES = {"central_film": "central_film_error", "minimum_film": "minimum_film_error",
             "amplitude_ratio_fit": "amplitude_ratio_error"}
# M, D, lambda/a, orientation, L, cells: conditions, waves and orientations that these grids resolve.
CASES = [(100, 1, 0, "none", 12.05, 128), (100, 0.12, 0, "none", 12.05, 128), (1000, 0.12, 0, "none", 12.05, 256),
         (1000, 1, 0, "none", 12.05, 256),
         *((m, d, wave, "transverse", 12.05, 64) for m, d in [(100, 1), (100, 0.12), (1000, 0.12)] for wave in [0.5, 2]),
         (100, 1, 0.5, "transverse", 12.05, 96), (1000, 0.12, 2, "transverse", 12.05, 96),
         (50, 1, 1, "transverse", 5, 64), (200, 0.35, 1, "transverse", 20, 64),
         (100, 1, 1, "isotropic", 12.05, 64), (100, 1, 1, "longitudinal", 12.05, 96)]


def references():
    """Reference value of each contact and quantity."""
    with RECORD.open(newline="") as file:
        return {(*(float(row[key]) for key in ["m", "d", "wavelength"]), row["orientation"], float(row["lubricant_l"]),
                 row["quantity"]): float(row["reference"]) for row in csv.DictReader(file)
                if float(row["slip"]) == 1 and row["law"] == "newtonian"}


class ErrorEstimates(TestCase):
    def test_within_a_factor(self):
        recorded = references()
        compared = {"estimated": [], "expected": []}
        for *contact, cells in CASES:
            m, d, wave, orientation, lubricant = contact
            waviness = {"orientation": orientation, **({"wavelength_over_a": wave} if wave else {})}
            result = solve(m=m, l=lubricant, d=d, grid={"cells_x": cells, "cells_y": cells, "edges": "flooded"}, waviness=waviness)
            for quantity in ["amplitude_ratio_fit"] if wave else ["central_film", "minimum_film"]:
                error = abs(result[quantity]/recorded[(*contact, quantity)] - 1)
                if error < SMALLEST_ERROR:
                    continue
                # the references have the same domain
                ratios = {"estimated": (result[ESTIMATES[quantity]] - result.get(f"{quantity}_error_domain", 0))/error}
                if quantity != "minimum_film":
                    ratios["expected"] = result["expected_error"]/error
                for what, ratio in ratios.items():
                    compared[what].append(ratio)
                    with self.subTest(contact=contact, cells=cells, quantity=quantity, what=what):
                        least, most = (LEAST, MOST) if what == "estimated" else (1/FACTOR, FACTOR)
                        self.assertTrue(least <= ratio <= most, f"{ratio:.2f} times the error {error:.1e}")
        for what, ratios in compared.items():
            self.assertGreaterEqual(len(ratios), 14)
            report(f"{what} error over error: {min(ratios):.2f} to {max(ratios):.2f} in {len(ratios)} results")

    def test_rescued(self):
        """After a continuation from smaller M the error belongs to the case, not to the neighbour solved on the way."""
        result = solve(m=1000, d=1, grid={"cells_x": 192, "cells_y": 96}, solver={"largest_steps": 5})
        self.assertEqual((result["status"], result["rung"]), ("converged", "continuation"))
        finer = solve(m=1000, d=1, grid={"cells_x": 384, "cells_y": 192})
        error = 4/3*abs(result["central_film"]/finer["central_film"] - 1)
        report(f"M = 1000, D = 1, 192 x 96 cells: error {error:.3f}, said {result['central_film_error']:.3f}")
        self.assertGreater(error, 0.03)
        self.assertTrue(error/1.5 <= result["central_film_error"] <= 5*error, result["central_film_error"])

    def test_accuracy_is_kept(self):
        recorded = references()
        for m, d, wave, accuracy in [(100, 1, 0.5, 0.03), (100, 1, 2, 0.03), (1000, 0.12, 2, 0.1)]:
            result = solve(m=m, d=d, waviness={"orientation": "transverse", "wavelength_over_a": wave},
                           solver={"accuracy": accuracy}, grid={"edges": "flooded"})
            reference = recorded[(m, d, wave, "transverse", 12.05, "amplitude_ratio_fit")]
            error = self.check_close(result["amplitude_ratio_fit"], reference, accuracy, "Ad/Ai")
            report(f"M = {m}, D = {d}, lambda = {wave} a: accuracy {accuracy} asked for, {error:.3f} on "
                   f"{result['cells_x']} x {result['cells_y']} cells")


if __name__ == "__main__":
    unittest.main()
