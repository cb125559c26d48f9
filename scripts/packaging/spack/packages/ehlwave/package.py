# In a Spack repository of its own:
#     spack repo add EHLWAVE/scripts/packaging/spack
#     spack dev-build --source-path EHLWAVE ehlwave@0.2.0          or, of a variant:  ehlwave@0.2.0 +petsc
# dev-build takes the source from a checkout or an unpacked release. For `spack install` give an archive's address (file:// too)
# and its SHA-256:  url = "..."  and  version("0.2.0", sha256="...");  a mirror without them will not do.
# --test=root runs the unit tests and ehlwave-accept.
import os

from spack.package import *


class Ehlwave(CMakePackage, PythonExtension):
    """Waviness in elastohydrodynamically lubricated contacts: transient point and line contacts, response to
    small waves, sweeps over MPI, and a Python package for results."""

    license("MIT")

    version("0.2.0")

    variant("mpi", default=True, description="Sweeps over MPI ranks (ehlwave-sweep)")
    variant("petsc", default=False, description="PETSc's solver as a check and last resort")
    variant("native", default=False, description="-march=native besides what Spack's target gives")
    variant("python", default=True, description="Python package and command ehlwave")

    depends_on("c", type="build")
    depends_on("fortran", type="build")
    depends_on("cmake@3.20:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("fftw-api@3")
    depends_on("hdf5+fortran+hl")
    depends_on("hdf5+mpi", when="+petsc")
    depends_on("mpi", when="+mpi")
    depends_on("petsc@3.17:+double~complex", when="+petsc")

    extends("python@3.10:", when="+python")
    with when("+python"), default_args(type="run"):
        depends_on("py-numpy@2.1:")
        depends_on("py-scipy@1.13:")
        depends_on("py-h5py@3.11:")
        depends_on("py-xarray@2024.6:")
        depends_on("py-h5netcdf@1.4:")
        depends_on("py-matplotlib@3.9:")
        depends_on("py-lmfit@1.3.2:")
        depends_on("py-pandas@2.2.3:")
        depends_on("py-tomli@2.0:", when="^python@:3.10")

    depends_on("python@3.10:", type="test", when="~python")   # ehlwave-accept

    conflicts("+petsc", when="~mpi", msg="PETSc brings MPI along")
    requires("%gcc@11:", msg="built and tested with gfortran 11 and newer")
    generator("ninja")

    def cmake_args(self):
        args = [
            self.define_from_variant("EHLWAVE_MPI", "mpi"),
            self.define_from_variant("EHLWAVE_PETSC", "petsc"),
            self.define_from_variant("EHLWAVE_NATIVE", "native"),
            self.define("EHLWAVE_TESTS", self.run_tests),
            self.define("CMAKE_REQUIRE_FIND_PACKAGE_PETSc", self.spec.satisfies("+petsc")),
            self.define("HDF5_PREFER_PARALLEL", self.spec.satisfies("^hdf5+mpi")),   # if both exist, as in Debian
        ]
        if self.spec.satisfies("+python"):
            args.append(self.define("EHLWAVE_INSTALL_PYTHONDIR", os.path.relpath(python_purelib, self.prefix)))
        return args

    def check(self):
        """The unit tests, then `accept`: seconds. The others are for developers: they start mpirun, need Python
        packages at build time, may fetch some into the source, and assume choices of a packager.
        """
        with working_dir(self.build_directory):
            ctest("--label-regex", "^unit$", "--output-on-failure")

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def accept(self):
        Executable(self.prefix.bin.join("ehlwave-accept"))()
