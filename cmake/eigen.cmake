# Eigen from the folder named, else from the PyPI wheel cmeel-eigen where Python builds the extension, else from the system.
# The wheel goes before the system's: two Eigens of different versions must not mix.
if(PUNCTURA_PYTHON AND NOT PUNCTURA_EIGEN_DIR)
  find_package(Python 3.10 REQUIRED COMPONENTS Interpreter Development.Module)
  execute_process(
    COMMAND ${Python_EXECUTABLE} -c "import cmeel, pathlib; print(pathlib.Path(cmeel.__path__[0]).parent / 'cmeel.prefix/include/eigen3')"
    OUTPUT_VARIABLE wheel OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(wheel AND EXISTS ${wheel}/Eigen/Core)
    set(PUNCTURA_EIGEN_DIR ${wheel})
  endif()
endif()

if(PUNCTURA_EIGEN_DIR)
  if(NOT EXISTS ${PUNCTURA_EIGEN_DIR}/Eigen/Core)
    message(FATAL_ERROR "PUNCTURA_EIGEN_DIR = ${PUNCTURA_EIGEN_DIR} holds no Eigen/Core")
  endif()
  # Imported: its headers count as the system's (no warnings from them), and an installed Punctura refers to it by name only.
  add_library(Eigen3::Eigen INTERFACE IMPORTED GLOBAL)
  set_target_properties(Eigen3::Eigen PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${PUNCTURA_EIGEN_DIR}")
else()
  find_package(Eigen3 3.3 REQUIRED NO_MODULE)
endif()
