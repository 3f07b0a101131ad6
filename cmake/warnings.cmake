include(${CMAKE_CURRENT_LIST_DIR}/tested_compilers.cmake)

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
  # Errors in our tests, with the compilers that they are run with: another one may warn of what no one has seen yet.
  if(PUNCTURA_TESTS)
    punctura_compiler_is_tested("${CMAKE_CXX_COMPILER_ID}" "${CMAKE_CXX_COMPILER_VERSION}" tested)
    if(tested)
      target_compile_options(punctura_warnings INTERFACE -Werror)
    else()
      message(NOTICE "note: the tests are run with GCC 12 and 14 and Clang 14 and 19; with ${CMAKE_CXX_COMPILER_ID} "
                     "${CMAKE_CXX_COMPILER_VERSION} warnings are no errors")
    endif()
  endif()
endif()
