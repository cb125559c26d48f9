"""An installation that was staged, moved and is used from another folder: programs, scripts, manual, module, Python."""

import csv
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import VERSION, FolderTest, last_line, namelist

ROOT = Path(__file__).parents[2]
BUILD = Path(os.environ["EHLWAVE_BUILD"])
STAGED = Path("opt", "ehlwave")
CONTACT = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
GRID = {"cells_x": 32, "cells_y": 32}
COMPLETE = """. "$1"; COMP_WORDS=("$2" "$3" "$4"); COMP_CWORD=2; _${2//-/_} "$2" "$4" "$3"; echo "${COMPREPLY[@]}" """
MODULE = """
foreach name {module-whatis conflict} { proc $name args {} }
foreach name {setenv prepend-path} { proc $name {variable value} { puts "$variable=$value" } }
set ModulesCurrentModulefile [lindex $argv 0]
source $ModulesCurrentModulefile
"""


def install(stage, *options):
    """Install the build as a packager does, into a staging folder; returns the files below the prefix."""
    subprocess.run([os.environ["EHLWAVE_CMAKE"], "--install", BUILD, "--prefix", Path("/", STAGED), *options], check=True,
                   env={**os.environ, "DESTDIR": str(stage)}, stdout=subprocess.DEVNULL)
    return {path.relative_to(stage/STAGED) for path in (stage/STAGED).rglob("*") if path.is_file()}


class Install(FolderTest):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.place = Path(place.name)
        cls.files = install(cls.place/"stage")
        cls.prefix = (cls.place/"stage"/STAGED).rename(cls.place/"moved")
        cls.home = cls.prefix/"share"/"ehlwave"

    def setUp(self):
        super().setUp()
        (self.folder/"case.nml").write_text(namelist({"conditions": CONTACT, "grid": GRID}))
        (self.folder/"sweep.nml").write_text(namelist({"sweep": {**CONTACT, "radius_ratio_d": [1, 0.5]}, "grid": GRID}))

    def run_here(self, *command, status=0, folder=None, **variables):
        """Run in the folder of the test, with nothing of the environment that could help."""
        kept = {name: os.environ[name] for name in ("HOME", "TMPDIR", "ASAN_OPTIONS") if name in os.environ}
        outcome = subprocess.run(command, cwd=folder or self.folder, capture_output=True, text=True, check=False,
                                 env={**kept, "PATH": os.defpath + ":/usr/local/bin:" + os.environ["PATH"], **variables})
        self.check_status(outcome, status)
        return outcome

    def test_a_case(self):
        outcome = self.run_here(self.prefix/"bin"/"ehlwave-case", "case.nml", "--json", "--output", "case.h5")
        self.assertLess(last_line(outcome)["residual"], 1e-6)
        self.assertTrue((self.folder/"case.h5").exists())

    def test_every_input_can_be_planned(self):
        inputs = [path for path in (self.home/"inputs").glob("*.nml") if "&sweep" not in path.read_text()]
        self.assertGreater(len(inputs), 3)
        for path in inputs:
            self.run_here(self.prefix/"bin"/"ehlwave-case", path, "--plan", folder=self.home)

    def test_a_sweep_on_two_ranks(self):
        self.run_here(self.prefix/"bin"/"run-sweep", "--ranks", "2", "sweep.nml", "--output", "results.h5")
        status = self.run_here(self.prefix/"bin"/"ehlwave-sweep", "--status", "results.h5").stdout
        self.assertIn("2 finished, 0 left", status)

    def test_the_module_has_its_version(self):
        for name in ("ehlwave", "ehlwave-post"):
            said = self.run_here(self.prefix/"bin"/name, "--version", EHLWAVE_PYTHON=sys.executable).stdout
            self.assertEqual(said, f"ehlwave {VERSION}\n")

    def test_help_needs_no_mpi(self):
        """Where MPI cannot start a process, here for lack of ssh, as on some login nodes."""
        for option in ("--help", "--version", "--keys"):
            self.assertTrue(self.run_here(self.prefix/"bin"/"ehlwave-sweep", option, PATH="/nowhere").stdout)

    def test_batch_scripts_run_from_their_copies(self):
        """As batch systems start them: copied, in the folder of submission, with the home given, by Slurm itself, or of
        run-sweep.
        """
        (self.folder/"scontrol").write_text(f"#!/bin/sh\necho 'JobId=7 JobName=ehlwave'\n"
                                            f"echo '   Command={self.home}/scripts/batch/slurm.sh sweep.nml'\n")
        (self.folder/"scontrol").chmod(0o755)
        for number, (name, home) in enumerate((("slurm.sh", {"EHLWAVE_HOME": str(self.home)}),
                           ("slurm.sh", {"PATH": f"{self.folder}:{os.environ['PATH']}", "SLURM_JOB_ID": "7"}),
                           ("pbs.sh", {"PATH": f"{self.prefix}/bin:{os.environ['PATH']}"}))):
            copy = shutil.copy(self.home/"scripts"/"batch"/name, self.folder)
            results = f"results-{number}.h5"
            output = self.run_here("bash", copy, "sweep.nml", results, EHLWAVE_RANKS="2", sweep="sweep.nml", results=results,
                                   SLURM_SUBMIT_DIR=str(self.folder), PBS_O_WORKDIR=str(self.folder), **home).stdout
            self.assertIn("exit status 0", output)
            self.assertTrue((self.folder/results).exists())

    def test_a_batch_script_that_cannot_find_the_rest(self):
        copy = shutil.copy(self.home/"scripts"/"batch"/"slurm.sh", self.folder)
        self.assertIn("EHLWAVE_HOME", self.run_here("bash", copy, "sweep.nml", status=2).stderr)

    def test_manual_and_completion_have_every_option(self):
        for program in ("ehlwave-accept", "run-sweep", "ehlwave-case", "ehlwave-sweep"):
            options = re.findall(r"^  (--[a-z-]+)", self.run_here(self.prefix/"bin"/program, "--help").stdout, re.MULTILINE)
            page = (self.prefix/"share"/"man"/"man1"/f"{program}.1").read_text().replace("\\-", "-")
            completion = self.prefix/"share"/"bash-completion"/"completions"/program
            offered = self.run_here("bash", "-c", COMPLETE, "-", completion, program, "x.nml", "--").stdout.split()
            self.assertEqual(offered, list(dict.fromkeys(options)))
            for option in options:
                self.assertRegex(page, rf"\n\.B {option}\b")
        offered = self.run_here("bash", "-c", COMPLETE, "-", completion, program, "--retry", "").stdout.split()
        self.assertEqual(offered, ["failed", "version", "files"])

    def test_manual_and_completion_have_every_command_of_python(self):
        said = self.run_here(sys.executable, "-c", "from ehlwave.cli import main; main()", "--help", PYTHONPATH=str(ROOT/"postprocess/src")).stdout
        commands = re.findall(r"^    ([a-z]+)\b", said, re.MULTILINE)
        self.assertGreater(len(commands), 8)
        page = (self.prefix/"share"/"man"/"man1"/"ehlwave.1").read_text()
        self.assertEqual(re.findall(r"^\.SH EHLWAVE ([A-Z]+)$", page, re.MULTILINE), [name.upper() for name in commands])
        completion = self.prefix/"share"/"bash-completion"/"completions"/"ehlwave"
        complete = f". {completion}; COMP_WORDS=(ehlwave \"$@\"); COMP_CWORD=$#; _ehlwave ehlwave \"${{!#}}\"; echo \"${{COMPREPLY[@]}}\""
        for words, offered in ((("",), [*commands, "--help"]), (("collapse", "--ratio", ""), ["fit", "sampled", "harmonic"])):
            self.assertLessEqual(set(offered), set(self.run_here("bash", "-c", complete, "-", *words).stdout.split()))

    @unittest.skipUnless(shutil.which("tclsh"), "no tclsh")
    def test_the_module_names_folders_that_are_there(self):
        (module,) = (self.prefix/"share"/"modulefiles"/"ehlwave").iterdir()
        (self.folder/"harness.tcl").write_text(MODULE)
        set_to = dict(line.split("=") for line in
                      self.run_here("tclsh", "harness.tcl", module, MANPATH="/usr/share/man").stdout.split())
        self.assertEqual(Path(set_to["PATH"]), self.prefix/"bin")
        self.assertEqual(Path(set_to["EHLWAVE_HOME"]), self.home)
        for folder in set_to.values():
            self.assertTrue(Path(folder).is_dir(), folder)

    @unittest.skipUnless(importlib.util.find_spec("xarray"), "no xarray: set EHLWAVE_PYTHON")
    def test_the_python_package(self):
        self.run_here(self.prefix/"bin"/"run-sweep", "--ranks", "1", "sweep.nml", "--output", "results.h5")
        self.run_here(self.prefix/"bin"/"ehlwave", "export", "results.h5", "--csv", "rows.csv",
                      EHLWAVE_PYTHON=os.environ.get("EHLWAVE_PYTHON", "python3"))
        with (self.folder/"rows.csv").open(newline="") as table:
            self.assertEqual(len(list(csv.DictReader(table))), 2)

    def test_a_python_without_packages_is_told_what_to_install(self):
        """A single line, and an exit status of failure; help needs no packages."""
        bare = shutil.which("python3", path=os.defpath + ":/usr/local/bin") or "python3"
        (self.folder/"bare").write_text(f'#!/bin/sh\nexec {bare} -S "$@"\n')   # without the files installed beside it
        (self.folder/"bare").chmod(0o755)
        said = self.run_here(self.prefix/"bin"/"ehlwave", "--help", EHLWAVE_PYTHON=str(self.folder/"bare")).stdout
        self.assertIn("usage: ehlwave", said)
        for arguments in (["export", "results.h5", "--csv", "rows.csv"], ["table", "results.h5"]):
            said = self.run_here(self.prefix/"bin"/"ehlwave", *arguments, status=2, EHLWAVE_PYTHON=str(self.folder/"bare")).stderr
            self.assertRegex(said, r"^ehlwave: [^\n]* is missing: [^\n]* -m pip install numpy scipy h5py [^\n]*\n$")
        said = self.run_here(self.prefix/"bin"/"ehlwave", status=2, EHLWAVE_PYTHON="/nowhere/python").stderr
        self.assertRegex(said, r"^ehlwave: there is no /nowhere/python: [^\n]*\n$")

    def test_links_of_documents_lead_somewhere(self):
        documents = [path for path in self.prefix.rglob("*.md") if "manual" not in path.parts]   # links of the site
        self.assertIn(self.prefix/"share"/"doc"/"ehlwave"/"inputs"/"README.md", documents)
        followed = 0
        for path in documents:
            for link in re.findall(r"\]\(([^)#\s]+)", path.read_text()):
                if not re.match("[a-z]+:", link):
                    self.assertTrue((path.parent/link).exists(), f"{path}: {link}")
                    followed += 1
        self.assertGreater(followed, 50)

    def test_the_python_package_is_whole(self):
        """Files beside the modules, such as the atlas, are installed with them."""
        source = ROOT/"postprocess"/"src"
        files = {path.relative_to(source) for path in source.glob("ehlwave*/**/*")
                 if path.is_file() and path.name[0] != "." and path.suffix != ".pyc" and ".egg-info" not in str(path)}
        self.assertIn(Path("ehlwave", "laws", "atlas", "rolling.nc"), files)
        cache = (BUILD/"CMakeCache.txt").read_text()
        folder = re.search(r"^EHLWAVE_INSTALL_PYTHONDIR:\w+=(.*)$", cache, re.MULTILINE)[1]   # a packager's choice
        self.assertEqual(files - {path.relative_to(folder) for path in self.files if path.is_relative_to(folder)}, set())

    @unittest.skipUnless((BUILD/"lib"/"libehlwave_petsc.so").exists(), "built without PETSc")
    def test_the_library_of_petsc(self):
        (self.folder/"petsc.nml").write_text(namelist({"conditions": CONTACT, "grid": GRID, "solver": {"method": "petsc"}}))
        self.run_here(self.prefix/"bin"/"ehlwave-case", "petsc.nml", "--quiet")

    @unittest.skipUnless(shutil.which("readelf"), "no readelf")
    def test_run_paths_lead_out_of_the_build(self):
        for path in (self.prefix/"bin"/"ehlwave-case", *self.prefix.glob("lib*/libehlwave_petsc.so")):
            outcome = self.run_here("readelf", "-d", path).stdout
            self.assertRegex(outcome, r"R(UN)?PATH.*\[\$ORIGIN/\.\./lib")
            self.assertNotIn(str(BUILD), outcome)

    def test_components_are_parts_of_the_whole(self):
        parts = [install(self.folder/name, "--component", name) for name in ("core", "petsc", "python")
                 if name != "petsc" or (BUILD/"lib"/"libehlwave_petsc.so").exists()]
        self.assertEqual(set.union(*parts), self.files)
        self.assertEqual(sum(len(part) for part in parts), len(self.files))


if __name__ == "__main__":
    unittest.main()
