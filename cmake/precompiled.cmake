# punctura_precompile(TARGET [HEADER...]) precompiles the common standard headers, and the given headers, for a target.
# Without it, each file takes a second to parse them.
#
# Precompiled headers hide a missing #include. Therefore tools/check_includes.py looks for it. `./test consumer`
# compiles the servo loop, `./test tidy` each header, and the preset "release" the whole runtime, without precompiled
# headers.
# CMAKE_DISABLE_PRECOMPILE_HEADERS=ON disables them.
function(punctura_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <cstdint> <filesystem> <functional> <limits>
    <map> <memory> <mutex> <optional> <span> <string> <system_error> <thread> <utility> <vector> ${ARGN})
endfunction()

# punctura_together(TARGET GROUP SOURCE...) compiles the given sources of a target as one source file. So the templates
# that they share are compiled once.
#
# Therefore a name in an unnamed namespace exists only once in a group; an overload would compile, and be a trap.
# PUNCTURA_TOGETHER=OFF compiles each source alone, as clang-tidy does; then a change of one test is compiled sooner.
option(PUNCTURA_TOGETHER "Compile sources together in groups" ON)
function(punctura_together target group)
  if(PUNCTURA_TOGETHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    set_source_files_properties(${ARGN} PROPERTIES UNITY_GROUP ${group})
  endif()
endfunction()

# punctura_tests_together(TARGET SOURCE...) does so with the tests in two groups, in the given order, for two cores.
function(punctura_tests_together target)
  list(LENGTH ARGN all)
  set(count 0)
  foreach(source IN LISTS ARGN)
    math(EXPR group "2 * ${count} / ${all}")
    math(EXPR count "${count} + 1")
    punctura_together(${target} ${group} ${source})
  endforeach()
endfunction()

# In a group of tests, a local name may equal a name of another file. Link this library after punctura_warnings.
add_library(punctura_no_shadow INTERFACE)
if(NOT MSVC)
  target_compile_options(punctura_no_shadow INTERFACE -Wno-shadow)
endif()
