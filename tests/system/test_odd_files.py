"""Files of another kind than their names: pipes, devices, links, folders, damaged and lost files."""

import os
import shutil
import signal
import stat
import subprocess
import time
import unittest
from pathlib import Path

from attack import LONGEST_S, REFUSED, attack
from ehlwave_program import HANGS_S, MPI_ENVIRONMENT, FolderTest, environment, mpi_command, namelist
from hdf5_reading import read
from store_reading import finished

CASE = {"conditions": {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1},
        "grid": {"cells_x": 32, "cells_y": 32}}
SWEEP = {"sweep": {"load_parameter_m": [100, 120, 140], "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}, "grid": CASE["grid"]}
NOT_WRITTEN = 3
UNFINISHED = 85


class OddFiles(FolderTest):
    def setUp(self):
        super().setUp()
        (self.folder/"case.nml").write_text(namelist(CASE))
        (self.folder/"sweep.nml").write_text(namelist(SWEEP))

    def run_program(self, name, *arguments, status=0, stdout=None, longest_s=LONGEST_S):
        """Run `case` or `sweep`; it must end so, and behave."""
        outcome = attack(name, *arguments, folder=self.folder, stdout=stdout)
        self.assertEqual(outcome.faults(longest_s), [], outcome.stderr)
        self.assertEqual(outcome.status, status, outcome.stdout + outcome.stderr)
        return outcome.stdout + outcome.stderr

    def refuse(self, needle, name, *arguments):
        before = sorted(self.folder.rglob("*"))
        text = self.run_program(name, *arguments, status=REFUSED)
        self.assertIn(needle, text)
        self.assertEqual(sorted(self.folder.rglob("*")), before)

    def log(self):
        return self.folder/"results.store"/"records"/"000001-000000.log"

    def test_output_that_is_no_regular_file(self):
        os.mkfifo(self.folder/"pipe.h5")
        (self.folder/"victim").write_text("kept")
        (self.folder/"link.h5").symlink_to("victim")
        names = ["pipe.h5", "link.h5"]
        try:
            os.mknod(self.folder/"device.h5", stat.S_IFCHR | 0o666, os.makedev(1, 3))
            names.append("device.h5")
        except PermissionError:
            pass   # only root can make it
        for name in names:
            before = (self.folder/name).lstat().st_mode
            for arguments in [("case", "case.nml"), ("sweep", "sweep.nml"), ("sweep", "sweep.nml", "--overwrite")]:
                with self.subTest(name=name, arguments=arguments):
                    self.refuse(name, *arguments, "--output", name)
                    self.assertEqual((self.folder/name).lstat().st_mode, before)
        self.assertEqual((self.folder/"victim").read_text(), "kept")

    def test_temporary_files_follow_no_link(self):
        (self.folder/"victim").write_text("kept")
        for name in ["results.h5.part", "case.h5.part"]:
            (self.folder/name).symlink_to("victim")
        self.run_program("case", "case.nml", "--quiet", "--output", "case.h5")
        self.run_program("sweep", "sweep.nml")
        self.assertEqual((self.folder/"victim").read_text(), "kept")
        for name in ["results.h5", "case.h5"]:
            self.assertTrue(stat.S_ISREG((self.folder/name).lstat().st_mode))
        self.assertEqual(list(self.folder.glob("*.part-*")), [])

    def test_names_that_results_cannot_have(self):
        self.refuse("has the name of a store", "sweep", "sweep.nml", "--output", "results.store")
        self.refuse("names no file", "sweep", "sweep.nml", "--output", "results/")
        (self.folder/"sweep.nml").write_text(namelist({**SWEEP, "sweep": {**SWEEP["sweep"], "output": "   "}}))
        self.refuse("names no file", "sweep", "sweep.nml")

    def test_damaged_byte_of_an_input(self):
        """A damaged byte of the input that all records of a log refer to."""
        self.run_program("sweep", "sweep.nml")
        _, before = read(self.folder/"results.h5")
        data = bytearray(self.log().read_bytes())
        data[data.index(b"input [") + 40] ^= 1
        self.log().write_bytes(data)
        self.assertIn("3: 2 finished, 1 left", self.run_program("sweep", "--status", "results.h5", status=UNFINISHED))
        text = self.run_program("sweep", "sweep.nml")
        self.assertEqual(text.count("damaged"), 1)
        self.assertIn("2 of 3 cases found in the store, 1 to run", text)
        self.assertIn("0 to run", self.run_program("sweep", "sweep.nml"))
        _, after = read(self.folder/"results.h5")
        self.assertEqual(list(after["run"]), [2, 1, 1])
        self.assertEqual(before["central_film"].tobytes(), after["central_film"].tobytes())

    def test_log_that_cannot_be_read(self):
        self.run_program("sweep", "sweep.nml")
        kept = self.log().read_bytes()
        name = self.log().name

        def large():
            with self.log().open("wb") as file:
                file.write(kept)
                file.truncate(2300*2**20)

        for what, make in [("folder", self.log().mkdir), ("pipe", lambda: os.mkfifo(self.log())),
                           ("link to nothing", lambda: self.log().symlink_to("nowhere"))]:
            self.log().unlink()
            make()
            with self.subTest(what=what):
                self.refuse(name, "sweep", "sweep.nml")
                self.refuse(name, "sweep", "--status", "results.h5")
            (self.log().rmdir if what == "folder" else self.log().unlink)()
            self.log().write_bytes(kept)
        if os.getuid() != 0:   # root can read everything
            self.log().chmod(0)
            self.refuse(name, "sweep", "sweep.nml")
            self.log().chmod(0o644)
        self.log().unlink()
        large()
        said = self.run_program("sweep", "sweep.nml", longest_s=10*LONGEST_S)   # it reads 2.3 GiB
        self.assertIn("3 of 3 cases found in the store", said)

    def test_pipe_as_input(self):
        os.mkfifo(self.folder/"pipe.nml")
        self.refuse("not a regular file", "case", "pipe.nml")
        self.refuse("not a regular file", "sweep", "pipe.nml")
        os.mkfifo(self.folder/"pipe.h5")
        (self.folder/"sweep.nml").write_text(namelist({"sweep": {"case_file": "pipe.nml"}}))
        self.refuse("not a regular file", "sweep", "sweep.nml")

    def test_largest_number_of_a_run(self):
        self.run_program("sweep", "sweep.nml")
        self.log().rename(self.log().with_name("999999-000000.log"))
        (self.folder/"sweep.nml").write_text(namelist({**SWEEP, "sweep": {**SWEEP["sweep"], "radius_ratio_d": [1, 0.5]}}))
        self.assertIn("3 of 6 cases found in the store", self.run_program("sweep", "sweep.nml"))
        self.assertEqual(sorted(path.name for path in self.log().parent.iterdir()), ["1000000-000000.log", "999999-000000.log"])
        self.assertIn("0 to run", self.run_program("sweep", "sweep.nml"))

    def test_lost_first_line_of_a_store(self):
        self.run_program("sweep", "sweep.nml")
        line = self.folder/"results.store"/"store"
        kept = line.read_text()
        for lose in [line.unlink, lambda: line.write_text("")]:
            lose()
            self.assertIn("3 finished", self.run_program("sweep", "--status", "results.h5"))
            self.assertIn("0 to run", self.run_program("sweep", "sweep.nml"))
            self.assertEqual(line.read_text(), kept)
        line.unlink()
        line.mkdir()
        self.refuse("results.store/store", "sweep", "sweep.nml", "--overwrite")

    @unittest.skipUnless(Path("/dev/full").exists(), "no /dev/full")
    def test_output_that_cannot_be_written(self):
        self.run_program("sweep", "sweep.nml", status=NOT_WRITTEN, stdout="/dev/full")
        self.assertEqual(len(finished(self.folder/"results.store")), 3)
        self.assertEqual(len(read(self.folder/"results.h5")[1]["case"]), 3)
        self.run_program("sweep", "--status", "results.h5", status=NOT_WRITTEN, stdout="/dev/full")
        self.run_program("sweep", "sweep.nml", "--plan", status=NOT_WRITTEN, stdout="/dev/full")
        for arguments in [("--json", "--quiet"), ("--quiet", "--output", "case.h5"), ("--plan",), ("--help",)]:
            self.run_program("case", "case.nml", *arguments, status=NOT_WRITTEN, stdout="/dev/full")
        self.assertIn("pressure", read(self.folder/"case.h5")[1])

    def test_reader_that_leaves(self):
        """The output goes into a pipe that nobody reads: results are stored, without an error."""
        reading, writing = os.pipe()
        os.close(reading)
        process = subprocess.Popen([os.environ["EHLWAVE_SWEEP"], "sweep.nml"], cwd=self.folder, stdout=writing,
                                   stderr=subprocess.DEVNULL, env=environment(0))
        os.close(writing)
        self.assertEqual(process.wait(timeout=HANGS_S), 0)
        self.assertEqual(len(finished(self.folder/"results.store")), 3)

    def test_early_signal(self):
        """A signal that comes while MPI starts stops a run as a later signal does."""
        for number in [signal.SIGUSR1, signal.SIGTERM]:
            with self.subTest(signal=number):
                shutil.rmtree(self.folder/"results.store", ignore_errors=True)
                (self.folder/"results.h5").unlink(missing_ok=True)
                process = subprocess.Popen([os.environ["EHLWAVE_SWEEP"], "sweep.nml"], cwd=self.folder, stdout=subprocess.PIPE,
                                           stderr=subprocess.STDOUT, text=True, env={**os.environ, **MPI_ENVIRONMENT})
                wait_for_mpi(process.pid)
                process.send_signal(number)
                text = process.communicate(timeout=HANGS_S)[0]
                self.assertEqual(process.returncode, UNFINISHED, text)
                self.assertIn("stopped, because a signal asked for it", text)
                self.assertEqual(finished(self.folder/"results.store"), {})

    def test_terminated_launcher(self):
        """mpirun that is sent SIGTERM ends its ranks; finished work is stored, and the same command continues."""
        slow = {**SWEEP, "sweep": {**SWEEP["sweep"], "load_parameter_m": list(range(100, 700))}}
        (self.folder/"sweep.nml").write_text(namelist(slow))
        command = [*mpi_command(2), os.environ["EHLWAVE_SWEEP"], "sweep.nml"]
        process = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                   env={**os.environ, **MPI_ENVIRONMENT})
        end = time.monotonic() + HANGS_S
        while len(finished(self.folder/"results.store")) < 4 and time.monotonic() < end:
            time.sleep(0.01)
        process.terminate()
        self.assertNotEqual(process.wait(timeout=HANGS_S), 0)
        done = len(finished(self.folder/"results.store"))
        self.assertGreaterEqual(done, 4)
        self.assertIn(f"600: {done} finished", self.run_program("sweep", "--status", "results.h5", status=UNFINISHED))


def wait_for_mpi(pid):
    """Wait until a process begins to load the components of MPI."""
    end = time.monotonic() + HANGS_S
    while "/mca_" not in Path(f"/proc/{pid}/maps").read_text():
        if time.monotonic() > end:
            raise AssertionError("MPI is never started")
        time.sleep(0.0002)


if __name__ == "__main__":
    unittest.main()
