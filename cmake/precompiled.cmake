# punctura_precompile(TARGET [HEADER...]) precompiles the common standard headers, and the given headers, for a target.
# Without it, each file takes a second to parse them.
#
# Precompiled headers hide a missing #include. Therefore the tests compile each of our headers alone. `./test
# consumer` compiles the servo loop, and the preset "release" the whole runtime, without precompiled headers.
# CMAKE_DISABLE_PRECOMPILE_HEADERS=ON disables them.
function(punctura_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <cstdint> <filesystem> <functional> <limits>
    <map> <memory> <mutex> <optional> <span> <string> <system_error> <thread> <utility> <vector> ${ARGN})
endfunction()

# punctura_together(TARGET SOURCE...) compiles the given sources of a target in groups. A group has up to six files of
# one folder, which are compiled as one source file. So the templates that they share are compiled once per group.
#
# Therefore a name exists only once among the sources of a folder, also in an unnamed namespace. PUNCTURA_TOGETHER=OFF
# compiles each source alone, as clang-tidy does.
option(PUNCTURA_TOGETHER "Compile the tests of a folder together" ON)
function(punctura_together target)
  if(NOT PUNCTURA_TOGETHER)
    return()
  endif()
  set(most 6)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS ARGN)
    get_filename_component(folder ${source} DIRECTORY)
    get_filename_component(name ${folder} NAME)
    list(APPEND ${name}_sources ${source})
    list(LENGTH ${name}_sources count)
    math(EXPR group "(${count} - 1) / ${most}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${name}_${group})
  endforeach()
endfunction()

# In a group of tests, a local name may equal a name of another file. Link this library after punctura_warnings.
add_library(punctura_no_shadow INTERFACE)
if(NOT MSVC)
  target_compile_options(punctura_no_shadow INTERFACE -Wno-shadow)
endif()
