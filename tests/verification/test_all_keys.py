"""Every key is drawn, and errors of random inputs are within their estimates.

scripts/study accuracy --all-keys does the same for hundreds of inputs.
"""

import json
import os
import sys
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import IS_LONG, SKIPPED, report

try:
    import h5py  # noqa: F401 - for surfaces
    import numpy as np
    from studies.all_keys import compare, draw
    from studies.all_keys.check import draw_planned, offenders, plan_of, run_both
    from studies.all_keys.table import key_groups
except ImportError as error:
    print(f"SKIPPED: {error}")
    sys.exit(SKIPPED)

COUNT = 100 if IS_LONG else 10
SEED = int(os.environ.get("EHLWAVE_SEED", "33"))
LARGEST_COST = 1e8 if IS_LONG else 6e6   # cost of the finer run: fractions of a second


class AllKeys(unittest.TestCase):
    def test_every_key_is_drawn(self):
        known = key_groups()
        self.assertGreater(len(known), 60)
        draw.check_keys(known)
        for changed in ({**known, "new_key": "grid"}, {key: known[key] for key in list(known)[1:]}):
            with self.assertRaisesRegex(ValueError, "new_key|radius_x_m"):
                draw.check_keys(changed)

    def test_every_key_is_given_sometimes(self):
        """In inputs that the program accepts: an input that is always refused with its key tests nothing."""
        known, given, left = key_groups(), set(), 2000
        with tempfile.TemporaryDirectory() as name:
            rng, folder = np.random.default_rng(SEED), Path(name)
            drawn = set(known) - draw.NOT_DRAWN
            while given != drawn and left > 0:
                row, left = draw.draw(rng, known, folder), left - 1
                if not given.issuperset(row) and plan_of(row, known, folder) is not None:
                    given |= set(row)
        self.assertEqual(given, drawn)

    def test_random_inputs(self):
        known = key_groups()
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            drawn = draw_planned(COUNT, SEED, folder, known, LARGEST_COST)
            cases = [run_both(number, *one, folder, known) for number, one in enumerate(drawn)]
        rows, summary = offenders(cases)
        report(summary.replace("\n", "; "))
        self.assertEqual(rows, [], json.dumps([case["row"] for case in cases if case["number"] in {row["case"] for row in rows}]))
        self.assertGreaterEqual(sum(case["finer"] is not None for case in cases), COUNT // 4)

    def test_what_is_off_is_found(self):
        """The comparison itself: a number that is 10 % off with an estimate of 1 %, a number without estimate, and a
        negative film.
        """
        found = {"central_film": 1.1, "film_error_mesh": 0.01, "film_error_algebraic": 0.0, "minimum_film": -0.1,
                 "minimum_film_error": None, "cells_x": 64, "cells_y": 64, "total_work_units": 1001.0}
        by_number = {one.number: one for one in compare.findings(found, {"central_film": 1.0, "minimum_film": -0.2})}
        self.assertTrue(by_number["H(0,0)"].is_offender and by_number["smallest H"].is_offender)
        close = compare.findings({**found, "central_film": 1.01}, {"central_film": 1.0})
        self.assertFalse(close[0].is_offender)
        self.assertEqual(compare.negative_films(found), ["minimum_film"])
        plan = {"cells_x": 64, "cells_y": 64, "expected_work_units": 90.0, "expected_total_work_units": 100.0}
        self.assertAlmostEqual(compare.work_over_plan(found, plan), 10.01)


if __name__ == "__main__":
    unittest.main()
