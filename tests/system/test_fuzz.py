"""A short run of the fuzzer over everything that reads a file; scripts/study fuzz is the long form."""

import os
import sys
import unittest

from ehlwave_program import IS_LONG
from fuzz import TARGETS, fuzz
from hdf5_reading import h5py   # noqa: F401 - leaves as skipped without h5py

INPUTS = int(os.environ.get("EHLWAVE_FUZZ_INPUTS", "400" if IS_LONG else "200"))
SECONDS = 30


class Fuzz(unittest.TestCase):
    def test_short(self):
        for name in TARGETS:
            with self.subTest(target=name):
                done, faults = fuzz(name, INPUTS, seed=21, seconds=SECONDS, say=lambda text: print(text, file=sys.stderr))
                self.assertEqual(faults, [])
                self.assertGreater(done, INPUTS//20)


if __name__ == "__main__":
    unittest.main()
