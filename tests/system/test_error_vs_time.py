"""scripts/error-vs-time from its programs to its tables and figures, on a table of a few small runs."""

import contextlib
import io
import os
import sys
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import SKIPPED, TestCase

try:
    from studies.error_time import cli, runs
    from studies.error_time.table import read_table, run_table
    from ehlwave_post.errors import ResultsError
except ImportError as error:
    print(f"SKIPPED: this Python cannot run ehlwave-post: {error}")
    sys.exit(SKIPPED)

PROGRAM = Path(os.environ["EHLWAVE_CASE"])
EXTENT = runs.Extent(
    steady_cells=(32, 64), tolerances=(1e-2,), wave_cells=(), largest=((runs.WAVY[3], 32), (runs.WAVY[3], 48)),
    series_cells=(), step_tolerances=(), time_steps=(), other_cells=(), petsc_cells=(), further=(), further_cells=())


class ErrorVsTime(TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.path = self.folder / "runs.csv"

    def table(self, minutes=10.0):
        messages = io.StringIO()
        with contextlib.redirect_stderr(messages):
            table = run_table(PROGRAM, self.path, EXTENT, minutes)
        return table, messages.getvalue()

    def test_table_is_run_once_and_written(self):
        stopped, messages = self.table(minutes=0)
        self.assertEqual(stopped, [])
        self.assertIn("start again to go on", messages)
        table, messages = self.table()
        self.assertIn("min left", messages)
        methods = {row["method"] for row in table}
        self.assertIn("newton", methods)
        for method in runs.METHODS:
            self.assertTrue(method in methods or f"'{method}' is left out" in messages, method)
        self.assertEqual(len(table), len(runs.all_runs(EXTENT, tuple(methods))))
        again, messages = self.table()
        self.assertIn("0 runs to do", messages)
        self.assertEqual(len(again), len(table))
        self.assertEqual({tuple(row) for row in again}, {tuple(row) for row in read_table(self.path)})

        written = {path.name for path in cli.write_all(table, self.folder)}
        self.assertLessEqual({"errors.csv", "estimates.csv", "models.csv", "tolerance.png", "summary.png",
                              "ratio-seconds.png", "film-work-units.png"}, written)
        self.assertTrue(all((self.folder / name).stat().st_size > 0 for name in written))

    def test_what_cannot_be_used_is_said(self):
        with self.assertRaisesRegex(ResultsError, "build it first"):
            run_table(self.folder / "absent", self.path, EXTENT, 1.0)
        self.path.write_text("a,b\n1,2\n")
        with self.assertRaisesRegex(ResultsError, "move it away"):
            self.table()


if __name__ == "__main__":
    unittest.main()
