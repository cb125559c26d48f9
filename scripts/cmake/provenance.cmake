# Writes the module ehlwave_provenance at build time; touches the file only when something changed.
# Variables: SOURCE_DIR OUTPUT VERSION COMPILER FLAGS LIBRARIES
execute_process(COMMAND git describe --always --dirty --abbrev=12 WORKING_DIRECTORY ${SOURCE_DIR}
                OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(revision "unknown")
endif()
set(text "!> What this build is made of; written by the build.
module ehlwave_provenance
   implicit none (type, external)
   private
   character(len=*), parameter, public :: program_version = '${VERSION}'
   character(len=*), parameter, public :: git_revision = '${revision}'
   character(len=*), parameter, public :: compiler = '${COMPILER}'
   character(len=*), parameter, public :: compiler_flags = &
      '${FLAGS}'
   character(len=*), parameter, public :: library_versions = '${LIBRARIES}'
end module ehlwave_provenance
")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
