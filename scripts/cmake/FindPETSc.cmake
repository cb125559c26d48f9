# PETSc with real numbers in double precision: target PETSc::petsc. Set PETSc_ROOT, or PETSC_DIR and PETSC_ARCH, or load
# the cluster's module if it is not found.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_search_module(PC_PETSC QUIET PETSc petsc)
endif()
set(petsc_places ${PC_PETSC_INCLUDE_DIRS} $ENV{PETSC_DIR}/$ENV{PETSC_ARCH}/include $ENV{PETSC_DIR}/include)
find_path(PETSc_CONFIG_DIR petscconf.h HINTS ${petsc_places} PATH_SUFFIXES include)
find_path(PETSc_INCLUDE_DIR petscsnes.h HINTS ${petsc_places} PATH_SUFFIXES include)
find_library(PETSc_LIBRARY NAMES ${PC_PETSC_LIBRARIES} petsc petsc_real NAMES_PER_DIR
             HINTS ${PC_PETSC_LIBRARY_DIRS} $ENV{PETSC_DIR}/$ENV{PETSC_ARCH}/lib $ENV{PETSC_DIR}/lib PATH_SUFFIXES lib lib64)
mark_as_advanced(PETSc_CONFIG_DIR PETSc_INCLUDE_DIR PETSc_LIBRARY)

set(PETSc_VERSION)
set(petsc_libraries)
set(petsc_is_real_double FALSE)
if(PETSc_CONFIG_DIR AND PETSc_INCLUDE_DIR)
  file(STRINGS ${PETSc_INCLUDE_DIR}/petscversion.h lines REGEX "define PETSC_VERSION_(MAJOR|MINOR|SUBMINOR) ")
  string(REGEX REPLACE "[^0-9;]" "" lines "${lines}")
  string(REPLACE ";" "." PETSc_VERSION "${lines}")
  file(STRINGS ${PETSc_CONFIG_DIR}/petscconf.h real REGEX "define PETSC_USE_REAL_DOUBLE 1")
  file(STRINGS ${PETSc_CONFIG_DIR}/petscconf.h complex REGEX "define PETSC_USE_COMPLEX 1")
  if(real AND NOT complex)
    set(petsc_is_real_double TRUE)
  endif()
  file(STRINGS ${PETSc_CONFIG_DIR}/petscconf.h no_mpi REGEX "define PETSC_HAVE_MPIUNI 1")
  set(petsc_mpi MPI_C_FOUND)
  if(no_mpi)
    set(petsc_mpi)
  else()
    find_package(MPI QUIET COMPONENTS C)
    set(petsc_libraries MPI::MPI_C)
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PETSc
  REQUIRED_VARS PETSc_LIBRARY PETSc_INCLUDE_DIR PETSc_CONFIG_DIR petsc_is_real_double ${petsc_mpi}
  VERSION_VAR PETSc_VERSION
  REASON_FAILURE_MESSAGE "Install PETSc (Debian: petsc-dev) or load its module, or give -DPETSc_ROOT=DIR")
if(PETSc_FOUND AND NOT TARGET PETSc::petsc)
  add_library(PETSc::petsc UNKNOWN IMPORTED)
  set_target_properties(PETSc::petsc PROPERTIES IMPORTED_LOCATION ${PETSc_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES "${PETSc_INCLUDE_DIR};${PETSc_CONFIG_DIR}"
                        INTERFACE_LINK_LIBRARIES "${petsc_libraries}")
endif()
