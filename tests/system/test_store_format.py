"""A store that version 0.1.0 made is read, continued and computed anew; a later format is refused with a way out."""

import json
import os
import shutil
import subprocess
import unittest
from pathlib import Path

from hdf5_reading import read
from ehlwave_program import FolderTest
from store_reading import finished

OLD = Path(__file__).parent/"store_of_0.1.0"   # sweep.nml, and its results: 2 linear responses on 32 x 32 cells


class StoreFormat(FolderTest):
    def setUp(self):
        super().setUp()
        shutil.copytree(OLD, self.folder, dirs_exist_ok=True)
        self.store = self.folder/"results.store"
        self.old = finished(self.store)

    def run_sweep(self, *arguments, status=0):
        outcome = subprocess.run([os.environ["EHLWAVE_SWEEP"], *arguments], cwd=self.folder, capture_output=True, text=True,
                                 check=False)
        self.check_status(outcome, status)
        return outcome.stdout + outcome.stderr

    def rows(self):
        """Rows of the results file by identity."""
        _, data = read(self.folder/"results.h5")
        return {case: {name: values[i] for name, values in data.items()} for i, case in enumerate(data["case_id"])}

    def test_its_cases_are_kept_to_the_last_bit(self):
        said = self.run_sweep("sweep.nml")
        self.assertIn("2 of 2 cases found in the store, 0 to run", said)
        self.assertIn("--retry version", said)
        self.assertIn("edges were 'truncated' by default", said)
        rows = self.rows()
        self.assertEqual(set(rows), set(self.old))
        for case, old in self.old.items():
            self.assertEqual(rows[case]["git_revision"], "5f3acfed5bc9")
            for name, value in old.items():
                if name != "effective_input" and value is not None:   # texts end without blanks in the file
                    self.assertEqual(rows[case][name], value.rstrip() if isinstance(value, str) else value, name)
            self.assertEqual(rows[case]["edges"], "truncated")
            # Columns that the old version lacks are empty, not made up.
            self.assertEqual((rows[case]["build_type"], rows[case]["processor"]), ("", ""))

    def test_its_status(self):
        self.assertIn("2 finished, 0 left", self.run_sweep("--status", "results.h5"))

    def test_it_can_be_continued(self):
        sweep = (self.folder/"sweep.nml").read_text()
        (self.folder/"sweep.nml").write_text(sweep.replace("1, 0.5", "1, 0.5, 0.25"))
        self.assertIn("1 to run", self.run_sweep("sweep.nml"))
        self.assertEqual(len({row["git_revision"] for row in self.rows().values()}), 2)
        self.assertEqual({row["edges"] for row in self.rows().values()}, {"truncated"})

    def test_its_default_goes_with_it(self):
        """Its first default holds until the store is dropped or the sweep file sets another."""
        sweep = self.folder/"sweep.nml"
        self.assertIn("0 to run", self.run_sweep("sweep.nml"))
        sweep.write_text(sweep.read_text().replace("&grid ", "&grid edges = 'flooded', "))
        self.assertIn("2 to run", self.run_sweep("sweep.nml"))
        self.assertEqual({row["edges"] for row in self.rows().values()}, {"flooded"})
        shutil.copy(OLD/"sweep.nml", sweep)
        said = self.run_sweep("sweep.nml", "--overwrite")
        self.assertNotIn("by default", said)
        self.assertEqual({row["edges"] for row in self.rows().values()}, {"flooded"})
        self.assertIn("0 to run", self.run_sweep("sweep.nml"))

    def test_it_can_be_computed_anew(self):
        self.run_sweep("sweep.nml", "--retry", "version")
        rows = self.rows()
        for case, old in self.old.items():
            self.assertNotEqual(rows[case]["git_revision"], "5f3acfed5bc9")
            self.assertAlmostEqual(rows[case]["harmonic_ratio"]/old["harmonic_ratio"], 1, delta=1e-5)

    def test_a_later_format_is_refused_and_left_alone(self):
        (self.store/"store").write_text("ehlwave-store 9\n")
        before = {path: path.read_bytes() for path in self.store.rglob("*") if path.is_file()}
        for arguments in (["sweep.nml"], ["--status", "results.h5"], ["sweep.nml", "--overwrite"]):
            said = self.run_sweep(*arguments, status=2)
            for word in ("'ehlwave-store 9'", "'ehlwave-store 1'", "use the program that made it, or name another results file"):
                self.assertIn(word, said)
        self.assertEqual({path: path.read_bytes() for path in self.store.rglob("*") if path.is_file()}, before)

    def test_the_old_store_is_of_its_own_format(self):
        """So that nobody makes it anew with a later program: the test is that the old store is read."""
        (log,) = (OLD/"results.store"/"records").iterdir()
        header = json.loads(log.read_text().split("\n")[0].split(" ", 3)[3])
        self.assertNotIn("build_type", [name for name, _ in header[0]])


if __name__ == "__main__":
    unittest.main()
