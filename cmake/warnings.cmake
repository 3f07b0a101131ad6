# Warnings are errors for our own code, never for those who embed it.
add_library(punctura_warnings INTERFACE)
if(MSVC)
  target_compile_options(punctura_warnings INTERFACE /W4 /permissive-)
else()
  target_compile_options(punctura_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
  # Errors where we test; somebody who only installs, with a compiler that we have not met, shall not fail by a warning.
  if(PUNCTURA_TESTS)
    target_compile_options(punctura_warnings INTERFACE -Werror)
  endif()
endif()
