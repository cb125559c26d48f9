"""scripts/python-environment changes no environment that it has not made, and fails in a way that `eval` passes on."""

import os
import shutil
import subprocess
import unittest
from pathlib import Path

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

    @unittest.skipUnless(os.getuid() == 0, "only root can give files away")
    def test_environment_of_another_user(self):
        self.somebodys(self.venv)
        (self.venv/"made-by-ehlwave").touch()
        os.chown(self.venv, NOBODY, NOBODY)
        outcome = self.run_bash("scripts/python-environment")
        self.assertEqual(outcome.returncode, REFUSED)
        self.assertIn("is not yours", outcome.stderr)
        self.assertEqual((self.venv/"kept").read_text(), "kept")


if __name__ == "__main__":
    unittest.main()
