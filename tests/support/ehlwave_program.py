"""Shared parts of tests of the programs, which ``studies.programs`` of postprocess runs."""

import math
import os
import re
import tempfile
import unittest
from pathlib import Path

from studies.programs import MPI_ENVIRONMENT, ONE_RANK, environment, is_open_mpi, last_line, mpi_command, namelist, paper_edges, run, solve

__all__ = [
    "EIGHT_CASES",
    "FolderTest",
    "HANGS_S",
    "IS_LONG",
    "MPI_ENVIRONMENT",
    "ONE_RANK",
    "SKIPPED",
    "TestCase",
    "VERSION",
    "environment",
    "is_open_mpi",
    "last_line",
    "mpi_command",
    "namelist",
    "paper_edges",
    "report",
    "run",
    "solve",
]

HANGS_S = float(os.environ.get("EHLWAVE_HANGS_S", "3600"))/2   # a program that takes longer hangs, see tests/CMakeLists.txt
SKIPPED = 77
VERSION = re.search(r"project\(ehlwave VERSION (\S+)", (Path(__file__).parents[2]/"CMakeLists.txt").read_text())[1]
IS_LONG = os.environ.get("EHLWAVE_LONG_TESTS", "0") != "0"   # scripts/test --long: more of the same
EIGHT_CASES = {
    "sweep": {"load_parameter_m": [20, 25, 30, 35], "lubricant_parameter_l": 5, "radius_ratio_d": [1, 0.5], "output": "results.h5"},
    "grid": {"cells_x": 32, "cells_y": 32},
}
"""A sweep of a second."""


class TestCase(unittest.TestCase):
    """Adds checks on numbers that NaN cannot pass."""

    def check_close(self, value, expected, relative, what):
        """|value/expected - 1| <= relative; returns the deviation."""
        self.assertTrue(value is not None and math.isfinite(value), f"{what}: got {value}")
        deviation = abs(value/expected - 1)
        self.assertLessEqual(deviation, relative, f"{what}: {value} against {expected}")
        return deviation

    def check_order(self, values, smallest, what):
        """Observed order of three values on grids of n, 2n, 4n cells; returns it."""
        order = math.log2(abs(values[1] - values[0])/abs(values[2] - values[1]))
        self.assertGreaterEqual(order, smallest, f"{what}: order {order:.3f} of {values}")
        return order

    def check_status(self, outcome, status=0):
        """The exit status of a process; its output is shown where it is another."""
        self.assertEqual(outcome.returncode, status, f"{outcome.stdout}{outcome.stderr}")


class FolderTest(TestCase):
    """Every test has a folder of its own."""

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = Path(place.name)


def report(text):
    """A measured number for the log of the test."""
    print("  measured: " + text, flush=True)
