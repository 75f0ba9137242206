# Headers that most sources include, read once: they are 3 of the 7 seconds of a source of `path`. One set for
# libraries (position-independent code), one for tests.
option(ATRAPOS_PRECOMPILE "Precompile the headers of Trilinos and of the standard library" ON)

set(atrapos_precompiled_headers <Tpetra_CrsMatrix.hpp> <Tpetra_MultiVector.hpp> <Tpetra_Vector.hpp>
  <Kokkos_Core.hpp> <algorithm> <array> <cmath> <functional> <limits> <map> <memory> <stdexcept> <string> <utility>
  <vector>)

# atrapos_precompiled(<target> <library|test>)
function(atrapos_precompiled target kind)
  if(NOT ATRAPOS_PRECOMPILE OR NOT TARGET Trilinos::Tpetra)
    return()
  endif()
  set(headers atrapos_precompiled_${kind})
  if(NOT TARGET ${headers})
    set(source ${PROJECT_BINARY_DIR}/precompiled_${kind}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "// Precompiled headers belong to a target, which has a source.\n")
    add_library(${headers} OBJECT ${source})
    if(kind STREQUAL "test")  # before Trilinos, which may have headers of a GoogleTest of its own
      atrapos_find_gtest()
      target_link_libraries(${headers} PRIVATE atrapos_gtest)
    endif()
    target_link_libraries(${headers} PRIVATE atrapos_compile_options Trilinos::Tpetra Trilinos::Kokkos)
    target_precompile_headers(${headers} PRIVATE ${atrapos_precompiled_headers})
    if(kind STREQUAL "library")
      set_target_properties(${headers} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    elseif(kind STREQUAL "test")
      target_precompile_headers(${headers} PRIVATE <gtest/gtest.h>)
    endif()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${headers})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # ccache preprocesses first, and needs to see where they were used
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
  endif()
endfunction()
