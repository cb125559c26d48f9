"""Every command, input and Python line of a README runs unchanged, or is listed here with a reason."""

import contextlib
import importlib.util
import io
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path
from unittest import mock

from ehlwave_program import namelist, run

ROOT = Path(__file__).resolve().parents[2]
FOLDERS_OF_BUILDS = ("build", ".git")
PAGES = [ROOT/"postprocess/examples/cluster.md", *(ROOT/f"postprocess/manual/{name}.md" for name in ("case", "results", "package", "measured_surfaces", "heat", "starved")),
         *(ROOT/"postprocess/manual/explanation").glob("*.md"), *(ROOT/"inputs").glob("*.md")]
READMES = sorted(path.relative_to(ROOT).as_posix() for path in {*ROOT.rglob("README.md"), *PAGES}
                 if not {*FOLDERS_OF_BUILDS, "node_modules", ".venv"} & {*path.relative_to(ROOT).parts})

NOT_RUN = {
    "scripts/reproduce": "installs and computes for minutes; system/test_full_study and test_small_sweep run its parts",
    "scripts/test": "is what runs this test",
    "scripts/manual": "takes a minute; scripts/test --label manual runs it",
    "scripts/build release": "has made the programs of this test",
    "scripts/run-sweep SWEEP.nml": "stands for the files of the reader",
    "scripts/run-sweep inputs/paper_quick.nml": "takes minutes; planned here, and smaller results stand in for its results",
    'settings=$(scripts/python-environment) && eval "$settings"': "installs packages; this test has its own `ehlwave`",
    "python3 -m venv venv && . venv/bin/activate": "installs packages",
    "pip install ./postprocess": "installs packages; system/test_packaging looks at the wheel",
    "pip install './postprocess[figures,instruments]'": "installs packages",
    "pip install './postprocess[app]'": "installs packages",
    "ehlwave app": "serves until it is stopped; postprocess/tests/test_app has the page",
    "mpirun -n 2 build/release/drivers/ehlwave-sweep inputs/paper_harmonic.nml": "takes a minute; planned here",
    "sbatch --ntasks=64 EHLWAVE/scripts/batch/slurm.sh SWEEP.nml results.h5": "needs Slurm; system/test_slurm starts one",
    "sbatch --ntasks=64 --array=0-2 EHLWAVE/scripts/batch/slurm.sh A.nml B.nml C.nml": "needs Slurm; system/test_slurm",
    "sbatch --ntasks=64 $EHLWAVE_HOME/scripts/batch/slurm.sh SWEEP.nml results.h5": "needs Slurm; system/test_slurm",
    "sbatch --ntasks=64 scripts/batch/slurm.sh study.nml results.h5": "needs Slurm; system/test_slurm",
    "qsub -v sweep=SWEEP.nml,results=results.h5,EHLWAVE_HOME=EHLWAVE EHLWAVE/scripts/batch/pbs.sh": "needs PBS",
    "cmake --preset native -DEHLWAVE_TESTS=OFF && cmake --build --preset native": "builds for minutes",
    "cmake --install build/native --prefix /apps/ehlwave/0.2.0": "needs that build; system/test_install installs this one",
    "module use /apps/ehlwave/0.2.0/share/modulefiles && module load ehlwave": "needs modules; system/test_install",
}
"""Commands that are not run, and why."""

SHORTENED = {
    "build/release/drivers/ehlwave-case inputs/full/experiment.nml --output out.h5": " --plan",
}
"""Options that make a command short."""

FORMULAS = ("Ad/Ai = ", "1/lambda_n^2 = ", "c = (G - a)", "G = T S^", "T = (1 + ")
"""How indented lines that are formulas begin."""

PYTHON = ("import ", "ehlwave.", "contact", "film, surface = ", "ball, disc = ", "oil = ", "results = ", "print(", "mean_speed_m_per_s=", "orientation=", "#")
COMMANDS = ("build/", "scripts/", "ehlwave ", "ehlwave-", "python3 ", "pip ", "cmake ", "sbatch ", "qsub ", "module ", "mpirun ", "settings=")

MOES = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
HAS_PACKAGES = all(importlib.util.find_spec(name) for name in ("xarray", "scipy", "matplotlib", "lmfit", "SurfaceTopography"))


def indented(readme):
    """The indented blocks of a README, lines without their comments."""
    blocks, before = [], -1
    for number, line in enumerate((ROOT/readme).read_text(encoding="utf-8").splitlines()):
        if not re.match(r"    \S| {8}", line):
            continue
        if number != before + 1:
            blocks.append([])
        before = number
        text = re.sub(r"\s{2,}#.*$", "", line.strip())
        if text and not text.startswith("#"):
            blocks[-1].append(text)
    return blocks


def kind(line):
    for name, beginnings in (("input", ("&",)), ("formula", FORMULAS), ("command", COMMANDS), ("python", PYTHON)):
        if line.startswith(beginnings):
            return name
    return None


def lines(wanted):
    """(README, line) of a kind."""
    return [(readme, line) for readme in READMES for block in indented(readme) for line in block if kind(line) == wanted]


def write_no_figure(_figure, path, **_options):
    Path(path).write_text("a figure")


class Commands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = folder = Path(holder.name)
        drivers = folder/"build/release/drivers"
        drivers.mkdir(parents=True)
        for name in ("case", "sweep"):
            (drivers/f"ehlwave-{name}").symlink_to(os.environ[f"EHLWAVE_{name.upper()}"])
        for name in ("inputs", "postprocess/studies", "postprocess/examples"):
            shutil.copytree(ROOT/name, folder/name, ignore=shutil.ignore_patterns("__pycache__"))
        (folder/"scripts").symlink_to(ROOT/"scripts")
        cls.environment = {**os.environ, "PYTHON": sys.executable, "EHLWAVE_PROGRAMS": str(drivers), "MPLBACKEND": "Agg",
                           "PATH": f"{drivers}:{os.environ['PATH']}", "OMPI_ALLOW_RUN_AS_ROOT": "1",
                           "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "PYTHONDONTWRITEBYTECODE": "1"}
        cls.what_readers_have()

    @classmethod
    def what_readers_have(cls):
        """Files that READMEs name without making them: results, traces and maps of the reader."""
        study = {"sweep": {"wavelength_over_a": [1, 2, 3], "radius_ratio_d": [1, 0.5], "load_parameter_m": [50, 100],
                           "output": "results.h5"},
                 "conditions": {"lubricant_parameter_l": 12.05}, "grid": {"cells_x": 48, "cells_y": 48},
                 "waviness": {"orientation": "transverse", "response": "harmonic"}}
        (cls.folder/"study.nml").write_text(namelist(study))
        outcome = run("sweep", "study.nml", folder=cls.folder)
        assert outcome.returncode == 0, outcome.stdout + outcome.stderr
        shutil.copy(cls.folder/"inputs/experiment.nml", cls.folder/"contact.nml")
        shutil.copy(cls.folder/"inputs/sliding.nml", cls.folder/"sliding.nml")
        outcome = run("case", cls.folder/"inputs/smooth.nml", "--output", "contact.h5", folder=cls.folder)
        assert outcome.returncode == 0, outcome.stdout + outcome.stderr
        if not HAS_PACKAGES:
            return
        import numpy as np
        from ehlwave.cli import main
        x = np.arange(0, 1.2, 0.5e-3)
        for name, wave in (("trace", 0.06), ("ball", 0.05), ("disc", 0.08)):
            height = 0.003*np.cos(2*np.pi*x/wave)
            np.savetxt(cls.folder/f"{name}.csv", np.column_stack([x, height]), header="x [mm],z [um]", comments="",
                       delimiter=",", fmt="%.6f")
        waves = 3*np.cos(2*np.pi*np.arange(64)/16)[None, :]*np.ones((48, 1))
        np.save(cls.folder/"map.npy", waves)
        (cls.folder/"map.sdf").write_text(
            "aISO-1.0\nManufacID  = test\nCreateDate = 010120200000\nModDate    = 010120200000\nNumPoints  = 64\nNumProfiles = 48\n"
            "Xscale     = 2.0E-6\nYscale     = 2.0E-6\nZscale     = 1.0E-9\nZresolution = -1\nCompression = 0\nDataType   = 7\n"
            "CheckType  = 0\n*\n" + "\n".join(" ".join(f"{z:.9g}" for z in row) for row in waves) + "\n*\n")
        cls.table(main)

    @classmethod
    def table(cls, main):
        """A harmonic table for the contact of `contact.nml`, by ehlwave harmonics."""
        conditions = (cls.folder/"contact.nml").read_text().split("&waviness")[0]
        responses = {"sweep": {"wavelength_over_a": [0.5, 1, 2], "orientation": ["transverse", "isotropic", "longitudinal"],
                               "output": "harmonics.h5"},
                     "waviness": {"response": "harmonic"}, "grid": {"cells_x": 128, "cells_y": 64}}
        (cls.folder/"harmonics.nml").write_text(conditions + namelist(responses))
        outcome = run("sweep", "harmonics.nml", folder=cls.folder)
        assert outcome.returncode == 0, outcome.stdout + outcome.stderr
        assert main(["harmonics", str(cls.folder/"harmonics.h5"), "--csv", str(cls.folder/"harmonics.csv")]) == 0

    def shell(self, command, seconds=120):
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment, capture_output=True,
                              text=True, check=False, timeout=seconds)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}\n{done.stderr}")
        return done.stdout

    def test_every_line_is_of_a_known_kind(self):
        unknown = [(readme, line) for readme in READMES for block in indented(readme) for line in block if kind(line) is None]
        self.assertEqual(unknown, [])
        self.assertGreater(len(lines("command")), 20)

    def test_reasons_are_of_commands_that_are_there(self):
        shown = {line for _, line in lines("command")}
        self.assertEqual([command for command in [*NOT_RUN, *SHORTENED] if command not in shown], [])

    def test_commands_run(self):
        for line in {" ".join(line.split()): line for _, line in lines("command")}.values():
            if line in NOT_RUN:
                continue
            with self.subTest(line=line):
                if not line.startswith("ehlwave "):
                    self.shell(line + SHORTENED.get(line, ""))
                elif HAS_PACKAGES:
                    self.command(line)

    def command(self, line):
        """Run `ehlwave` in this process: loading its libraries takes longer than most commands, and so does drawing, which tests of
        the package do."""
        from ehlwave.cli import main
        with self.as_reader() as said, mock.patch("matplotlib.figure.Figure.savefig", write_no_figure):
            status = main(shlex.split(line)[1:])
        self.assertEqual(status, 0, said.getvalue())

    @contextlib.contextmanager
    def as_reader(self):
        """Be in the folder of the reader for a while, output kept: a process of its own would load all libraries again."""
        said, here = io.StringIO(), Path.cwd()
        os.chdir(self.folder)
        try:
            with mock.patch.dict(os.environ, self.environment), contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
                yield said
        finally:
            os.chdir(here)

    def test_sweeps_that_take_long_are_planned(self):
        for name in ("paper_quick", "paper_harmonic"):
            self.assertIn("cases", self.shell(f"ehlwave-sweep inputs/{name}.nml --plan"))

    def test_inputs_are_planned(self):
        for readme in READMES:
            for block in indented(readme):
                text = "\n".join(line for line in block if kind(line) == "input")
                if not text:
                    continue
                if "&conditions" not in text:
                    text += "\n" + namelist({"conditions": MOES})
                (self.folder/"shown.nml").write_text(text + "\n")
                with self.subTest(readme=readme, text=text):
                    self.shell(f"ehlwave-{'sweep' if '&sweep' in text else 'case'} shown.nml --plan")

    @unittest.skipUnless(HAS_PACKAGES, "the packages of postprocess are not there")
    def test_python_runs(self):
        for readme in READMES:
            text = "\n".join(line for block in indented(readme) for line in block if kind(line) == "python")
            if text:
                with self.subTest(readme=readme), self.as_reader(), warnings.catch_warnings():
                    warnings.simplefilter("error", UserWarning)
                    for ignored in ("large errors", "the inlet would warm"):
                        warnings.filterwarnings("ignore", ignored)
                    exec(compile("import ehlwave\n" + text, readme, "exec"), {"__name__": "__main__"})   # as the reader types it

    def test_scripts_and_links_that_are_named_are_there(self):
        for readme in READMES:
            text = (ROOT/readme).read_text(encoding="utf-8")
            for name in set(re.findall(r"`(scripts/[\w./-]+)", text)):
                with self.subTest(readme=readme, name=name):
                    self.assertTrue((ROOT/name).exists())
            for target in re.findall(r"\]\(([^)\s]+)\)", text):
                if not re.match(r"https?:", target):
                    with self.subTest(readme=readme, link=target):
                        self.check_link(readme, target)

    def check_link(self, readme, target):
        name, _, anchor = target.partition("#")
        if name.startswith("/"):   # links of pages of the manual: from the top level on
            path = ROOT/name[1:]
        else:
            path = ((ROOT/readme).parent/name).resolve() if name else ROOT/readme
        self.assertTrue(path.exists())
        if anchor:
            headings = re.findall(r"^#+ (.*)$", path.read_text(encoding="utf-8"), re.MULTILINE)
            self.assertIn(anchor, [re.sub(r"[^\w -]", "", one.lower()).replace(" ", "-") for one in headings])

    def test_options_of_scripts_that_are_named_are_known(self):
        for readme in READMES:
            text = (ROOT/readme).read_text(encoding="utf-8")
            for name, options in re.findall(r"`(scripts/[\w-]+)((?: [^`\n]*)?)`", text):
                source = (ROOT/name).read_text(encoding="utf-8") if (ROOT/name).is_file() else ""
                for option in re.findall(r"(?<= )--[\w-]+", options):
                    with self.subTest(readme=readme, name=name, option=option):
                        self.assertRegex(source, rf"{option}\b|exec .*\"\$@\"|\"\$@\"")


if __name__ == "__main__":
    unittest.main()
