# Helpers shared by the packages' CMakeLists.

add_library(atrapos_compile_options INTERFACE)
target_compile_features(atrapos_compile_options INTERFACE cxx_std_17)
target_compile_options(atrapos_compile_options INTERFACE
  $<BUILD_INTERFACE:-Wall -Wextra -Wno-unknown-pragmas>
  $<$<AND:$<BOOL:${ATRAPOS_NATIVE}>,$<CONFIG:Release>>:-march=native>)

# atrapos_package(<name> [SOURCES ...] [DEPENDS ...] [PRIVATE_DEPENDS ...])
# One library target atrapos_<name>, alias Atrapos::<name>; header-only where SOURCES is empty.
function(atrapos_package name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target atrapos_${name})
  if(arg_SOURCES)
    add_library(${target} ${arg_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:atrapos_compile_options>)
    target_link_libraries(${target} PRIVATE ${arg_PRIVATE_DEPENDS})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(Atrapos::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} ${scope} cxx_std_17)
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} ${scope} ${arg_DEPENDS})
  set_property(GLOBAL APPEND PROPERTY ATRAPOS_INSTALLED_PACKAGES ${target})
  set_property(GLOBAL APPEND PROPERTY ATRAPOS_INSTALLED_HEADERS ${CMAKE_CURRENT_SOURCE_DIR}/include/)
endfunction()

# atrapos_test(<name> SOURCES ... DEPENDS ... [LABELS unit] [RANKS n] [ENVIRONMENT ...])
# One GoogleTest executable and one ctest entry. Its main starts MPI and Kokkos, once.
function(atrapos_test name)
  if(NOT BUILD_TESTING)
    return()
  endif()
  cmake_parse_arguments(arg "" "RANKS;TIMEOUT" "SOURCES;DEPENDS;LABELS;ENVIRONMENT" ${ARGN})
  atrapos_find_gtest()
  add_executable(${name} ${arg_SOURCES} ${PROJECT_SOURCE_DIR}/test/support/main.cpp)
  target_link_libraries(${name} PRIVATE atrapos_gtest ${arg_DEPENDS} Trilinos::Kokkos
    atrapos_compile_options)
  if(NOT arg_LABELS)
    set(arg_LABELS unit)
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  if(arg_RANKS)
    add_test(NAME ${name} COMMAND ${MPIEXEC_EXECUTABLE} --oversubscribe ${MPIEXEC_NUMPROC_FLAG} ${arg_RANKS}
      $<TARGET_FILE:${name}>)
    list(APPEND arg_LABELS mpi)
    set_tests_properties(${name} PROPERTIES PROCESSORS ${arg_RANKS})
  else()
    add_test(NAME ${name} COMMAND ${name})
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT}
    ENVIRONMENT "OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMP_PROC_BIND=false;${arg_ENVIRONMENT}")
endfunction()

# The distribution's GoogleTest. A Trilinos prefix may carry headers of its own copy, which would
# shadow the distribution's; a link farm put first on the search path restores the right ones.
function(atrapos_find_gtest)
  if(TARGET atrapos_gtest)
    return()
  endif()
  find_package(GTest CONFIG REQUIRED)
  add_library(atrapos_gtest INTERFACE IMPORTED GLOBAL)
  set(farm ${CMAKE_BINARY_DIR}/gtest-include)
  find_path(gtest_include gtest/gtest.h PATHS /usr/include NO_DEFAULT_PATH NO_CACHE)
  if(gtest_include)
    file(MAKE_DIRECTORY ${farm})
    foreach(directory gtest gmock)
      if(EXISTS ${gtest_include}/${directory})
        file(CREATE_LINK ${gtest_include}/${directory} ${farm}/${directory} SYMBOLIC)
      endif()
    endforeach()
    target_include_directories(atrapos_gtest BEFORE INTERFACE ${farm})
  endif()
  target_link_libraries(atrapos_gtest INTERFACE GTest::gtest)
endfunction()
