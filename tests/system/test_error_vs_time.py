"""scripts/study error-vs-time from its sweep to its tables and figures, on a few small runs."""

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import SKIPPED, TestCase, run

try:
    from ehlwave.errors import ResultsError
    from studies.error_time import runs
    from studies.error_time.__main__ import write_all
    from studies.error_time.table import read_table, write_cases
except ImportError as error:
    print(f"SKIPPED: this Python cannot run ehlwave: {error}")
    sys.exit(SKIPPED)

EXTENT = runs.Extent(
    steady_cells=(32, 64), tolerances=(1e-2,), wave_cells=(), largest=((runs.WAVY[3], 32), (runs.WAVY[3], 48)),
    series_cells=(), step_tolerances=(), time_steps=(), other_cells=(), petsc_cells=(), further=(), further_cells=())


class ErrorVsTime(TestCase):
    def test_sweep_is_run_and_written(self):
        messages = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(messages):
            folder = Path(folder)
            sweep = write_cases(folder, EXTENT)
            with self.assertRaisesRegex(ResultsError, "run the sweep"):
                read_table(folder, EXTENT)
            outcome = run("sweep", sweep)
            self.assertIn(outcome.returncode, (0, 1), outcome.stderr)
            table = read_table(folder, EXTENT)
            rows = table.to_dict("records")
            methods = {row["method"] for row in rows}
            self.assertIn("newton", methods)
            for method in runs.METHODS:
                self.assertTrue(method in methods or f"'{method}' is left out" in messages.getvalue(), method)
            self.assertEqual(len(table), len(runs.all_runs(EXTENT, tuple(methods))))
            self.assertTrue(all(row["seconds"] > 0 and (row["counted_work_units"] > 0 or row["method"] == "petsc") for row in rows))
            # the rows contain the effect of method and tolerance
            films = {(row["method"], row["deformation"], row["tolerance"]): row["central_film"] for row in rows
                     if runs.Contact(row["m"], row["d"], row["wavelength"]) == runs.SMOOTH[0] and row["cells"] == 64}
            usual = films["newton", "fft", 1e-6]
            for (method, deformation, tolerance), film in films.items():
                allowed = 1e-4 if (deformation, tolerance) == ("fft", 1e-6) else 0.02
                self.check_close(film, usual, allowed, f"film by {method}, {deformation}, {tolerance}")
            self.assertNotEqual(films["newton", "fft", 1e-2], usual)
            self.assertNotEqual(films["newton", "mlmi", 1e-6], usual)
            written = {path.name for path in write_all(table, folder)}
            self.assertLessEqual({"runs.csv", "errors.csv", "estimates.csv", "models.csv", "tolerance.png", "summary.png",
                                  "ratio-seconds.png", "film-work.png"}, written)
            self.assertTrue(all((folder / name).stat().st_size > 0 for name in written))


if __name__ == "__main__":
    unittest.main()
