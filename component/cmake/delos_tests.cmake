# SPDX-License-Identifier: BSD-3-Clause
# delos_tests(LABEL SOURCES <layer>_<source>_test.cpp ... [LAYERS layer ...] [TIMEOUT s])
#   one doctest executable LABEL_tests, every test case a ctest with that label.
#   DELOS_TEST_LAYERS keeps only the files of these layers and links only what they need.
function(delos_tests label)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;LIBRARIES" ${ARGN})
  set(sources ${arg_SOURCES})
  if(NOT TARGET delos_pictures)
    list(FILTER sources EXCLUDE REGEX "^pictures_")
  endif()
  get_property(layers GLOBAL PROPERTY DELOS_LAYERS)
  list(REMOVE_ITEM layers app)
  if(DELOS_TEST_LAYERS)
    set(layers ${DELOS_TEST_LAYERS})
    set(all_sources ${sources})
    set(sources "")
    foreach(source IN LISTS all_sources)
      string(REGEX REPLACE "_.*" "" layer ${source})
      if(layer IN_LIST DELOS_TEST_LAYERS)
        list(APPEND sources ${source})
      endif()
    endforeach()
  endif()
  if(NOT sources)
    return()
  endif()
  delos_layer_closure(linked ${layers})
  list(TRANSFORM linked PREPEND delos_)
  add_executable(${label}_tests ${PROJECT_SOURCE_DIR}/tests/support/main.cpp ${sources})
  delos_target_options(${label}_tests)
  # What is measured and compared is the library; its tests need not be fast, but soon compiled.
  target_compile_options(${label}_tests PRIVATE $<$<CONFIG:Release>:-O1>)
  if(DELOS_SANITIZE)
    target_compile_options(${label}_tests PRIVATE -O0)
  endif()
  target_include_directories(${label}_tests PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${label}_tests PRIVATE DELOS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${label}_tests PRIVATE ${linked} doctest::doctest ${arg_LIBRARIES})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  if(DELOS_SANITIZE)  # some twenty times slower
    math(EXPR arg_TIMEOUT "3 * ${arg_TIMEOUT}")
  endif()
  doctest_discover_tests(${label}_tests PROPERTIES LABELS ${label} TIMEOUT ${arg_TIMEOUT})
endfunction()

# delos_mpi_test(NAME N_PROCESSES COMMAND...): a job of some processes on whatever cores there are.
function(delos_mpi_test name n_processes)
  add_test(NAME "${name}" COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${n_processes}
    ${MPIEXEC_PREFLAGS} ${ARGN} ${MPIEXEC_POSTFLAGS})
  # Open MPI wants these, as root and with more processes than cores.
  set(environment OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe)
  # MPICH's transports lose a kilobyte in modules that they have unloaded, which no suppression names.
  if(DELOS_SANITIZE)
    list(APPEND environment ASAN_OPTIONS=detect_leaks=0)
  endif()
  set_tests_properties("${name}" PROPERTIES LABELS mpi TIMEOUT 60 PROCESSORS 2
    ENVIRONMENT "${environment}")
endfunction()
