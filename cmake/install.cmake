# Installs the headers of core, and the runtime if it is built. find_package(punctura) provides punctura::punctura.
# find_package(punctura COMPONENTS runtime) also provides punctura::loop and punctura::runtime, and
# find_package(punctura COMPONENTS c) punctura::c, the shared library with the C ABI. A wheel has the headers of core
# and runtime, but no compiled runtime: the static library of one compiler may not link with code of another.
include(CMakePackageConfigHelpers)

set(punctura_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/punctura)
set(architecture ARCH_INDEPENDENT)
set(PUNCTURA_HAS_RUNTIME OFF)
set(PUNCTURA_HAS_C OFF)
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
if(TARGET punctura_c AND NOT PUNCTURA_PYTHON)
  set(architecture "")
  set(PUNCTURA_HAS_C ON)
  install(TARGETS punctura_c EXPORT punctura)
  install(FILES capi/include/punctura.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  configure_file(cmake/punctura.pc.in ${CMAKE_CURRENT_BINARY_DIR}/punctura.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/punctura.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endif()
install(EXPORT punctura NAMESPACE punctura:: FILE punctura-targets.cmake DESTINATION ${punctura_config_dir})

configure_package_config_file(cmake/punctura-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/punctura-config.cmake
  INSTALL_DESTINATION ${punctura_config_dir})
# One minor version is one interface. Who states a range, as 0.1...<1, has chosen.
foreach(rule SameMinorVersion AnyNewerVersion)
  write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/punctura-${rule}.cmake COMPATIBILITY ${rule}
    ${architecture})
endforeach()
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/punctura-config-version.cmake "\
if(PACKAGE_FIND_VERSION_RANGE)
  include(\${CMAKE_CURRENT_LIST_DIR}/punctura-AnyNewerVersion.cmake)
else()
  include(\${CMAKE_CURRENT_LIST_DIR}/punctura-SameMinorVersion.cmake)
endif()
")
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/punctura-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/punctura-config-version.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/punctura-SameMinorVersion.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/punctura-AnyNewerVersion.cmake
  DESTINATION ${punctura_config_dir})
