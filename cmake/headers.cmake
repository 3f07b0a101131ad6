# Compiles each header of core and runtime in its own source file. A header must include all that it needs and must
# compile without a warning. Each source file includes its header twice, to detect a missing #pragma once.
function(punctura_add_header_checks target)
  file(GLOB_RECURSE core CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/core ${PROJECT_SOURCE_DIR}/core/*.hpp)
  file(GLOB_RECURSE runtime CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/runtime
       ${PROJECT_SOURCE_DIR}/runtime/*.hpp)
  set(headers ${core} ${runtime})
  set(sources)
  foreach(header IN LISTS headers)
    string(MAKE_C_IDENTIFIER ${header} name)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/headers/${name}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "#include \"@header@\"\n#include \"@header@\"\n" @ONLY)
    list(APPEND sources ${source})
  endforeach()
  add_library(${target} STATIC EXCLUDE_FROM_ALL ${sources})
  target_link_libraries(${target} PRIVATE punctura::runtime punctura_warnings)
  if(NOT MSVC)
    target_compile_options(${target} PRIVATE -O0 -g0 -fno-sanitize=all)  # this code never runs
  endif()
endfunction()
