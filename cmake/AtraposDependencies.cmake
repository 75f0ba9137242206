# Finds what the packages stand on, target by target: atrapos_find(Trilinos::Tpetra), atrapos_find(MUMPS::dmumps), ...
# Trilinos 13.2's exported targets carry no include directories, so each Trilinos package becomes one interface
# target Trilinos::<Name> that does. The same file serves the installed package, which asks only for what the
# components named in find_package(Atrapos COMPONENTS ...) need.
include_guard(DIRECTORY)

# The part of Trilinos that can do without MPI. Where MPI is used, it is found before everything else.
set(atrapos_trilinos_without_mpi Kokkos Sacado)

# Kokkos says which devices the Trilinos at hand was built for, and where that Trilinos is. An installed Atrapos
# names the one it was built with (ATRAPOS_TRILINOS_CMAKE_DIR): no other fits.
macro(atrapos_find_kokkos)
  if(ATRAPOS_TRILINOS_CMAKE_DIR)
    find_package(Kokkos CONFIG REQUIRED PATHS ${ATRAPOS_TRILINOS_CMAKE_DIR}/Kokkos NO_DEFAULT_PATH)
    if(NOT Kokkos_DIR STREQUAL "${ATRAPOS_TRILINOS_CMAKE_DIR}/Kokkos")
      message(FATAL_ERROR "Atrapos was built with the Trilinos in ${ATRAPOS_TRILINOS_CMAKE_DIR}, "
        "Kokkos was found in ${Kokkos_DIR} before: use that Trilinos, or install Atrapos again with the other")
    endif()
  else()
    find_package(Kokkos CONFIG REQUIRED)
  endif()
  if(ATRAPOS_KOKKOS_DEVICE AND NOT ATRAPOS_KOKKOS_DEVICE IN_LIST Kokkos_DEVICES)
    message(FATAL_ERROR "Wanted a Trilinos with the Kokkos device ${ATRAPOS_KOKKOS_DEVICE}; "
      "the one in ${Kokkos_DIR} has ${Kokkos_DEVICES} (see docs/install.md)")
  endif()
endmacro()

# All packages come from one Trilinos: two in one program would not fit together.
function(atrapos_find_trilinos name)
  if(TARGET Trilinos::${name})
    return()
  endif()
  get_filename_component(package_files "${Kokkos_DIR}" DIRECTORY)
  if(${name}_DIR AND NOT ${name}_DIR STREQUAL "${package_files}/${name}")
    message(FATAL_ERROR "${name} was found in ${${name}_DIR} before, Kokkos is in ${Kokkos_DIR}: two different "
      "Trilinos. Configure in a fresh build folder.")
  endif()
  find_package(${name} CONFIG REQUIRED PATHS ${package_files}/${name} NO_DEFAULT_PATH)
  # Some packages forward their libraries only, some none at all (header-only): keep what there is.
  set(libraries ${${name}_LIBRARIES})
  get_filename_component(include_dir "${${name}_DIR}/../../../include" ABSOLUTE)
  list(GET ${name}_INCLUDE_DIRS 0 declared)
  get_filename_component(declared "${declared}" ABSOLUTE)
  if(IS_DIRECTORY "${declared}")
    set(include_dir "${declared}")
  endif()
  add_library(Trilinos::${name} INTERFACE IMPORTED GLOBAL)
  target_include_directories(Trilinos::${name} SYSTEM INTERFACE ${include_dir})
  target_link_libraries(Trilinos::${name} INTERFACE ${libraries})
  if(TARGET MPI::MPI_CXX)
    target_link_libraries(Trilinos::${name} INTERFACE MPI::MPI_CXX)
  endif()
  if(name STREQUAL "Sacado")
    # Views of Fad scalars, which nothing here uses, bring Kokkos, Teuchos and MPI into every source with a law.
    target_compile_definitions(Trilinos::Sacado INTERFACE SACADO_DISABLE_FAD_VIEW_SPEC)
  endif()
  if(Kokkos_DEVICES MATCHES "OPENMP")
    find_package(OpenMP REQUIRED COMPONENTS CXX)
    target_link_libraries(Trilinos::${name} INTERFACE OpenMP::OpenMP_CXX)
  endif()
endfunction()

# A part of the same Trilinos by its library alone: Debian's package files of Anasazi, Belos and Ifpack2 ask for packages
# (Thyra, Xpetra, Zoltan2, AztecOO) that nothing here uses.
function(atrapos_find_trilinos_part target library)
  if(TARGET ${target})
    return()
  endif()
  get_filename_component(directory "${Kokkos_DIR}/../.." ABSOLUTE)
  find_library(ATRAPOS_${library}_LIBRARY NAMES trilinos_${library} ${library} PATHS ${directory} REQUIRED NO_DEFAULT_PATH)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_link_libraries(${target} INTERFACE ${ATRAPOS_${library}_LIBRARY} Trilinos::Tpetra)
endfunction()

# atrapos_find_library(<target> HEADER <file> LIBRARIES <names...>): a library without a package file.
function(atrapos_find_library target)
  cmake_parse_arguments(arg "" "HEADER" "LIBRARIES" ${ARGN})
  string(MAKE_C_IDENTIFIER "${target}" id)
  if(TARGET ${target})
    return()
  endif()
  find_path(${id}_INCLUDE_DIR ${arg_HEADER} PATH_SUFFIXES opencascade REQUIRED)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${${id}_INCLUDE_DIR})
  foreach(name IN LISTS arg_LIBRARIES)
    find_library(${id}_${name}_LIBRARY ${name} REQUIRED)
    target_link_libraries(${target} INTERFACE ${${id}_${name}_LIBRARY})
  endforeach()
endfunction()

# One external target that a package links. Others (Atrapos' own, system libraries) are left alone. A macro: what it
# finds belongs to the calling folder.
macro(atrapos_find target)
  if("${target}" MATCHES "^Trilinos::(Anasazi|Belos|Ifpack2)$")
    string(TOLOWER "${CMAKE_MATCH_1}" atrapos_trilinos_part)
    atrapos_find(Trilinos::Tpetra)
    atrapos_find_trilinos_part(${target} ${atrapos_trilinos_part})
  elseif("${target}" MATCHES "^Trilinos::(.+)$")
    set(atrapos_trilinos_package ${CMAKE_MATCH_1})
    if(NOT atrapos_trilinos_package IN_LIST atrapos_trilinos_without_mpi)
      find_package(MPI REQUIRED COMPONENTS CXX)
    endif()
    atrapos_find_kokkos()
    atrapos_find_trilinos(${atrapos_trilinos_package})
  elseif("${target}" STREQUAL "fmt::fmt")
    find_package(fmt CONFIG REQUIRED)
  elseif("${target}" STREQUAL "MUMPS::dmumps")
    atrapos_find_library(MUMPS::dmumps HEADER dmumps_c.h LIBRARIES dmumps mumps_common)
  elseif("${target}" STREQUAL "MUMPS::smumps")
    atrapos_find_library(MUMPS::smumps HEADER smumps_c.h LIBRARIES smumps mumps_common)
  elseif("${target}" STREQUAL "METIS::metis")
    atrapos_find_library(METIS::metis HEADER metis.h LIBRARIES metis)
  elseif("${target}" STREQUAL "Exodus::exodus")
    atrapos_find_library(Exodus::exodus HEADER exodusII.h LIBRARIES exoIIv2c)
  elseif("${target}" STREQUAL "NetCDF::netcdf")
    atrapos_find_library(NetCDF::netcdf HEADER netcdf.h LIBRARIES netcdf)
  elseif("${target}" STREQUAL "Gmsh::gmsh")
    atrapos_find_library(Gmsh::gmsh HEADER gmsh.h LIBRARIES gmsh)
  elseif("${target}" STREQUAL "OpenCASCADE::exchange")
    atrapos_find_library(OpenCASCADE::exchange HEADER STEPControl_Reader.hxx LIBRARIES TKSTEP TKIGES TKXSBase TKShHealing
      TKTopAlgo TKGeomAlgo TKBRep TKGeomBase TKG3d TKG2d TKMath TKernel)
  endif()
endmacro()
