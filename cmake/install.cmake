# Installs the headers of core, and the runtime if it is built. find_package(punctura) provides punctura::punctura.
# find_package(punctura COMPONENTS runtime) also provides punctura::loop and punctura::runtime. A wheel has the headers
# of both, but no compiled runtime: the static library of one compiler may not link with code of another.
include(CMakePackageConfigHelpers)

set(punctura_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/punctura)
set(architecture ARCH_INDEPENDENT)
set(PUNCTURA_HAS_RUNTIME OFF)
install(DIRECTORY core/punctura DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(TARGETS punctura EXPORT punctura)
if(TARGET punctura_runtime)
  install(DIRECTORY runtime/punctura_runtime DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
endif()
if(TARGET punctura_runtime AND NOT PUNCTURA_PYTHON)
  set(architecture "")
  set(PUNCTURA_HAS_RUNTIME ON)
  install(TARGETS punctura_loop punctura_runtime punctura_batch EXPORT punctura)
endif()
install(EXPORT punctura NAMESPACE punctura:: FILE punctura-targets.cmake DESTINATION ${punctura_config_dir})

configure_package_config_file(cmake/punctura-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/punctura-config.cmake
  INSTALL_DESTINATION ${punctura_config_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/punctura-config-version.cmake
  COMPATIBILITY SameMinorVersion ${architecture})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/punctura-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/punctura-config-version.cmake
  DESTINATION ${punctura_config_dir})
