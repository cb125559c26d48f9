# What `cmake --install` puts into one prefix, which can be moved. Components: core, petsc, python.
#
#     bin/                            the programs, run-sweep, ehlwave-accept, ehlwave
#     lib/libehlwave_petsc.so         PETSc's solver, which the programs load when it is asked for (petsc)
#     share/ehlwave/                  scripts, scripts/batch and inputs, as in the source
#     share/man, share/bash-completion, share/modulefiles
#     share/doc/ehlwave               the READMEs and what they link to
#     EHLWAVE_INSTALL_PYTHONDIR       the Python package (python)
set(EHLWAVE_INSTALL_PYTHONDIR ${CMAKE_INSTALL_DATADIR}/ehlwave/python CACHE STRING
    "Folder of the Python package below the prefix, e.g. lib/python3.12/site-packages")
set(data ${CMAKE_INSTALL_DATADIR}/ehlwave)
set(packaging ${CMAKE_SOURCE_DIR}/scripts/packaging)
set(made ${CMAKE_BINARY_DIR}/installation)

set(programs ehlwave-case)
if(TARGET ehlwave-sweep)
  list(APPEND programs ehlwave-sweep)
endif()
install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT core)
if(TARGET ehlwave_petsc)
  install(TARGETS ehlwave_petsc LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT petsc)
endif()

# Manual pages and completion are what the commands say of themselves, so a cross build goes without. In a wheel they are data.
set(shared ${CMAKE_INSTALL_DATADIR})
if(DEFINED SKBUILD_DATA_DIR)
  set(shared ${SKBUILD_DATA_DIR}/share)
endif()
if(NOT CMAKE_CROSSCOMPILING)
  set(pages)
  foreach(program ${programs})
    set(page ${made}/${program}.1)
    add_custom_command(OUTPUT ${page} ${made}/${program}
      COMMAND sh ${CMAKE_SOURCE_DIR}/scripts/cmake/describe $<TARGET_FILE:${program}> ${PROJECT_VERSION} ${made}
      DEPENDS ${program} scripts/cmake/describe scripts/cmake/manual.awk scripts/cmake/completion.awk VERBATIM)
    list(APPEND pages ${page})
  endforeach()
  set(names ${programs})
  find_package(Python3 3.10 QUIET COMPONENTS Interpreter)
  if(Python3_Interpreter_FOUND)
    set(page ${made}/ehlwave-accept.1)
    add_custom_command(OUTPUT ${page} ${made}/ehlwave-accept
      COMMAND sh ${CMAKE_SOURCE_DIR}/scripts/cmake/describe ${CMAKE_SOURCE_DIR}/scripts/accept ${PROJECT_VERSION} ${made} ehlwave-accept
      DEPENDS scripts/accept scripts/cmake/describe scripts/cmake/manual.awk scripts/cmake/completion.awk VERBATIM)
    list(APPEND pages ${page})
    list(APPEND names ehlwave-accept)
  endif()
  if(NOT DEFINED SKBUILD)
    set(page ${made}/run-sweep.1)
    add_custom_command(OUTPUT ${page} ${made}/run-sweep
      COMMAND sh ${CMAKE_SOURCE_DIR}/scripts/cmake/describe ${CMAKE_SOURCE_DIR}/scripts/run-sweep ${PROJECT_VERSION} ${made}
      DEPENDS scripts/run-sweep scripts/cmake/describe scripts/cmake/manual.awk scripts/cmake/completion.awk VERBATIM)
    list(APPEND pages ${page})
    list(APPEND names run-sweep)
  endif()
  add_custom_target(manual ALL DEPENDS ${pages})
  install(FILES ${pages} DESTINATION ${shared}/man/man1 COMPONENT core)
  list(TRANSFORM names PREPEND ${made}/ OUTPUT_VARIABLE completions)
  install(FILES ${completions} DESTINATION ${shared}/bash-completion/completions COMPONENT core)
  if(Python3_Interpreter_FOUND AND NOT DEFINED SKBUILD)
    set(maker ${CMAKE_SOURCE_DIR}/postprocess/manual/command_pages.py)
    file(GLOB_RECURSE parsers CONFIGURE_DEPENDS postprocess/src/ehlwave/cli/__init__.py postprocess/src/ehlwave/cli/*.py)
    add_custom_command(OUTPUT ${made}/ehlwave.1 ${made}/ehlwave
      COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${Python3_EXECUTABLE} ${maker} ${made} ${PROJECT_VERSION}
      DEPENDS ${maker} ${parsers} VERBATIM)
    add_custom_target(manual_python ALL DEPENDS ${made}/ehlwave.1)
    install(FILES ${made}/ehlwave.1 DESTINATION ${shared}/man/man1 COMPONENT python)
    install(FILES ${made}/ehlwave DESTINATION ${shared}/bash-completion/completions COMPONENT python)
  endif()
endif()

# The scripts look for each other beside themselves, so bin has starters only.
foreach(name run-sweep accept)
  file(RELATIVE_PATH script ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DATADIR}/ehlwave/scripts/${name})
  configure_file(${packaging}/starter.in ${made}/starters/${name} @ONLY)
endforeach()
install(PROGRAMS ${made}/starters/run-sweep DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT core)
install(PROGRAMS ${made}/starters/accept DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME ehlwave-accept COMPONENT core)
install(PROGRAMS scripts/run-sweep scripts/accept DESTINATION ${data}/scripts COMPONENT core)
install(FILES scripts/environment scripts/accept.csv DESTINATION ${data}/scripts COMPONENT core)
install(DIRECTORY scripts/batch DESTINATION ${data}/scripts USE_SOURCE_PERMISSIONS COMPONENT core
        PATTERN "README.md" EXCLUDE)   # it is among the documents
install(DIRECTORY inputs DESTINATION ${data} COMPONENT core)
if(NOT DEFINED SKBUILD)
  include(documents)
endif()

set(modules ${CMAKE_INSTALL_DATADIR}/modulefiles)
file(RELATIVE_PATH prefix_of_module ${CMAKE_INSTALL_PREFIX}/${modules}/ehlwave ${CMAKE_INSTALL_PREFIX})
configure_file(${packaging}/modulefile.in ${made}/modulefile @ONLY)
install(FILES ${made}/modulefile DESTINATION ${modules}/ehlwave RENAME ${PROJECT_VERSION} COMPONENT core)

install(DIRECTORY postprocess/src/ehlwave postprocess/src/ehlwave_post DESTINATION ${EHLWAVE_INSTALL_PYTHONDIR} COMPONENT python
        FILES_MATCHING PATTERN "*.py" PATTERN "*.nc" PATTERN "*.json" PATTERN "*.csv" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
# Metadata: `ehlwave --version` and packaging tools find the version there.
file(WRITE ${made}/METADATA "Metadata-Version: 2.1\nName: ehlwave\nVersion: ${PROJECT_VERSION}\n")
file(WRITE ${made}/INSTALLER "cmake\n")
install(FILES ${made}/METADATA ${made}/INSTALLER
        DESTINATION ${EHLWAVE_INSTALL_PYTHONDIR}/ehlwave-${PROJECT_VERSION}.dist-info COMPONENT python)
file(RELATIVE_PATH python_folder ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_PREFIX}/${EHLWAVE_INSTALL_PYTHONDIR})
file(READ postprocess/pyproject.toml python_packages)
string(REGEX REPLACE ".*\ndependencies = \\[([^]]*)\\].*" "\\1" python_packages "${python_packages}")
string(REGEX REPLACE ">=[0-9.]+|[\",\n]" "" python_packages "${python_packages}")
string(STRIP "${python_packages}" python_packages)
string(REGEX REPLACE " +" " " python_packages "${python_packages}")
configure_file(${packaging}/ehlwave.in ${made}/starters/ehlwave @ONLY)
install(PROGRAMS ${made}/starters/ehlwave DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT python)
install(PROGRAMS ${made}/starters/ehlwave DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME ehlwave-post COMPONENT python)
