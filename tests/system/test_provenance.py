"""Every column of provenance against the build that made it, looked up again by other means than the program's."""

import ctypes
import json
import os
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import FolderTest, namelist
from hdf5_reading import read

ROOT = Path(__file__).parents[2]
BUILD = Path(os.environ["EHLWAVE_BUILD"])
SWEEP = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
PATHS = re.compile(r"-(I|J|fintrinsic-modules-path).*|-fpreprocessed")


def output(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True, **options).stdout


def cache(name):
    """A setting of the build."""
    return re.search(rf"^{name}:\w+=(.*)$", (BUILD/"CMakeCache.txt").read_text(), re.MULTILINE)[1]


def compiled_with(file):
    """Flags of a source file, those that are paths left out."""
    (command,) = [entry["command"] for entry in json.loads((BUILD/"compile_commands.json").read_text())
                  if entry["file"].endswith(file) and entry["command"].count(".o")]
    words = shlex.split(command)[1:]
    kept = [word for last, word in zip(["", *words], words, strict=False) if "-c" not in (last, word) and "-o" not in (last, word)]
    return " ".join(word for word in kept if not PATHS.match(word))


def loaded(program, name):
    """The library of a program, as the system finds it."""
    return ctypes.CDLL(re.search(rf"{name}\S*\.so\S* => (\S+)", output("ldd", program))[1])


def version(function, *leading, count=3, outputs=ctypes.c_uint):
    numbers = [outputs() for _ in range(count)]
    function(*leading, *map(ctypes.byref, numbers))
    return ".".join(str(number.value) for number in numbers)


def libraries(program):
    """Versions as the libraries themselves give them."""
    fftw = ctypes.string_at(ctypes.addressof(ctypes.c_char.in_dll(loaded(program, "libfftw3(?!f)"), "fftw_version"))).decode()
    found = ["FFTW " + fftw.split("-")[1], "HDF5 " + version(loaded(program, r"libhdf5").H5get_libversion),
             os.confstr("CS_GNU_LIBC_VERSION")]
    petsc = BUILD/"lib"/"libehlwave_petsc.so"
    if petsc.exists():
        numbers = version(loaded(petsc, "libpetsc").PetscGetVersionNumber, count=4, outputs=ctypes.c_int).split(".")
        found.append(f"PETSc {'.'.join(numbers[:3])} on demand")
    return ", ".join(found)


def mpi(program):
    text, length = ctypes.create_string_buffer(10000), ctypes.c_int()
    loaded(program, "libmpi").MPI_Get_library_version(text, ctypes.byref(length))
    return re.split("[,\n]", text.value.decode())[0]


def expected():
    """Return the columns to expect of this build on this machine."""
    compiler = cache("CMAKE_Fortran_COMPILER")
    model = re.search(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    described = subprocess.run(["git", "describe", "--always", "--dirty", "--abbrev=12"], cwd=ROOT, capture_output=True,
                               text=True, check=False)
    exported = (ROOT/"scripts"/"cmake"/"revision").read_text().strip()
    program = os.environ["EHLWAVE_SWEEP"]
    return {"program_version": re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT/"CMakeLists.txt").read_text())[1],
            "git_revision": exported[:12] if exported[0] != "$" else described.stdout.strip() or "unknown",
            "compiler": "GNU " + output(compiler, "-dumpfullversion").strip(),
            "compiler_flags": compiled_with("src/core/errors.f90"),
            "build_type": cache("CMAKE_BUILD_TYPE"),
            "library_versions": libraries(program),
            "mpi_library": mpi(program),
            "processor": model[1].strip() if model else "unknown"}


class Provenance(FolderTest):
    maxDiff = None

    def said(self, program):
        lines = output(os.environ[program], "--version", "--verbose").splitlines()
        return dict(line.split(": ", 1) for line in lines[1:])

    def check(self, found):
        """The tree may have been changed since the build, or even committed to: then the revision is the former."""
        wanted = expected()
        for name, value in found.items():
            if name != "git_revision":
                self.assertEqual(re.split(", (?=src/)", value)[0], wanted[name], name)
            elif is_up_to_date():
                self.assertEqual(value.removesuffix("-dirty"), wanted[name].removesuffix("-dirty"), name)

    def test_what_the_programs_say(self):
        self.check(self.said("EHLWAVE_SWEEP"))
        self.assertEqual(set(self.said("EHLWAVE_SWEEP")), set(expected()))
        self.assertEqual(set(self.said("EHLWAVE_CASE")), set(expected()) - {"mpi_library"})
        self.check(self.said("EHLWAVE_CASE"))

    def test_columns_and_attributes(self):
        (self.folder/"sweep.nml").write_text(namelist({"sweep": SWEEP, "grid": {"cells_x": 32, "cells_y": 32}}))
        output(os.environ["EHLWAVE_SWEEP"], "sweep.nml", "--output", "results.h5", cwd=self.folder)
        attributes, data = read(self.folder/"results.h5")
        self.check({name: data[name][0] for name in expected()})
        self.check({name: attributes[name] for name in expected() if name != "mpi_library"})

    def test_no_file_has_flags_of_its_own(self):
        """Or the column would name it; folders may have."""
        self.assertNotIn(".f90: ", self.said("EHLWAVE_CASE")["compiler_flags"])


class Revision(unittest.TestCase):
    """Revision of a source tree, from the script that the build runs."""

    def setUp(self):
        if not shutil.which("git") or subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, check=False).returncode:
            self.skipTest("no repository")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.head = output("git", "rev-parse", "--short=12", "HEAD", cwd=ROOT).strip()

    def revision(self, source, commands=""):
        output(os.environ["EHLWAVE_CMAKE"], f"-DSOURCE_DIR={source}", f"-DOUTPUT={self.folder}/made.f90", "-DVERSION=1", "-DFLAGS=none",
               f"-DCOMMANDS={commands}", "-P", ROOT/"scripts"/"cmake"/"provenance.cmake")
        self.made = (self.folder/"made.f90").read_text()
        return re.search(r"git_revision = '(.*)'", self.made)[1]

    def unpack(self, folder):
        """The last commit as `git archive` gives it."""
        folder.mkdir(parents=True)
        archive = subprocess.run(["git", "archive", "HEAD", "scripts/cmake"], cwd=ROOT, check=True, capture_output=True).stdout
        subprocess.run(["tar", "x"], cwd=folder, input=archive, check=True)
        return folder

    def test_an_archive(self):
        self.assertEqual(self.revision(self.unpack(self.folder/"archive")), self.head)

    def test_an_archive_in_another_repository(self):
        output("git", "init", "--quiet", self.folder)
        self.assertEqual(self.revision(self.unpack(self.folder/"archive")), self.head)

    def test_a_copy_without_git_in_another_repository(self):
        output("git", "init", "--quiet", self.folder)
        (self.folder/"copy"/"scripts"/"cmake").mkdir(parents=True)
        (self.folder/"copy"/"scripts"/"cmake"/"revision").write_text("$Format:%H$\n")
        self.assertEqual(self.revision(self.folder/"copy"), "unknown")

    def test_files_and_folders_with_flags_of_their_own_are_named(self):
        entry = '  "command": "/usr/bin/gfortran -I/x/y -O3 {} -Jz -c /w/src/{}.f90 -o a/{}.f90.o",'
        (self.folder/"commands.json").write_text("\n".join(
            entry.format(flags, name, name) for flags, name in (
                ("-g1", "core/a"), ("-g1", "core/b"), ("-g1 -ffoo='x'", "core/c"), ("-g1 -O1", "io/a"), ("-g1 -O1", "io/b"),
                ("-g1", "io/c"), ("-g1", "run/a"))))
        self.revision(self.unpack(self.folder/"archive"), self.folder/"commands.json")
        text = "".join(re.findall(r"'((?:[^']|'')*)'", self.made.split("compiler_flags = ")[1].split("character")[0]))
        self.assertEqual(text.replace("''", "'"),
                         "-O3 -g1, src/core/c.f90: -O3 -g1 -ffoo='x', src/io: -O3 -g1 -O1, src/io/c.f90: -O3 -g1")


def is_up_to_date():
    """Whether the build was made of the last commit."""
    head = Path(output("git", "rev-parse", "--git-path", "HEAD", cwd=ROOT).strip())
    logs = (ROOT/head).parent/"logs"/"HEAD"
    return logs.exists() and Path(os.environ["EHLWAVE_SWEEP"]).stat().st_mtime >= logs.stat().st_mtime


if __name__ == "__main__":
    unittest.main()
