include(${CMAKE_CURRENT_LIST_DIR}/tested_compilers.cmake)

# The warnings of our own code. They do not apply to projects that embed Punctura.
add_library(punctura_warnings INTERFACE)
if(MSVC)
  target_compile_options(punctura_warnings INTERFACE /W4 /permissive-)
else()
  target_compile_options(punctura_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
  # GCC 12 gives wrong warnings for operator+ of std::string and a vector of strings at -O3 (GCC bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
    target_compile_options(punctura_warnings INTERFACE
      -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
  endif()
  # In our tests, warnings are errors with the tested compilers. Other compilers can have new warnings.
  if(PUNCTURA_TESTS)
    punctura_compiler_is_tested("${CMAKE_CXX_COMPILER_ID}" "${CMAKE_CXX_COMPILER_VERSION}" tested)
    if(tested)
      target_compile_options(punctura_warnings INTERFACE -Werror)
    else()
      message(NOTICE "note: the tests run with GCC 12 and 14 and Clang 14 and 19. With ${CMAKE_CXX_COMPILER_ID} "
                     "${CMAKE_CXX_COMPILER_VERSION}, warnings are not errors")
    endif()
  endif()
endif()
