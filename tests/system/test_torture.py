"""A sweep that is killed, stopped and starved of disk at random moments; scripts/torture is the long form."""

import sys
import unittest

from hdf5_reading import read   # noqa: F401 - leaves as skipped without h5py
from torture import torture

CASES = (160, 640, 2560)   # as many as it takes for the sweep not to be over before it is disturbed
DISTURBANCES = 7
FEWEST = 4


class Torture(unittest.TestCase):
    def test_nothing_is_lost(self):
        for cases in CASES:
            done = torture(cases, DISTURBANCES, ranks=3, seed=20, say=lambda text: print(text, file=sys.stderr))
            if done >= FEWEST:
                break
        self.assertGreaterEqual(done, FEWEST)


if __name__ == "__main__":
    unittest.main()
