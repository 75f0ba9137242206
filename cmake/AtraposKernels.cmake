# Kernels for several instruction sets in one program: sources with ATRAPOS_POINT_LAW (fem/PointLawOf.hpp) are compiled
# once for all but the kernels, and once for each level, for the kernels alone; the level is chosen when a program
# starts (fem/Processor.hpp). Without levels they are compiled once, for the instruction set of everything else.
set(levels "")
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$"
    AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  set(levels v2 v3 v4)
endif()
set(ATRAPOS_KERNEL_LEVELS "${levels}" CACHE STRING
  "v2;v3;v4 or some of these: kernels for these x86-64 levels; best among them: for the highest of this machine; empty: for one")
set(levels "${ATRAPOS_KERNEL_LEVELS}")
if("best" IN_LIST levels)
  include(AtraposProcessor)
  set(best "")
  foreach(level v2 v3 v4)
    if(ATRAPOS_PROCESSOR_HAS_${level})
      set(best ${level})
    endif()
  endforeach()
  list(TRANSFORM levels REPLACE "^best$" "${best}")
  list(REMOVE_ITEM levels "")
  list(REMOVE_DUPLICATES levels)
endif()
set(ATRAPOS_KERNEL_LEVELS "${levels}")
# What the sources see of it: the sum of their lanes (fem/Processor.hpp).
set(lanes 0)
foreach(level IN LISTS ATRAPOS_KERNEL_LEVELS)
  if(level STREQUAL "v2")
    math(EXPR lanes "${lanes} | 2")
  elseif(level STREQUAL "v3")
    math(EXPR lanes "${lanes} | 4")
  elseif(level STREQUAL "v4")
    math(EXPR lanes "${lanes} | 8")
  else()
    message(FATAL_ERROR "ATRAPOS_KERNEL_LEVELS is a list of v2, v3, v4 and best, or empty; got \"${ATRAPOS_KERNEL_LEVELS}\"")
  endif()
endforeach()
set(ATRAPOS_KERNEL_LANES ${lanes})

# atrapos_kernels(<target> <sources...> [WITH_TRILINOS] [LIGHTLY_BESIDE])
#
# LIGHTLY_BESIDE: beside its kernels the target sets up, and is optimised little: half the time of a law's source.
#
# A level's objects see nothing of Trilinos (taylor/FunctionMarks.hpp), but with WITH_TRILINOS: laws that solve equations
# of their own (taylor/Implicit.hpp) or read Kokkos' views.
#
# The linker keeps one copy of an inline function that several objects have, which might be one that the processor
# cannot run: a level's objects become one, in which nothing but the tables of kernels is visible from outside.
function(atrapos_kernels target)
  cmake_parse_arguments(arg "WITH_TRILINOS;LIGHTLY_BESIDE" "" "" ${ARGN})
  set(sources ${arg_UNPARSED_ARGUMENTS})
  target_sources(${target} PRIVATE ${sources})
  set_source_files_properties(${sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)  # half a minute each as they are
  if(NOT ATRAPOS_KERNEL_LEVELS)
    return()
  endif()
  target_compile_definitions(${target} PRIVATE ATRAPOS_KERNEL_LEVELS=${ATRAPOS_KERNEL_LANES})
  if(arg_LIGHTLY_BESIDE)
    target_compile_options(${target} PRIVATE ${atrapos_lightly})
  endif()
  foreach(level IN LISTS ATRAPOS_KERNEL_LEVELS)
    set(objects ${target}_${level})
    add_library(${objects} OBJECT ${sources})
    target_compile_definitions(${objects} PRIVATE ATRAPOS_KERNEL_LEVEL)
    target_compile_options(${objects} PRIVATE -march=x86-64-${level})
    target_link_libraries(${objects} PRIVATE $<BUILD_INTERFACE:atrapos_compile_options>)
    if(arg_WITH_TRILINOS)
      target_include_directories(${objects} PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
      target_link_libraries(${objects} PRIVATE $<TARGET_PROPERTY:${target},LINK_LIBRARIES>)
    else()
      target_compile_definitions(${objects} PRIVATE ATRAPOS_WITHOUT_TRILINOS)
      foreach(package IN LISTS ATRAPOS_PACKAGES)
        target_include_directories(${objects} PRIVATE ${PROJECT_SOURCE_DIR}/packages/${package}/include)
      endforeach()
    endif()
    set_target_properties(${objects} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    set(joined ${CMAKE_CURRENT_BINARY_DIR}/${target}_kernels_${level}.o)
    add_custom_command(OUTPUT ${joined}
      COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${joined} $<TARGET_OBJECTS:${objects}>
      COMMAND ${CMAKE_OBJCOPY} --wildcard --keep-global-symbol=*KernelsOf*table* ${joined}
      DEPENDS $<TARGET_OBJECTS:${objects}> COMMAND_EXPAND_LISTS VERBATIM)
    set_source_files_properties(${joined} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
    target_sources(${target} PRIVATE ${joined})
  endforeach()
endfunction()

# atrapos_test_levels(<test>...): these tests once more for each level, <test>_<level>.
if(ATRAPOS_KERNEL_LEVELS AND BUILD_TESTING)
  include(AtraposProcessor)
endif()
function(atrapos_test_levels)
  if(NOT BUILD_TESTING)
    return()
  endif()
  foreach(level IN LISTS ATRAPOS_KERNEL_LEVELS)
    foreach(test IN LISTS ARGN)
      get_test_property(${test} ENVIRONMENT environment)
      add_test(NAME ${test}_${level} COMMAND ${test})
      set_tests_properties(${test}_${level} PROPERTIES LABELS unit ENVIRONMENT "${environment};ATRAPOS_KERNELS=${level}")
      if(NOT ATRAPOS_PROCESSOR_HAS_${level})
        set_tests_properties(${test}_${level} PROPERTIES DISABLED TRUE)
      endif()
    endforeach()
  endforeach()
endfunction()
