# `cmake --install`: the program, the library, its headers, and the package that find_package(meshgraft) finds.

include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/meshgraft)

install(TARGETS meshgraft EXPORT meshgraft-targets)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/meshgraft DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT meshgraft-targets NAMESPACE meshgraft:: DESTINATION ${package})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/meshgraft-config.cmake.in
  ${PROJECT_BINARY_DIR}/meshgraft-config.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/meshgraft-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/meshgraft-config.cmake ${PROJECT_BINARY_DIR}/meshgraft-config-version.cmake
  DESTINATION ${package})
