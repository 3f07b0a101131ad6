# Installs the core for header-only use: find_package(punctura) and link punctura::punctura.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(punctura_config_dir ${CMAKE_INSTALL_DATADIR}/cmake/punctura)
install(DIRECTORY core/punctura DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(TARGETS punctura EXPORT punctura)
install(EXPORT punctura NAMESPACE punctura:: FILE punctura-targets.cmake DESTINATION ${punctura_config_dir})

configure_package_config_file(cmake/punctura-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/punctura-config.cmake
  INSTALL_DESTINATION ${punctura_config_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/punctura-config-version.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/punctura-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/punctura-config-version.cmake
  DESTINATION ${punctura_config_dir})
