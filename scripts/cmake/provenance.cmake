# Writes the module ehlwave_provenance at build time; touches the file only when something changed.
# Variables: SOURCE_DIR OUTPUT VERSION COMPILER BUILD_TYPE LIBRARIES; COMMANDS, the compile_commands.json of the build, and
# FLAGS, what stands for it where a generator makes none.

# The revision: what git has written into an archive, else that of the repository of which this is the top folder.
set(revision "unknown")
file(STRINGS ${SOURCE_DIR}/scripts/cmake/revision exported)
if(exported MATCHES "^[0-9a-f]+$")
  string(SUBSTRING ${exported} 0 12 revision)
else()
  execute_process(COMMAND git rev-parse --show-prefix WORKING_DIRECTORY ${SOURCE_DIR}
                  OUTPUT_VARIABLE below OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed AND below STREQUAL "")
    execute_process(COMMAND git describe --always --dirty --abbrev=12 WORKING_DIRECTORY ${SOURCE_DIR}
                    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(described)
      set(revision ${described})
    endif()
  endif()
endif()

# The flags: those that the Fortran files of src are compiled with, paths left out; folders that have others, and files that have
# others than their folder, are named before them, each set of flags once: an attribute of HDF5 has at most 64 kB.
set(flags_of_all "")
set(others "")
if(EXISTS "${COMMANDS}")
  file(STRINGS ${COMMANDS} commands REGEX "\"command\": .*/src/[a-z]+/[A-Za-z0-9_]+\\.[fF]90")
  foreach(command IN LISTS commands)
    string(REGEX MATCH "src/[a-z]+/[A-Za-z0-9_]+\\.[fF]90" name "${command}")
    get_filename_component(folder "${name}" DIRECTORY)
    string(REGEX REPLACE "^.*\"command\": \"[^ ]+|\",? *$" "" command "${command}")
    string(REGEX REPLACE " -(c|o|isystem) [^ ]+| -[IJ][^ ]+| -fpreprocessed" "" command "${command}")
    string(REGEX REPLACE "  +" " " command "${command}")
    string(STRIP "${command}" command)
    if(NOT DEFINED flags_of_${folder})
      set(flags_of_${folder} "${command}")
      set(name ${folder})
    elseif(command STREQUAL flags_of_${folder})
      continue()
    endif()
    if(flags_of_all STREQUAL "")
      set(flags_of_all "${command}")
      set(FLAGS "${command}")
    elseif(name MATCHES "90$" OR NOT command STREQUAL flags_of_all)
      list(FIND others "${command}" place)
      if(place EQUAL -1)
        list(LENGTH others place)
        list(APPEND others "${command}")
      endif()
      string(APPEND names_${place} " ${name}")
    endif()
  endforeach()
  set(place 0)
  foreach(command IN LISTS others)
    string(APPEND FLAGS ",${names_${place}}: ${command}")
    math(EXPR place "${place} + 1")
  endforeach()
endif()

# A text as Fortran constants in lines that are short enough.
function(quote text result)
  string(LENGTH "${text}" length)
  set(lines "''")
  set(begin 0)
  while(begin LESS length)
    string(SUBSTRING "${text}" ${begin} 100 part)
    string(REPLACE "'" "''" part "${part}")
    string(APPEND lines "// &\n      '${part}'")
    math(EXPR begin "${begin} + 100")
  endwhile()
  set(${result} "${lines}" PARENT_SCOPE)
endfunction()
quote("${FLAGS}" FLAGS)

set(text "!> What this build is made of; written by the build.
module ehlwave_provenance
   implicit none (type, external)
   private
   character(len=*), parameter, public :: program_version = '${VERSION}'
   character(len=*), parameter, public :: git_revision = '${revision}'
   character(len=*), parameter, public :: compiler = '${COMPILER}'
   character(len=*), parameter, public :: compiler_flags = ${FLAGS}
   character(len=*), parameter, public :: build_type = '${BUILD_TYPE}'
   character(len=*), parameter, public :: library_versions = '${LIBRARIES}'   !! found by the build
end module ehlwave_provenance
")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
