# Kernels for several instruction sets in one program: sources with ATRAPOS_POINT_LAW (fem/PointLawOf.hpp) are compiled
# once for all but the kernels, and once for each level, for the kernels alone; the level is chosen when a program
# starts (fem/Processor.hpp). Without levels they are compiled once, for the instruction set of everything else.
set(levels "")
if(NOT ATRAPOS_NATIVE AND CMAKE_BUILD_TYPE STREQUAL "Release" AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$"
    AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  set(levels v2 v3 v4)
endif()
set(ATRAPOS_KERNEL_LEVELS "${levels}" CACHE STRING "v2;v3;v4: kernels for these x86-64 levels; empty: for one")
if(ATRAPOS_KERNEL_LEVELS AND NOT ATRAPOS_KERNEL_LEVELS STREQUAL "v2;v3;v4")
  message(FATAL_ERROR "ATRAPOS_KERNEL_LEVELS is \"v2;v3;v4\" or empty, got \"${ATRAPOS_KERNEL_LEVELS}\"")
endif()
if(ATRAPOS_KERNEL_LEVELS AND ATRAPOS_NATIVE)
  message(FATAL_ERROR "ATRAPOS_NATIVE compiles for this machine alone: set ATRAPOS_KERNEL_LEVELS to nothing")
endif()

# atrapos_kernels(<target> <sources...>)
#
# The linker keeps one copy of an inline function that several objects have, which might be one that the processor
# cannot run: a level's objects become one, in which nothing but the tables of kernels is visible from outside.
function(atrapos_kernels target)
  target_sources(${target} PRIVATE ${ARGN})
  if(NOT ATRAPOS_KERNEL_LEVELS)
    return()
  endif()
  target_compile_definitions(${target} PRIVATE ATRAPOS_KERNEL_LEVELS)
  foreach(level IN LISTS ATRAPOS_KERNEL_LEVELS)
    set(objects ${target}_${level})
    add_library(${objects} OBJECT ${ARGN})
    target_compile_definitions(${objects} PRIVATE ATRAPOS_KERNEL_LEVEL)
    target_compile_options(${objects} PRIVATE -march=x86-64-${level})
    target_include_directories(${objects} PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
    target_link_libraries(${objects} PRIVATE $<BUILD_INTERFACE:atrapos_compile_options>
      $<TARGET_PROPERTY:${target},LINK_LIBRARIES>)
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
