# The standard headers that cost each file a second to parse, parsed once a target. A missing #include then stays unseen. So each of our
# headers is compiled alone by the tests, `./test consumer` compiles the servo loop without them, and so does the preset "release" with
# the whole runtime. CMAKE_DISABLE_PRECOMPILE_HEADERS=ON switches them off.
# punctura_precompile(TARGET [HEADER...]): HEADERs are further ones of other people's.
function(punctura_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <cstdint> <filesystem> <functional> <limits> <map> <memory> <mutex>
    <optional> <span> <string> <system_error> <thread> <utility> <vector> ${ARGN})
endfunction()
