# cmake --install: headers, libraries, command and package files for find_package(Atrapos). One export set per
# package: a component is found without what it does not need.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Atrapos)
get_property(ATRAPOS_INSTALLED_COMPONENTS GLOBAL PROPERTY ATRAPOS_INSTALLED_PACKAGES)
set(components_file ${PROJECT_BINARY_DIR}/AtraposComponents.cmake)
file(WRITE ${components_file} "# What each component links.\n")
foreach(package IN LISTS ATRAPOS_INSTALLED_COMPONENTS)
  install(TARGETS atrapos_${package} EXPORT Atrapos_${package})
  install(EXPORT Atrapos_${package} NAMESPACE Atrapos:: DESTINATION ${package_dir})
  get_property(depends GLOBAL PROPERTY ATRAPOS_DEPENDS_${package})
  file(APPEND ${components_file} "set(Atrapos_${package}_DEPENDS ${depends})\n")
endforeach()
get_property(headers GLOBAL PROPERTY ATRAPOS_INSTALLED_HEADERS)
install(DIRECTORY ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

get_filename_component(ATRAPOS_TRILINOS_CMAKE_DIR "${Kokkos_DIR}" DIRECTORY)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/AtraposConfig.cmake.in
  ${PROJECT_BINARY_DIR}/AtraposConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/AtraposConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/AtraposConfig.cmake ${PROJECT_BINARY_DIR}/AtraposConfigVersion.cmake
  ${components_file} ${PROJECT_SOURCE_DIR}/cmake/AtraposDependencies.cmake DESTINATION ${package_dir})
