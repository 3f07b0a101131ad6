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
