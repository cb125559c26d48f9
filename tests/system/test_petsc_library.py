"""The library of PETSc's solver: loaded when it is asked for, found beside the program, missed with advice."""

import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from ehlwave_program import FolderTest, last_line, namelist

PROGRAM = Path(os.environ["EHLWAVE_CASE"])
LIBRARY = PROGRAM.parent.parent/"lib"/"libehlwave_petsc.so"
CONTACT = {"conditions": {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1},
           "grid": {"cells_x": 32, "cells_y": 32}}


def libraries_of(path):
    return subprocess.run(["ldd", path], capture_output=True, text=True, check=True).stdout


class PetscLibrary(FolderTest):
    def run_case(self, solver, *arguments, program=PROGRAM, library=None):
        Path(self.folder, "case.nml").write_text(namelist({**CONTACT, "solver": solver}))
        environment = {name: value for name, value in os.environ.items() if name != "EHLWAVE_PETSC_LIBRARY"}
        if library is not None:
            environment["EHLWAVE_PETSC_LIBRARY"] = str(library)
        return subprocess.run([program, "case.nml", "--json", *arguments], cwd=self.folder, env=environment,
                              capture_output=True, text=True, check=False)

    def check_refused(self, outcome, *words):
        self.check_status(outcome, 2)
        for word in ["PETSc cannot be loaded", "choose another solver", *words]:
            self.assertIn(word, outcome.stderr)

    def install(self):
        """The program alone in a new folder, as an installation has it; returns its path."""
        Path(self.folder, "bin").mkdir()
        Path(self.folder, "lib").mkdir()
        return shutil.copy2(PROGRAM, Path(self.folder, "bin"))

    def test_a_library_that_is_not_there(self):
        self.check_refused(self.run_case({"method": "petsc"}, library="/nowhere/library.so"), "/nowhere/library.so")

    def test_a_file_that_is_no_library(self):
        path = Path(self.folder, "text.so")
        path.write_text("not a library\n")
        self.check_refused(self.run_case({"method": "petsc"}, library=path), str(path))

    def test_a_program_without_library(self):
        self.check_refused(self.run_case({"method": "petsc"}, program=self.install()),
                           "EHLWAVE_PETSC_LIBRARY" if LIBRARY.exists() else "-DEHLWAVE_PETSC=ON")

    def test_other_methods_need_none(self):
        """Not even the rescue ladder, whose last rung is PETSc: the case fails as stalled."""
        outcome = self.run_case({}, library="/nowhere/library.so")
        self.check_status(outcome)
        outcome = self.run_case({"largest_steps": 1}, library="/nowhere/library.so")
        self.assertEqual((outcome.returncode, last_line(outcome)["status"]), (1, "stalled"))

    @unittest.skipUnless(LIBRARY.exists(), "built without PETSc")
    def test_found_beside_the_program(self):
        program = self.install()
        shutil.copy2(LIBRARY, Path(self.folder, "lib"))
        outcome = self.run_case({"method": "petsc"}, "--output", "case.h5", program=program)
        self.check_status(outcome)
        self.assertGreater(Path(self.folder, "case.h5").stat().st_size, 0)
        film = last_line(outcome)["central_film"]
        newton = last_line(self.run_case({}, program=program))["central_film"]
        self.assertLess(abs(film/newton - 1), 1e-5)

    @unittest.skipUnless(shutil.which("ldd"), "no ldd")
    def test_the_program_does_not_link_it(self):
        libraries = libraries_of(PROGRAM)
        self.assertNotIn("petsc", libraries)
        hdf5 = re.search(r"libhdf5\S*\.so\S* => (\S+)", libraries)[1]
        if "libmpi" not in libraries_of(hdf5):   # an HDF5 with MPI brings it along
            self.assertNotRegex(libraries, "libmpi|openmpi")


if __name__ == "__main__":
    unittest.main()
