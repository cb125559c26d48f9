"""scripts/python-environment changes no environment that it has not made, and fails in a way that `eval` passes on."""

import itertools
import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

try:
    import tomllib
except ImportError:      # Python 3.10
    tomllib = None

from ehlwave_program import FolderTest

ROOT = Path(__file__).parents[2]
REFUSED = 2
NOBODY = 65534


class PythonEnvironment(FolderTest):
    """In a copy of the tree where `python3` has no packages and can make no environment."""

    def setUp(self):
        super().setUp()
        for name in ["scripts/python-environment", "scripts/environment", "postprocess/pyproject.toml"]:
            (self.folder/name).parent.mkdir(exist_ok=True)
            shutil.copy(ROOT/name, self.folder/name)
        python = self.folder/"bin"/"python3"
        python.parent.mkdir()
        python.write_text("#!/bin/sh\nexit 1\n")
        python.chmod(0o755)
        self.venv = self.folder/"build"/"venv"

    def run_bash(self, text, **variables):
        environment = {"PATH": f"{self.folder}/bin:/usr/bin:/bin", "HOME": str(self.folder), **variables}
        return subprocess.run(["bash", "-c", text], cwd=self.folder, env=environment, capture_output=True, text=True, check=False)

    def somebodys(self, venv):
        """An environment that somebody else has made, and that is broken."""
        venv.mkdir(parents=True)
        (venv/"kept").write_text("kept")

    def test_eval_passes_a_failure_on(self):
        outcome = self.run_bash('eval "$(scripts/python-environment)"')
        self.check_status(outcome, REFUSED)
        self.assertIn("could not be installed", outcome.stderr)
        outcome = self.run_bash('set -e; eval "$(scripts/python-environment --unknown)"; echo went on')
        self.assertEqual((outcome.returncode, outcome.stdout), (REFUSED, ""))
        self.assertIn("--unknown", outcome.stderr)

    def test_environment_of_somebody(self):
        self.somebodys(self.venv)
        outcome = self.run_bash("scripts/python-environment")
        self.assertEqual(outcome.returncode, REFUSED)
        for word in ["was not made by this script", "EHLWAVE_PYTHON", "EHLWAVE_VENV"]:
            self.assertIn(word, outcome.stderr)
        self.assertEqual((self.venv/"kept").read_text(), "kept")
        other = self.folder/"other"
        outcome = self.run_bash("scripts/python-environment", EHLWAVE_VENV=str(other))
        self.assertIn(f"installing them into {other}", outcome.stderr)

    def test_link(self):
        self.somebodys(self.folder/"other")
        (self.folder/"other"/"made-by-ehlwave").touch()
        self.venv.parent.mkdir()
        self.venv.symlink_to("../other")
        self.assertEqual(self.run_bash("scripts/python-environment").returncode, REFUSED)
        self.assertTrue(self.venv.is_symlink())
        self.assertEqual((self.folder/"other"/"kept").read_text(), "kept")

    def test_own_environment_is_made_anew(self):
        self.somebodys(self.venv)
        (self.venv/"made-by-ehlwave").touch()
        self.run_bash("scripts/python-environment")
        self.assertFalse((self.venv/"kept").exists())

    def test_oldest_and_newest_of_a_named_python(self):
        named = self.folder/"named"
        named.write_text(f"#!/bin/sh\necho \"$*\" >>'{self.folder}/calls'\nexit 1\n")
        named.chmod(0o755)
        for option in ["--oldest", "--newest"]:
            self.run_bash(f"scripts/python-environment {option}", EHLWAVE_PYTHON=str(named))
            self.assertIn(f"-m venv {self.venv}{option[1:]}\n", (self.folder/"calls").read_text())

    def test_packages_that_were_found_are_not_imported_again(self):
        """A command that another has called believes it, for the same Python, requirements and extras."""
        named, calls = self.folder/"named", self.folder/"calls"
        named.write_text(f"#!/bin/sh\necho call >>'{calls}'\n")
        named.chmod(0o755)
        again = f"export EHLWAVE_PYTHON={named}; settings=$(scripts/python-environment) && eval \"$settings\"; "
        for change, number in ((":", 1), ("unset EHLWAVE_PYTHON_HAS", 2), ("echo >>postprocess/pyproject.toml", 2),
                               ("cp named other; export EHLWAVE_PYTHON=$PWD/other", 2)):
            calls.unlink(missing_ok=True)
            self.check_status(self.run_bash(f"{again}{change}; scripts/python-environment >/dev/null"), 0)
            self.assertEqual(len(calls.read_text().split()), number, change)
        calls.unlink()
        self.check_status(self.run_bash(f"{again}scripts/python-environment --test >/dev/null"), 0)
        self.assertEqual(len(calls.read_text().split()), 2)

    @unittest.skipUnless(os.getuid() == 0, "only root can give files away")
    def test_environment_of_another_user(self):
        self.somebodys(self.venv)
        (self.venv/"made-by-ehlwave").touch()
        os.chown(self.venv, NOBODY, NOBODY)
        outcome = self.run_bash("scripts/python-environment")
        self.assertEqual(outcome.returncode, REFUSED)
        self.assertIn("is not yours", outcome.stderr)
        self.assertEqual((self.venv/"kept").read_text(), "kept")


class LockFiles(unittest.TestCase):
    """scripts/locks hold the requirements of postprocess/pyproject.toml, with checksums."""

    def test_locks_match_the_project(self):
        text = (ROOT/"postprocess/pyproject.toml").read_text(encoding="utf-8")
        extras = dict(re.findall(r"^(\w+) = \[(.*?)\]", text, re.S | re.M))
        run = extras["dependencies"] + extras["figures"] + extras["instruments"]
        every = run + "".join(extras[name] for name in ["units", "app", "workflows", "test", "docs"])
        for name, wanted in {"run.txt": run, "all.txt": every}.items():
            lock = locked((ROOT/"scripts/locks"/name).read_text(encoding="utf-8"))
            found = re.findall(r'"([\w.-]+)>=([\d.]+)(?:,<([\d.]+))?"', wanted)
            self.assertGreater(len(found), 8)
            for package, low, high in [*found, ("hatchling", "1.26", ""), ("editables", "0", "")]:
                version, hashes = lock[package.lower()]
                self.assertGreaterEqual(numbers(version), numbers(low), package)
                if high:
                    self.assertLess(numbers(version), numbers(high), package)
                self.assertGreater(hashes, 0, package)
            self.assertTrue(all(hashes for _, hashes in lock.values()))

    @unittest.skipUnless(tomllib, "needs Python 3.11")
    def test_every_requirement_has_one_oldest_version(self):
        """`--oldest` pins the lower bounds of all requirements."""
        text = (ROOT/"postprocess/pyproject.toml").read_text(encoding="utf-8")
        project = tomllib.loads(text)
        extras = project["project"]["optional-dependencies"].values()
        bounds = {}
        for wanted in itertools.chain(project["build-system"]["requires"], project["project"]["dependencies"], *extras):
            if wanted.startswith("ehlwave["):
                continue
            found = re.match(r"([\w-]+)>=([\d.]+)", wanted)
            self.assertTrue(found, wanted)
            self.assertEqual(bounds.setdefault(found[1], found[2]), found[2], wanted)
        self.assertGreater(len(bounds), 20)

    def test_locks_agree(self):
        run, every = (locked((ROOT/"scripts/locks"/name).read_text(encoding="utf-8")) for name in ["run.txt", "all.txt"])
        self.assertEqual({package: every[package][0] for package in run}, {package: version for package, (version, _) in run.items()})

    def test_a_version_out_of_bounds_would_be_seen(self):
        self.assertLess(numbers("1.9.4"), numbers("1.26"))
        self.assertEqual(locked("a==1.0 \\\n    --hash=sha256:00 \\\n    --hash=sha256:11\nb==2\n"), {"a": ("1.0", 2), "b": ("2", 0)})


def locked(text):
    """Versions and counts of checksums by package."""
    found = re.findall(r"^([\w.-]+)==([^\s\\]+)((?: \\\n +--hash=sha256:\w+)*)", text, re.M)
    return {package.lower(): (version, hashes.count("sha256:")) for package, version, hashes in found}


def numbers(version):
    return [int(part) for part in re.findall(r"\d+", version)[:3]]


if __name__ == "__main__":
    unittest.main()
