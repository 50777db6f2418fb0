# SPDX-License-Identifier: BSD-3-Clause
# delos_layer(NAME SOURCES a.cpp ... [DEPENDS layer ...] [LIBRARIES target ...])
#   one folder, one layer, one OBJECT target delos_NAME. DEPENDS names the layers that it may include.
# delos_layer_closure(OUT layer ...): these layers and all below them.

function(delos_target_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # The same bits from every compiler: no fused multiply-add unless the code asks for one.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -ffp-contract=off -fno-math-errno
    -fno-trapping-math $<$<BOOL:${DELOS_WERROR}>:-Werror> $<$<BOOL:${DELOS_NATIVE}>:-march=native>)
  # Eigen's own vector code depends on the instruction set; three-vectors gain nothing from it.
  target_compile_definitions(${target} PRIVATE EIGEN_DONT_VECTORIZE EIGEN_MPL2_ONLY
    $<$<OR:$<CONFIG:Debug>,$<BOOL:${DELOS_ASSERTS}>>:DELOS_ENABLE_ASSERTS>)
  # GCC 12 sees overlaps in string concatenations that are none (GCC bug 105651).
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
  if(CMAKE_UNITY_BUILD)  # GCC takes a .cpp that is included for a header
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
  if(DELOS_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${DELOS_SANITIZE} -fno-sanitize-recover=all
      -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${DELOS_SANITIZE})
  endif()
endfunction()

function(delos_layer name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;LIBRARIES" ${ARGN})
  set(target delos_${name})
  add_library(${target} OBJECT ${arg_SOURCES})
  delos_target_options(${target})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  # Usage requirements travel through an interface target; objects do not: delos_layer_closure
  # collects them once.
  add_library(${target}_usage INTERFACE)
  target_include_directories(${target}_usage INTERFACE ${PROJECT_SOURCE_DIR}/component)
  list(TRANSFORM arg_DEPENDS REPLACE "(.+)" "delos_\\1_usage" OUTPUT_VARIABLE below)
  target_link_libraries(${target}_usage INTERFACE ${arg_LIBRARIES} ${below})
  target_link_libraries(${target} PUBLIC ${target}_usage)
  set_property(GLOBAL PROPERTY DELOS_DEPENDS_${name} ${arg_DEPENDS})
  set_property(GLOBAL APPEND PROPERTY DELOS_LAYERS ${name})
endfunction()

function(delos_layer_closure out)
  set(todo ${ARGN})
  set(done "")
  while(todo)
    list(POP_FRONT todo layer)
    if(NOT layer IN_LIST done)
      list(APPEND done ${layer})
      get_property(below GLOBAL PROPERTY DELOS_DEPENDS_${layer})
      list(APPEND todo ${below})
    endif()
  endwhile()
  set(${out} ${done} PARENT_SCOPE)
endfunction()
