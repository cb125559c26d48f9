"""A sweep that is killed, stopped and starved of disk at random moments; scripts/torture is the long form."""

import sys
import unittest

from hdf5_reading import read   # noqa: F401 - leaves as skipped without h5py
from torture import torture

CASES = 160
DISTURBANCES = 7


class Torture(unittest.TestCase):
    def test_nothing_is_lost(self):
        done = torture(CASES, DISTURBANCES, ranks=3, seed=20, say=lambda text: print(text, file=sys.stderr))
        self.assertGreaterEqual(done, 4)


if __name__ == "__main__":
    unittest.main()
