# FFTW 3, double and single precision: target FFTW3::fftw3. Set FFTW3_ROOT (or load the cluster's module) if it is not found.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(PC_FFTW3 QUIET fftw3)
endif()
find_path(FFTW3_INCLUDE_DIR fftw3.f03 HINTS ${PC_FFTW3_INCLUDE_DIRS} ENV FFTW_ROOT ENV FFTW_DIR ENV FFTW_HOME
          PATH_SUFFIXES include)
find_library(FFTW3_LIBRARY fftw3 HINTS ${PC_FFTW3_LIBRARY_DIRS} ENV FFTW_ROOT ENV FFTW_DIR ENV FFTW_HOME
             PATH_SUFFIXES lib lib64)
find_library(FFTW3_SINGLE_LIBRARY fftw3f HINTS ${PC_FFTW3_LIBRARY_DIRS} ENV FFTW_ROOT ENV FFTW_DIR ENV FFTW_HOME
             PATH_SUFFIXES lib lib64)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FFTW3 REQUIRED_VARS FFTW3_LIBRARY FFTW3_SINGLE_LIBRARY FFTW3_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "Install FFTW 3, in double and single precision (Debian: libfftw3-dev) or load its module, or give -DFFTW3_ROOT=DIR")
if(FFTW3_FOUND AND NOT TARGET FFTW3::fftw3)
  add_library(FFTW3::fftw3 UNKNOWN IMPORTED)
  set_target_properties(FFTW3::fftw3 PROPERTIES IMPORTED_LOCATION ${FFTW3_LIBRARY}
                        INTERFACE_LINK_LIBRARIES ${FFTW3_SINGLE_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${FFTW3_INCLUDE_DIR})
endif()
