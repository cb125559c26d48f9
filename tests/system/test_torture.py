"""A sweep that is killed, stopped and starved of disk at random moments, and a sweep whose system fails; scripts/study
torture is the long form.
"""

import os
import sys
import unittest

from hdf5_reading import read   # noqa: F401 - leaves as skipped without h5py
from ehlwave_program import IS_LONG
from torture import inject, spoil_days, torture

CASES = (160, 640, 2560) if IS_LONG else (80, 320, 1280)   # as many as it takes for the sweep not to be over before it is disturbed
DISTURBANCES = 7 if IS_LONG else 3
FEWEST = 4 if IS_LONG else 2
FAULTS = 24 if IS_LONG else 4
DAYS = 10 if IS_LONG else 1   # days of each mode


class Torture(unittest.TestCase):
    def test_nothing_is_lost(self):
        for cases in CASES:
            done = torture(cases, DISTURBANCES, ranks=3, seed=20, say=lambda text: print(text, file=sys.stderr))
            if done >= FEWEST:
                break
        self.assertGreaterEqual(done, FEWEST)

    @unittest.skipUnless(os.environ.get("EHLWAVE_FAULTS"), "no library to preload")
    def test_failing_system(self):
        messages = []
        counts = inject(FAULTS, seed=20, say=lambda text: (messages.append(text), print(text, file=sys.stderr)))
        self.assertEqual(counts["faults"], FAULTS)
        self.assertGreater(counts["reached"], 0)
        for name in ("lost", "doubled", "different", "hung", "crashed"):
            self.assertEqual(counts[name], 0, "\n".join(messages))

    @unittest.skipUnless(os.environ.get("EHLWAVE_FAULTS"), "no library to preload")
    def test_bad_days(self):
        messages = []
        counts, modes = spoil_days(DAYS, seed=20, say=lambda text: (messages.append(text), print(text, file=sys.stderr)))
        self.assertEqual(set(modes.values()), {DAYS})
        self.assertEqual(len(modes), 3)
        for name in ("lost", "doubled", "different", "hung", "crashed"):
            self.assertEqual(counts[name], 0, "\n".join(messages))


if __name__ == "__main__":
    unittest.main()
