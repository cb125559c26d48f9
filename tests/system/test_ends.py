"""How the programs end where the system sets a limit: of files, of memory, of readers of their output."""

import os
import resource
import signal
import subprocess
import unittest
from pathlib import Path

from ehlwave_program import EIGHT_CASES, HANGS_S, IS_LONG, MPI_ENVIRONMENT, ONE_RANK, FolderTest, is_open_mpi, last_line, namelist
from store_reading import finished

CASE, SWEEP = os.environ["EHLWAVE_CASE"], os.environ["EHLWAVE_SWEEP"]
RUN_SWEEP = Path(__file__).parents[2]/"scripts"/"run-sweep"
CONTACT = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
INACCURATE, BAD_INPUT, NOT_WRITTEN, NO_MEMORY, UNFINISHED = 1, 2, 3, 4, 85
MIB = 2**20
# Open MPI without files of its own in shared memory, which a limit on files would stop, too.
FEW_FILES = {"PMIX_MCA_gds": "hash", "OMPI_MCA_btl": "self,tcp"}
IS_DEBUG = "asan" in subprocess.run(["ldd", CASE], capture_output=True, text=True, check=False).stdout   # has no limit on addresses


def limited(name, value):
    """Return the set-up of a process before it becomes the program."""
    return lambda: resource.setrlimit(getattr(resource, name), (value, value))


class Ends(FolderTest):
    def setUp(self):
        super().setUp()
        (self.folder/"sweep.nml").write_text(namelist(EIGHT_CASES))

    def write_case(self, cells, **groups):
        (self.folder/"case.nml").write_text(namelist({"conditions": CONTACT, "grid": {"cells_x": cells, "cells_y": cells}, **groups}))

    def call(self, *command, before=None, stdout=subprocess.PIPE, **variables):
        return subprocess.run([str(word) for word in command], cwd=self.folder, stdout=stdout, stderr=subprocess.PIPE, text=True,
                              check=False, preexec_fn=before, timeout=HANGS_S, env={**os.environ, **MPI_ENVIRONMENT, **variables})

    def names(self):
        return {path.name for path in self.folder.iterdir()}


class Files(Ends):
    def test_a_case(self):
        self.write_case(32)
        (self.folder/"out.h5").write_text("before")
        for bytes_ in (0, 1, 4096, 20000):
            with self.subTest(bytes=bytes_):
                outcome = self.call(CASE, "case.nml", "--quiet", "--output", "out.h5", "--overwrite",
                                    before=limited("RLIMIT_FSIZE", bytes_))
                self.check_status(outcome, NOT_WRITTEN)
                self.assertRegex(outcome.stderr, r"^ehlwave-case: cannot write out.h5: File too large[^\n]*\n$")
                self.assertEqual((self.folder/"out.h5").read_text(), "before")
                self.assertEqual(self.names(), {"case.nml", "sweep.nml", "out.h5"})

    @unittest.skipUnless(is_open_mpi(), "another MPI needs files of its own")
    def test_a_sweep_stops_and_is_not_started_again(self):
        for bytes_ in (500, 6000):
            with self.subTest(bytes=bytes_):
                results = f"{bytes_}.h5"
                outcome = self.call(RUN_SWEEP, "--ranks", 2, "sweep.nml", "--output", results,
                                    before=limited("RLIMIT_FSIZE", bytes_), **FEW_FILES)
                self.check_status(outcome, NOT_WRITTEN)
                self.assertIn("File too large", outcome.stderr)
                self.assertNotIn("again", outcome.stdout)
                self.assertNotIn("Backtrace", outcome.stderr)
                self.assertEqual([name for name in self.names() if ".part" in name], [])
                again = self.call(SWEEP, "sweep.nml", "--output", results)
                self.check_status(again)
                self.assertEqual(len(finished(self.folder/f"{bytes_}.store")), 8)

    @unittest.skipUnless(is_open_mpi(), "another MPI opens fewer files")
    def test_too_few_open_files_for_mpi(self):
        """MPI ends the program by itself, with a status of its own: 1, which would be cases that did not converge."""
        outcome = self.call(SWEEP, "sweep.nml", before=limited("RLIMIT_NOFILE", 16))
        self.check_status(outcome, NO_MEMORY)
        self.assertRegex(outcome.stderr, r"\nehlwave-sweep: MPI could not be started: only 16 files may be open \(ulimit -n\)[^\n]*\n$")

    @unittest.skipUnless(is_open_mpi(), "another MPI starts")
    def test_a_limit_under_which_mpi_cannot_start(self):
        outcome = self.call(RUN_SWEEP, "--ranks", 2, "sweep.nml", before=limited("RLIMIT_FSIZE", MIB), EHLWAVE_PATIENCE="10")
        self.check_status(outcome, NOT_WRITTEN)
        self.assertRegex(outcome.stdout, r"run-sweep: MPI cannot start: [^\n]*ulimit -f[^\n]*\n$")
        self.assertNotIn("again", outcome.stdout)


class ProcessorTime(Ends):
    """End by `ulimit -t`: SIGXCPU."""

    def test_a_case(self):
        self.write_case(512)
        process = subprocess.Popen([CASE, "case.nml"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        with process:
            for line in process.stdout:
                if "work units" in line:   # the plan is printed
                    break
            process.send_signal(signal.SIGXCPU)
            _, said = process.communicate(timeout=HANGS_S)
        self.assertEqual(process.returncode, NO_MEMORY, said)
        self.assertRegex(said, r"^ehlwave: the processor time is used up[^\n]*\n$")

    @unittest.skipUnless(is_open_mpi(), "another MPI needs time of its own")
    def test_a_sweep_stops_and_goes_on(self):
        (self.folder/"long.nml").write_text(namelist({**EIGHT_CASES, "grid": {"cells_x": 512, "cells_y": 512}}))
        limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (1, 600))   # noqa: E731
        outcome = self.call(SWEEP, "long.nml", before=limit, **ONE_RANK)
        self.check_status(outcome, UNFINISHED)
        self.assertNotIn("Backtrace", outcome.stderr)


@unittest.skipIf(IS_DEBUG, "the address sanitizer takes all addresses")
class Memory(Ends):
    def test_a_plan_warns_and_the_run_is_refused(self):
        self.write_case(2048)
        few = limited("RLIMIT_AS", 300*MIB)
        plan = self.call(CASE, "case.nml", "--plan", before=few)
        self.check_status(plan)
        self.assertRegex(plan.stdout, r"TOO LITTLE MEMORY: the case needs about 6\d\d MiB .* this process can have 2\d\d MiB")
        self.assertNotIn("TOO LITTLE", self.call(CASE, "case.nml", "--plan").stdout)
        run = self.call(CASE, "case.nml", "--output", "out.h5", before=few)
        self.assertEqual(run.returncode, NO_MEMORY)
        self.assertRegex(run.stderr, r"^ehlwave-case: the case needs about [^\n]*\n$")
        self.assertEqual(self.names(), {"case.nml", "sweep.nml"})

    def test_a_plan_knows_what_a_run_takes(self):
        for cells, groups in ((128, {}), (512, {}), (512, {"waviness": {"orientation": "transverse", "wavelength_over_a": 0.5,
                                                                       "response": "harmonic"}})):
            with self.subTest(cells=cells, groups=groups):
                self.write_case(cells, **groups)
                planned = last_line(self.call(CASE, "case.nml", "--plan", "--json"))["expected_memory_mib"]
                taken = last_line(self.call(CASE, "case.nml", "--json", "--quiet"))["peak_memory_mib"]
                self.assertLess(abs(planned/taken - 1), 0.2, (planned, taken))

    def test_memory_that_runs_out_on_the_way(self):
        """The limit comes when the computation has begun, and leaves so much: smooth, in time, linear, by other methods."""
        runs = ({}, {"waviness": {"orientation": "transverse", "wavelength_over_a": 1}},
                {"waviness": {"orientation": "isotropic", "wavelength_over_a": 1, "response": "harmonic"}},
                {"solver": {"method": "fas", "deformation": "mlmi"}})
        for number, groups in enumerate(runs):
            self.write_case(512, **groups)
            for left in (0, 4, 16) if IS_LONG else ((0, 4, 16)[number % 3],):
                with self.subTest(run=number, left=left):
                    code, said = self.run_out(left*MIB)
                    self.assertEqual(code, NO_MEMORY, said)
                    self.assertRegex(said, r"^ehlwave-case: out of memory: [^\n]*\n$")

    def run_out(self, left):
        """Exit status and standard error of a case that is left so many bytes more when it begins to compute."""
        for _ in range(10):
            process = subprocess.Popen([CASE, "case.nml", "--quiet"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                       text=True)
            with process:
                for line in process.stdout:
                    if "work units" in line:   # the plan is printed
                        break
                begin = has = self.addresses(process)
                while process.poll() is None and has < begin + 8*MIB:
                    has = self.addresses(process)
                resource.prlimit(process.pid, resource.RLIMIT_AS, (has + left, has + left))
                is_in_time = self.addresses(process) <= has + left
                _, said = process.communicate(timeout=HANGS_S)
            if is_in_time:
                return process.returncode, said
        return self.fail("the limit came too late, ten times")

    @staticmethod
    def addresses(process):
        """Bytes of addresses that a process has."""
        return int(Path(f"/proc/{process.pid}/statm").read_text().split()[0])*os.sysconf("SC_PAGESIZE")

    def test_a_case_of_a_sweep_is_a_row(self):
        rows = ["load_parameter_m,lubricant_parameter_l,radius_ratio_d,cells_x,cells_y"]
        rows += [f"{m},5,1,{cells},{cells}" for m, cells in ((20, 32), (25, 8192), (22, 32))]
        (self.folder/"rows.csv").write_text("\n".join(rows) + "\n")
        (self.folder/"sweep.nml").write_text(namelist({"sweep": {"case_file": "rows.csv", "output": "rows.h5"}}))
        few = limited("RLIMIT_AS", 4000*MIB)
        plan = self.call(SWEEP, "sweep.nml", "--plan", before=few)
        self.assertIn("TOO LITTLE MEMORY for 1 case:", plan.stdout)
        outcome = self.call(SWEEP, "sweep.nml", before=few)
        self.check_status(outcome, INACCURATE)
        self.assertRegex(outcome.stdout, r"2 converged\n +1 over_budget")
        status = self.call(SWEEP, "--status", "rows.h5").stdout
        self.assertRegex(status, r"the case needs about \d+ MiB of memory")


class Plan(Ends):
    def test_a_plan_computes_nothing(self):
        """On any grid, the processor time is as on a small grid."""
        for cells in (64, 4096, 8192):
            self.write_case(cells)
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            outcome = self.call(CASE, "case.nml", "--plan", "--json")
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            self.check_status(outcome)
            self.assertGreater(last_line(outcome)["expected_seconds"], 0)
            self.assertLess(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, 2)
            if not IS_DEBUG:
                self.assertEqual(self.call(CASE, "case.nml", "--plan", before=limited("RLIMIT_AS", 200*MIB)).returncode, 0)


class Output(Ends):
    def commands(self):
        self.write_case(32)
        for program in (CASE, SWEEP):
            for option in ("--help", "--version", "--keys"):
                yield program, option
            yield program, "--version", "--verbose"
        yield CASE, "case.nml", "--plan"
        yield CASE, "case.nml", "--plan", "--json"
        yield CASE, "case.nml", "--quiet"
        yield SWEEP, "sweep.nml", "--plan"
        yield SWEEP, "--keys", "--markdown"

    @unittest.skipUnless(Path("/dev/full").exists(), "no /dev/full")
    def test_a_full_disk(self):
        for command in self.commands():
            with self.subTest(command=command[1:], program=Path(command[0]).name), open("/dev/full", "w") as full:
                outcome = self.call(*command, stdout=full)
                self.assertEqual(outcome.returncode, NOT_WRITTEN)
                self.assertRegex(outcome.stderr, r"^ehlwave-(case|sweep): standard output could not be written\n$")

    def test_a_reader_who_has_seen_enough(self):
        """As `| head`: no error, whether the pipe is closed before anything is written or after a line."""
        for command in self.commands():
            for lines in (0, 1):
                with self.subTest(command=command[1:], program=Path(command[0]).name, lines=lines):
                    code, said = self.read_lines(command, lines)
                    self.assertEqual((code, said), (0, ""))

    def test_closed_streams(self):
        """No file that a program opens takes their places: a closed standard output counts as unwritable."""
        self.write_case(32)
        for command in ((CASE, "case.nml", "--quiet"), (SWEEP, "sweep.nml")):
            for closed, status in ((">&-", NOT_WRITTEN), ("<&- >&-", NOT_WRITTEN), ("<&- >&- 2>&-", NOT_WRITTEN), ("<&- 2>&-", 0)):
                with self.subTest(program=Path(command[0]).name, closed=closed):
                    outcome = self.call("bash", "-c", f'exec "$@" {closed}', "-", *command)
                    self.check_status(outcome, status)
                    if "2>" not in closed:
                        self.assertRegex(outcome.stderr, r"^ehlwave-(case|sweep): standard output could not be written")

    def read_lines(self, command, lines):
        reader, writer = os.pipe()
        with os.fdopen(reader) as stream:
            process = subprocess.Popen(command, cwd=self.folder, stdout=writer, stderr=subprocess.PIPE, text=True,
                                       env={**os.environ, **MPI_ENVIRONMENT})
            os.close(writer)
            for _ in range(lines):
                stream.readline()
        _, said = process.communicate(timeout=HANGS_S)
        return process.returncode, said


class LastLine(Ends):
    """At the end of a job the launcher prints nothing of its own."""

    def test_each_exit_status(self):
        stalled = {**EIGHT_CASES, "solver": {"largest_steps": 1}}
        (self.folder/"stalled.nml").write_text(namelist(stalled))
        (self.folder/"long.nml").write_text(namelist({**EIGHT_CASES, "grid": {"cells_x": 512, "cells_y": 512}}))
        for status, arguments in ((1, ["stalled.nml", "--output", "b.h5"]), (BAD_INPUT, ["none.nml"]),
                                  (UNFINISHED, ["long.nml", "--output", "c.h5", "--time-limit", "0.5"])):
            with self.subTest(status=status):
                outcome = self.call(RUN_SWEEP, "--ranks", 2, *arguments)
                self.check_status(outcome, status)
                for words in ("mpirun", "Primary job", "aborted", "-----"):
                    self.assertNotIn(words, outcome.stderr)
        self.assertRegex(outcome.stdout, r"\n[^\n]* run-sweep: stopped before the end; the same command goes on [^\n]*\n$")


if __name__ == "__main__":
    unittest.main()
