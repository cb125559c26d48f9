"""Every script: its own help, and exit status 2 for values that make no sense, before anything is built or computed."""

import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from ehlwave_program import HANGS_S, FolderTest

ROOT = Path(__file__).parents[2]
SCRIPTS = ROOT/"scripts"
MAY_BE_ZERO = {"--restarts", "--seed", "--smooth", "--wavy", "--marches", "--disturbances", "--faults"}
MISSING = object()
# Commands that scripts call after their options are checked.
FURTHER = ("cmake", "mpirun", "ehlwave-sweep", "apt-get", "sudo", "afl-fuzz")


def all_scripts():
    """Return all files to run or source, by their path below scripts."""
    files = [path for path in sorted(SCRIPTS.rglob("*")) if path.is_file() and path.suffix != ".in"]
    found = [path.relative_to(SCRIPTS) for path in files if path.read_bytes().startswith((b"#!/", b"# shellcheck"))]
    return found


def own_scripts():
    """Scripts with options of their own; the parser of studies is tested in postprocess/tests/test_command.py."""
    return [script for script in all_scripts() if script != Path("study")]


def comment_of(path):
    """The comment or docstring that a script begins with, without the parts for tools."""
    text = path.read_text()
    if "python" in text.split("\n", 1)[0]:
        return re.search(r'"""(.*?)"""', text, re.DOTALL)[1].strip().split("\n")
    lines = []
    for line in text.split("\n")[1:]:
        if not line.startswith("#"):
            break
        lines.append(re.sub("^# ?", "", line))
    return lines


class Scripts(FolderTest):
    def setUp(self):
        super().setUp()
        for name in ("scripts", "postprocess/studies", "postprocess/src/ehlwave"):
            shutil.copytree(ROOT/name, self.folder/"tree"/name, ignore=shutil.ignore_patterns("__pycache__", "*.nc"))
        stubs = self.folder/"stubs"
        stubs.mkdir()
        for name in FURTHER:
            (stubs/name).write_text("#!/bin/sh\nexit 99\n")
            (stubs/name).chmod(0o755)
        self.environment = {**os.environ, "PATH": f"{stubs}:{os.environ['PATH']}"}

    def call(self, script, *arguments, path=None):
        """Start a script, or a link to it."""
        command = ["bash"] if not os.access(SCRIPTS/script, os.X_OK) else []
        return subprocess.run([*command, path or self.folder/"tree"/"scripts"/script, *arguments], cwd=self.folder, text=True,
                              capture_output=True, check=False, timeout=HANGS_S, stdin=subprocess.DEVNULL, env=self.environment)

    def test_each_prints_its_own_help(self):
        scripts = own_scripts()
        for name in ("run-sweep", "accept", "environment", "batch/job", "batch/slurm.sh", "packaging/wheel/build"):
            self.assertIn(Path(name), scripts)
        for script in scripts:
            with self.subTest(script=str(script)):
                outcome = self.call(script, "--help")
                self.assertEqual((outcome.returncode, outcome.stderr), (0, ""))
                self.assertEqual(outcome.stdout.rstrip().split("\n"), comment_of(SCRIPTS/script))
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["stubs", "tree"])

    def test_each_can_be_started_through_a_link(self):
        (self.folder/"link").symlink_to("tree/scripts")
        for script in all_scripts():
            if script.parts[0] == "packaging":
                continue
            with self.subTest(script=str(script)):
                link = self.folder/"tree"/script.name
                link.symlink_to(self.folder/"link"/script)
                self.check_status(self.call(script, "--help", path=link))

    def test_a_script_alone_says_so(self):
        for name in ("run-sweep", "build"):
            outcome = self.call(name, "--help", path=shutil.copy(SCRIPTS/name, self.folder))
            self.assertEqual(outcome.returncode, 2)
            self.assertIn("environment: No such file", outcome.stderr)

    def test_studies_need_a_python_that_is_new_enough(self):
        (self.folder/"stubs"/"python3").write_text("#!/bin/sh\nexit 1\n")
        (self.folder/"stubs"/"python3").chmod(0o755)
        self.environment["EHLWAVE_PYTHON"] = "no-such-python"
        outcome = self.call("study", "--help")
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("EHLWAVE_PYTHON", outcome.stderr)

    def test_the_readme_names_every_script(self):
        row = re.search(r"^\| \[`scripts`\]\(scripts\) \|.*$", (ROOT/"README.md").read_text(), re.MULTILINE)[0]
        names = {str(script) for script in all_scripts() if len(script.parts) == 1}
        self.assertEqual(names - set(re.findall("`(.*?)`", row)), set())

    def test_values_that_make_no_sense(self):
        tried = 0
        for script in own_scripts():
            if script.parts[0] in ("batch", "cmake", "packaging"):
                continue
            text = "\n".join(comment_of(SCRIPTS/script))
            for option, kind in sorted(set(re.findall(r"(--[a-z-]+) (N\b|COUNT|SECONDS|S\b|DIR|FILE|NAME|SWEEP)", text))):
                bad = ["", MISSING]
                if kind in ("N", "COUNT", "SECONDS", "S"):
                    bad += ["abc", "-1", "1x", "1 2", *(["0"] if option not in MAY_BE_ZERO else [])]
                for value in bad:
                    with self.subTest(script=str(script), option=option, value=value):
                        outcome = self.call(script, option, *([value] if value is not MISSING else []))
                        self.check_status(outcome, 2)
                        self.assertIn(option, outcome.stderr)
                        tried += 1
        self.assertGreater(tried, 20)
        self.assertFalse((self.folder/"tree"/"build").exists())

    def test_paths_that_cmake_cannot_take(self):
        """A line that names the character, before CMake blames a package."""
        (self.folder/"stubs"/"cmake").write_text("#!/bin/sh\necho configured\n")
        (self.folder/"stubs"/"cmake").chmod(0o755)
        self.check_status(self.call("build"))
        for character in '#[];"\\$*?|<>':
            with self.subTest(character=character):
                tree = self.folder/f"a{character}b"
                shutil.copytree(self.folder/"tree"/"scripts", tree/"scripts")
                outcome = self.call("build", path=tree/"scripts"/"build")
                self.check_status(outcome, 2)
                self.assertEqual(outcome.stdout, "")
                self.assertRegex(outcome.stderr, rf"^build: [^\n]* has the character {re.escape(character)} in its path[^\n]*\n$")
                if character == "\\":
                    continue  # CMake takes it for a slash
                shutil.copy(ROOT/"CMakeLists.txt", tree)
                outcome = subprocess.run(["cmake", "-S", tree, "-B", self.folder/f"of {ord(character)}"], capture_output=True, text=True, check=False)
                self.assertNotEqual(outcome.returncode, 0)
                self.assertIn(f"has the character {character} in", " ".join(outcome.stderr.split()))
                self.assertNotIn("HDF5", outcome.stderr + outcome.stdout)

    def test_unknown_options(self):
        for script in all_scripts():
            if script.parts[0] in ("batch", "cmake") or script == Path("run-sweep"):  # options of ehlwave-sweep
                continue
            with self.subTest(script=str(script)):
                outcome = self.call(script, "--nonsense")
                self.check_status(outcome, 2)


if __name__ == "__main__":
    unittest.main()
