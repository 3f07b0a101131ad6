# The standard headers that cost each file a second to parse, parsed once a target. Only these: each of our headers is compiled alone
# by the tests, and the presets "release" and "tidy" compile every source without them, so that a missing #include shows.
# punctura_precompile(TARGET [HEADER...]): HEADERs are further ones of other people's.
function(punctura_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <cstdint> <filesystem> <functional> <limits> <map> <memory> <mutex>
    <optional> <span> <string> <system_error> <thread> <utility> <vector> ${ARGN})
endfunction()
