# cmake --install: headers, libraries, command and a package file for find_package(Atrapos).
include(CMakePackageConfigHelpers)

get_property(packages GLOBAL PROPERTY ATRAPOS_INSTALLED_PACKAGES)
get_property(headers GLOBAL PROPERTY ATRAPOS_INSTALLED_HEADERS)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Atrapos)

install(TARGETS ${packages} EXPORT AtraposTargets)
install(DIRECTORY ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT AtraposTargets NAMESPACE Atrapos:: DESTINATION ${package_dir})

get_filename_component(ATRAPOS_TRILINOS_CMAKE_DIR "${Kokkos_DIR}" DIRECTORY)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/AtraposConfig.cmake.in
  ${PROJECT_BINARY_DIR}/AtraposConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/AtraposConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/AtraposConfig.cmake ${PROJECT_BINARY_DIR}/AtraposConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/AtraposDependencies.cmake DESTINATION ${package_dir})
