# Sets OUT to TRUE if the tests run with this compiler: GCC 12 and 14, Clang 14 and 19, the compilers of Debian 12 and
# 13. ID and VERSION are the values of CMake, for example "GNU" and "14.2.0".
function(punctura_compiler_is_tested id version out)
  if("${id} ${version}" MATCHES "^(GNU (12|14)|Clang (14|19))\\.")
    set(${out} TRUE PARENT_SCOPE)
  else()
    set(${out} FALSE PARENT_SCOPE)
  endif()
endfunction()
