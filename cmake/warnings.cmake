# Warnings are errors for our own code, never for those who embed it.
add_library(punctura_warnings INTERFACE)
if(MSVC)
  target_compile_options(punctura_warnings INTERFACE /W4 /permissive-)
else()
  target_compile_options(punctura_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
  # GCC 12 warns of std::string's own operator+ at -O3 (its bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
    target_compile_options(punctura_warnings INTERFACE -Wno-restrict)
  endif()
  # Errors where we test; somebody who only installs, with a compiler that we have not met, shall not fail by a warning.
  if(PUNCTURA_TESTS)
    target_compile_options(punctura_warnings INTERFACE -Werror)
  endif()
endif()
