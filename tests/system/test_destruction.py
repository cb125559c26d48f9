"""Nothing that existed and is not a result of the programs is changed or removed by them, under whatever name."""

import os
import random
import shutil
import tempfile
import unittest
from collections import Counter
from pathlib import Path

from drawn_names import Scene, snapshot
from ehlwave_program import IS_LONG, namelist, report, run

REFUSED, UNFINISHED = 2, 85
GRID = {"cells_x": 16, "cells_y": 16}
CONTACT = {"load_parameter_m": 20, "lubricant_parameter_l": 5, "radius_ratio_d": 1}
ROWS = "load_parameter_m,lubricant_parameter_l,radius_ratio_d\n20,5,1\n"
DRAWS = {"case": 2000, "sweep": 2000} if IS_LONG else {"case": 100, "sweep": 25}
SUFFIXES = [".h5"]*5 + [".csv", ".txt", ".store", ""]
SEED = int(os.environ.get("EHLWAVE_SEED", "33"))


class Destruction(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """Inputs, and results that are genuine."""
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.made = Path(folder.name)
        for name, groups in {
                "in.nml": {"conditions": CONTACT, "grid": GRID},
                "sweep.nml": {"sweep": {**CONTACT, "load_parameter_m": [20, 22], "output": "r.h5"}, "grid": GRID, "output": {"fields": True}},
                "rows.nml": {"sweep": {"case_file": "rows.csv", "output": "rows.h5"}, "grid": GRID}}.items():
            (cls.made/name).write_text(namelist(groups))
        (cls.made/"rows.csv").write_text(ROWS)
        for arguments in [("case", "in.nml", "--quiet", "--output", "out.h5"), ("sweep", "sweep.nml")]:
            assert run(*arguments, folder=cls.made).returncode == 0, arguments

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)/"here"

    def copy(self):
        shutil.copytree(self.made, self.folder)

    def refuse(self, needles, *arguments):
        """The program ends with 2 and a reason, and leaves everything unchanged."""
        before = snapshot(self.folder)
        outcome = run(*arguments, folder=self.folder)
        self.assertEqual(snapshot(self.folder), before, arguments)
        self.assertEqual(outcome.returncode, REFUSED, outcome.stdout + outcome.stderr)
        for needle in needles:
            self.assertIn(needle, outcome.stderr)

    def is_same(self, *names):
        one, other = (self.folder/name for name in names)
        return one.exists() and other.exists() and one.samefile(other)

    def one_draw(self, program, number):
        """A scene, a command on names of it; the damage."""
        draw = random.Random(f"{SEED} {program} {number}")
        self.folder.mkdir()
        inputs = ["in.nml"] if program == "case" else ["sweep.nml", "rows.nml", "rows.csv"]
        results = draw.choice([["out.h5"], ["r.h5", "r.store"], ["r.store"], []])
        scene = Scene(self.folder, draw, {name: self.made/name for name in inputs}, {name: self.made/name for name in results}, SUFFIXES)
        stores = [name for name in scene.ours if name.endswith("r.store")]
        if stores and draw.random() < 0.4:
            scene.spoil(stores[0])
        output = scene.path()
        words = [draw.choice(inputs[:2]) if draw.random() < 0.8 else scene.path(), "--output", output]
        if program == "case":
            words.append("--quiet")
        allowed = None
        if draw.random() < 0.6:
            words.append("--overwrite")
            reads = [words[0]] + ["rows.csv"]*self.is_same(words[0], "rows.nml")
            if not any(self.is_same(output, name) for name in reads):
                allowed = output
        outcome = run(program, *words, folder=self.folder, seconds=60)
        damage = scene.damage(allowed)
        self.assertEqual(damage, [], f"draw {number}: {program} {words!r}, exit status {outcome.returncode}\n{scene.listing()}\n"
                                     f"{outcome.stdout}{outcome.stderr}")
        shutil.rmtree(self.folder)
        return outcome.returncode

    def test_drawn_names(self):
        for program, draws in DRAWS.items():
            ends = [self.one_draw(program, number) for number in range(draws)]
            report(f"{draws} draws of {program}, exit statuses {Counter(ends)}")
            self.assertLessEqual(set(ends), {0, 1, REFUSED, 3}, program)
            self.assertGreater(ends.count(0), draws//20, f"{program}: too few draws write anything")

    def test_output_that_is_an_input(self):
        self.copy()
        os.link(self.folder/"in.nml", self.folder/"twin.h5")
        os.link(self.folder/"rows.csv", self.folder/"rows_twin.h5")
        (self.folder/"link.nml").symlink_to("twin.h5")
        for name in ["in.nml", "./in.nml", "twin.h5", str(self.folder/"twin.h5")]:
            for words in [(), ("--overwrite",)]:
                self.refuse(["which the run reads"], "case", "in.nml", "--quiet", "--output", name, *words)
        self.refuse(["which the run reads"], "case", "link.nml", "--quiet", "--output", "twin.h5", "--overwrite")
        for name in ["sweep.nml", "./sweep.nml"]:
            self.refuse(["which the run reads"], "sweep", "sweep.nml", "--output", name, "--overwrite")
        for name in ["rows.csv", "rows_twin.h5"]:
            self.refuse(["which the run reads"], "sweep", "rows.nml", "--output", name, "--overwrite")

    def test_output_that_is_a_file_of_somebody(self):
        self.copy()
        (self.folder/"thesis.h5").write_text("chapter 1")
        (self.folder/"empty.h5").touch()
        for name in ["thesis.h5", "empty.h5"]:
            self.refuse(["no result of ehlwave", "--overwrite"], "case", "in.nml", "--quiet", "--output", name)
            self.refuse(["--overwrite"], "sweep", "sweep.nml", "--output", name)
        shutil.copytree(self.folder/"r.store", self.folder/"thesis.store")
        self.refuse(["no result of ehlwave"], "sweep", "sweep.nml", "--output", "thesis.h5")
        for name in ["thesis.txt", "out.csv", "out", "out.H5"]:
            self.refuse(["ends in .h5"], "case", "in.nml", "--quiet", "--output", name)
            self.refuse(["ends in .h5"], "sweep", "sweep.nml", "--output", name)
        self.assertEqual(run("case", "in.nml", "--quiet", "--output", "thesis.h5", "--overwrite", folder=self.folder).returncode, 0)
        (self.folder/"mine.h5").write_text("chapter 1")
        words = ["sweep", "sweep.nml", "--output", "mine.h5", "--overwrite"]
        self.assertEqual(run(*words, "--time-limit", "0.001", folder=self.folder).returncode, UNFINISHED)
        self.assertEqual(run(*words[:-1], folder=self.folder).returncode, 0)
        self.assertEqual(run("case", "in.nml", "--quiet", "--output", "out.h5", folder=self.folder).returncode, 0)

    def test_a_case_does_not_replace_a_sweep(self):
        self.copy()
        self.refuse(["a sweep", "--overwrite"], "case", "in.nml", "--quiet", "--output", "r.h5")
        self.refuse(["ends in a blank"], "case", "in.nml", "--quiet", "--output", "new.h5 ")
        self.refuse(["ends in a blank"], "sweep", "sweep.nml", "--output=new.h5 ")
        self.refuse(["ends in a blank"], "case", "in.nml ", "--plan")
        for _ in range(2):
            self.assertEqual(run("case", "in.nml", "--quiet", "--output", "r.h5", "--overwrite", folder=self.folder).returncode, 0)
        self.refuse(["ends in .h5"], "sweep", "sweep.nml", "--plan", "--output", "r.csv")

    def test_a_table_of_the_oil_is_an_input(self):
        self.copy()
        (self.folder/"oil.h5").write_text("pressure_pa,viscosity_pa_s\n0,0.05\n1e8,0.3\n4e8,20\n1e9,5e3\n")
        for program, group in [("case", "conditions"), ("sweep", "sweep")]:
            (self.folder/"oil.nml").write_text(namelist({
                group: {"load_parameter_m": 100, "lubricant_parameter_l": 8, "radius_ratio_d": 1},
                "lubricant": {"viscosity_law": "table", "viscosity_table": "oil.h5"}}))
            self.refuse(["which the run reads"], program, "oil.nml", "--output", "oil.h5", "--overwrite")

    def test_results_in_a_store(self):
        self.copy()
        for name in ["r.store/x.h5", "r.store/fields/x.h5", "r.store/../r.store/x.h5"]:
            self.refuse(["is the store of a sweep"], "case", "in.nml", "--quiet", "--output", name)
            self.refuse(["is the store of a sweep"], "sweep", "sweep.nml", "--output", name)
        (self.folder/"r.store"/"store").unlink()
        self.refuse(["is the store of a sweep"], "sweep", "sweep.nml", "--output", "r.store/x.h5")

    def test_overwriting_follows_no_links(self):
        self.copy()
        other = self.folder/"other"
        other.mkdir()
        for name in ["0123456789ABCDEF.h5", "thesis.txt"]:
            (other/name).write_text("kept")
        for part in ["fields", "records", "checkpoints"]:
            (self.folder/"r.store"/part).rename(self.folder/"aside")
            (self.folder/"r.store"/part).symlink_to("../other")
            for words in [(), ("--overwrite",)]:
                self.refuse([f"r.store/{part} is a link"], "sweep", "sweep.nml", *words)
            (self.folder/"r.store"/part).unlink()
            (self.folder/"aside").rename(self.folder/"r.store"/part)
        (self.folder/"r.store").rename(self.folder/"aside")
        (self.folder/"r.store").symlink_to("aside")
        self.refuse(["r.store is a link"], "sweep", "sweep.nml", "--overwrite")

    def test_overwriting_keeps_what_is_of_somebody(self):
        self.copy()
        for name in ["r.store/notes", "r.store/fields/notes.h5", "r.store/records/x.log", "r.store/checkpoints/x"]:
            (self.folder/name).write_text("kept")
            self.refuse([f"holds '{Path(name).name}'"], "sweep", "sweep.nml", "--overwrite")
            (self.folder/name).unlink()
        (self.folder/"r.store"/"fields"/".hidden").write_text("kept")
        (self.folder/"r.store"/"cases").unlink()
        shutil.copy(self.folder/"sweep.nml", self.folder/"r.store"/"cases")
        self.refuse(["which --overwrite would drop"], "sweep", "r.store/cases", "--overwrite")
        self.assertEqual(run("sweep", "sweep.nml", "--overwrite", folder=self.folder).returncode, 0)
        self.assertEqual((self.folder/"r.store"/"fields"/".hidden").read_text(), "kept")
        self.assertEqual(len(list((self.folder/"r.store"/"fields").glob("*.h5"))), 2)

    def test_folder_with_names_of_a_store(self):
        """Without its first line and a log of a run nothing marks a folder as a store."""
        self.copy()
        folder = self.folder/"mine.store"
        folder.mkdir()
        (folder/"cases").write_text("kept")
        for words in [(), ("--overwrite",)]:
            self.refuse(["not the store of a sweep"], "sweep", "sweep.nml", "--output", "mine.h5", *words)


if __name__ == "__main__":
    unittest.main()
