"""A store of which a file is lost, cut short or of another store: the numbers of before, or a reason; never other physics."""

import shutil
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import IS_LONG, namelist, run
from hdf5_reading import read

REFUSED, UNFINISHED = 2, 85
SWEEP = {"sweep": {"load_parameter_m": [20, 25, 30], "lubricant_parameter_l": 5, "radius_ratio_d": 1, "output": "r.h5"},
         "grid": {"cells_x": 16, "cells_y": 16}, "output": {"fields": True}}
TRUNCATED = {**SWEEP, "grid": {**SWEEP["grid"], "edges": "truncated"}}


class LostFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.whole = Path(folder.name)
        (cls.whole/"sweep.nml").write_text(namelist(SWEEP))
        assert run("sweep", "sweep.nml", folder=cls.whole).returncode == 0
        cls.before = cls.columns(cls.whole)

    @staticmethod
    def columns(folder):
        """Return the physical results, in order of the cases."""
        _, data = read(folder/"r.h5")
        return [list(data[name]) for name in ("case_id", "edges", "central_film", "minimum_film")]

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)/"here"
        self.fresh()

    def fresh(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(self.whole, self.folder)
        self.store = self.folder/"r.store"

    def sweep(self, *arguments, statuses=(0,)):
        outcome = run("sweep", *arguments, folder=self.folder)
        self.assertIn(outcome.returncode, statuses, outcome.stdout + outcome.stderr)
        return outcome.stdout + outcome.stderr

    def answer_or_reason(self, what):
        """Equal results, or a message that names the store; and `--status` prints nothing untrue."""
        with self.subTest(what=what):
            status = run("sweep", "--status", "r.h5", folder=self.folder)
            if status.returncode == 0:
                self.assertIn("3: 3 finished, 0 left", status.stdout)
            else:
                self.assertIn(status.returncode, (REFUSED, UNFINISHED), status.stdout + status.stderr)
            text = self.sweep("sweep.nml", statuses=(0, REFUSED))
            if "the end, exit status 0" in text:
                self.assertEqual(self.columns(self.folder), self.before)
            else:
                self.assertIn("ehlwave-sweep: r.store", text)

    def test_each_file(self):
        names = sorted(str(path.relative_to(self.store)) for path in self.store.rglob("*") if path.is_file())
        self.assertEqual(len(names), 8, names)
        ways = [("lost", lambda path: path.unlink()),
                ("half", lambda path: path.write_bytes(path.read_bytes()[:path.stat().st_size//2])),
                ("emptied", lambda path: path.write_bytes(b"")),
                ("without its last line", lambda path: path.write_bytes(path.read_bytes()[:-1].rpartition(b"\n")[0] + b"\n"))]
        for name in names:
            for what, spoil in ways if IS_LONG else ways[:2]:
                self.fresh()
                spoil(self.store/name)
                self.answer_or_reason(f"{name} {what}")

    def test_each_folder(self):
        for name in ["records", "fields", "checkpoints"]:
            self.fresh()
            shutil.rmtree(self.store/name)
            self.answer_or_reason(name)

    def test_defaults_that_are_lost(self):
        for make in (lambda: None, lambda: (self.store/"store").unlink()):
            self.fresh()
            (self.store/"defaults").unlink()
            make()
            text = self.sweep("sweep.nml")
            self.assertIn("3 of 3 cases found in the store, 0 to run", text)
            self.assertIn("had lost its file defaults", text)
            self.assertNotIn("truncated", text)
            self.assertEqual((self.store/"defaults").read_text(), (self.whole/"r.store"/"defaults").read_text())
            self.assertNotIn("NOTICE", self.sweep("sweep.nml"))

    def test_defaults_of_records_that_do_not_say_them(self):
        """Earlier logs contain edges in the inputs of their cases alone."""
        (self.store/"defaults").unlink()
        log = next((self.store/"records").iterdir())
        kept = [line for line in log.read_bytes().split(b"\n") if b" run [" not in line[:30]]
        log.write_bytes(b"\n".join(kept))
        text = self.sweep("sweep.nml")
        self.assertIn("its records say edges = 'flooded'", text)
        self.assertIn("0 to run", text)

    def test_contradictions(self):
        (self.store/"defaults").write_text("0 f4dbdf21\n")
        for arguments in [("sweep.nml",), ("sweep.nml", "--plan")]:
            self.assertIn("r.store contradicts itself", self.sweep(*arguments, statuses=(REFUSED,)))
        self.fresh()
        shutil.rmtree(self.store)
        shutil.copytree(Path(__file__).parent/"store_of_0.1.0"/"results.store", self.store)
        self.assertIn("'truncated' by default", self.sweep("sweep.nml", "--plan"))
        (self.store/"defaults").write_text("1\n")
        self.assertIn("r.store contradicts itself", self.sweep("sweep.nml", statuses=(REFUSED,)))
        self.sweep("sweep.nml", "--overwrite")
        self.assertEqual(self.columns(self.folder), self.before)

    def test_edges_of_before_on_request(self):
        """A new store whose sweep file requests the former edges is a new store all the same."""
        shutil.rmtree(self.store)
        (self.folder/"r.h5").unlink()
        (self.folder/"sweep.nml").write_text(namelist(TRUNCATED))
        self.sweep("sweep.nml")
        (self.folder/"sweep.nml").write_text(namelist(SWEEP))
        (self.store/"defaults").unlink()
        self.sweep("sweep.nml")
        self.assertEqual(self.columns(self.folder), self.before)

    def test_records_that_are_lost(self):
        for log in (self.store/"records").iterdir():
            log.unlink()
        for arguments in [("sweep.nml",), ("--status", "r.h5")]:
            self.assertIn("has lost the records of all runs", self.sweep(*arguments, statuses=(REFUSED,)))
        self.sweep("sweep.nml", "--overwrite")
        self.assertEqual(self.columns(self.folder), self.before)

    def test_list_that_is_cut_short(self):
        (self.folder/"sweep.nml").write_text(namelist({**SWEEP, "sweep": {**SWEEP["sweep"], "radius_ratio_d": [1, 0.5]}}))
        self.sweep("sweep.nml", "--time-limit", "0.001", statuses=(0, UNFINISHED))
        lines = (self.store/"cases").read_text().splitlines(keepends=True)
        (self.store/"cases").write_text("".join(lines[:3]))
        self.assertIn("cases is not whole", self.sweep("--status", "r.h5", statuses=(REFUSED,)))
        self.sweep("sweep.nml")
        self.assertIn("6: 6 finished, 0 left", self.sweep("--status", "r.h5"))


if __name__ == "__main__":
    unittest.main()
