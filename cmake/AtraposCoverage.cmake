# Lines counted by gcov (scripts/coverage): those of the libraries and of the command, without optimisation. Tests, and
# kernels for the levels of processors, are compiled as ever: runs stay fast.
set(counted -O0 --coverage -fprofile-update=atomic)
foreach(target IN ITEMS ${atrapos_packages_here} models app deck import gmsh precompiled_library)
  set(target atrapos_${target})
  if(TARGET ${target})
    get_target_property(type ${target} TYPE)
    if(NOT type STREQUAL "INTERFACE_LIBRARY")
      target_compile_options(${target} PRIVATE ${counted})
      target_link_options(${target} INTERFACE --coverage)
    endif()
  endif()
endforeach()
target_compile_options(atrapos PRIVATE ${counted})
