# Headers that most sources include, read once: they are 3 of the 7 seconds of a source of `path`. One set for
# libraries (position-independent code), one for tests, and one without Trilinos for tests that compute nothing
# themselves.
option(ATRAPOS_PRECOMPILE "Precompile the headers of Trilinos and of the standard library" ON)

set(atrapos_trilinos_headers <Tpetra_CrsMatrix.hpp> <Tpetra_MultiVector.hpp> <Tpetra_Vector.hpp> <Kokkos_Core.hpp>)
set(atrapos_standard_headers <algorithm> <array> <cmath> <functional> <limits> <map> <memory> <stdexcept> <string>
  <utility> <vector>)

# Where little time is spent: a quarter less to compile than with -O3, and 1 % more instructions in a run (docs/install.md).
set(atrapos_lightly $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang>>:-O1>)
# atrapos_sources_with(<options> <source>...): sources that are optimised otherwise than their library; each is compiled by
# itself. Where lines are counted (AtraposCoverage) all are compiled alike: a source's options would come behind those of its target.
function(atrapos_sources_with options)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  if(NOT ATRAPOS_COVERAGE)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${options}")
  endif()
endfunction()
# atrapos_lightly_sources(<source>...): of a library that is optimised else.
function(atrapos_lightly_sources)
  atrapos_sources_with("${atrapos_lightly}" ${ARGN})
endfunction()
# Tests compute next to nothing themselves: optimising them takes as long as compiling them.
set(atrapos_quick $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang>>:-O0>)

# atrapos_precompiled(<target> <library|test|quick>): tests are optimised by their kind, as their headers are.
function(atrapos_precompiled target kind)
  set(options "")
  if(NOT kind STREQUAL "library")
    set(options ${atrapos_quick})
  endif()
  target_compile_options(${target} PRIVATE ${options})
  # With OpenMP those quick tests that link Kokkos are compiled for it and others are not: no header is theirs all.
  if(kind STREQUAL "quick" AND "OPENMP" IN_LIST Kokkos_DEVICES)
    return()
  endif()
  if(NOT ATRAPOS_PRECOMPILE OR (NOT kind STREQUAL "quick" AND NOT TARGET Trilinos::Tpetra))
    return()
  endif()
  set(headers atrapos_precompiled_${kind})
  if(NOT TARGET ${headers})
    set(source ${PROJECT_BINARY_DIR}/precompiled_${kind}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "// Precompiled headers belong to a target, which has a source.\n")
    add_library(${headers} OBJECT ${source})
    target_compile_options(${headers} PRIVATE ${options})
    if(NOT kind STREQUAL "library")  # before Trilinos, which may have headers of a GoogleTest of its own
      atrapos_find_gtest()
      target_link_libraries(${headers} PRIVATE atrapos_gtest)
    endif()
    target_link_libraries(${headers} PRIVATE atrapos_compile_options)
    if(kind STREQUAL "quick")
      target_precompile_headers(${headers} PRIVATE ${atrapos_standard_headers})
    else()
      target_link_libraries(${headers} PRIVATE Trilinos::Tpetra Trilinos::Kokkos)
      target_precompile_headers(${headers} PRIVATE ${atrapos_trilinos_headers} ${atrapos_standard_headers})
    endif()
    if(kind STREQUAL "library")
      set_target_properties(${headers} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    else()
      target_precompile_headers(${headers} PRIVATE <gtest/gtest.h>)
    endif()
  endif()
  atrapos_precompiled_from(${target} ${headers})
endfunction()

# ccache preprocesses first, and needs to see where they were used.
function(atrapos_precompiled_for_ccache target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
  endif()
endfunction()

# atrapos_precompiled_own(<target> <header>...): headers that most of this target's sources include.
function(atrapos_precompiled_own target)
  if(ATRAPOS_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${ARGN})
    atrapos_precompiled_for_ccache(${target})
  endif()
endfunction()

# atrapos_precompiled_from(<target> <other>): those of another target.
function(atrapos_precompiled_from target other)
  if(ATRAPOS_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${other})
    atrapos_precompiled_for_ccache(${target})
  endif()
endfunction()
