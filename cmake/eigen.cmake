# Eigen from the folder named, else from the PyPI wheel in the build's own environment, else from the system.
# The wheel goes first when Python builds the extension: a system Eigen of another version must not mix in.
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
  add_library(punctura_eigen INTERFACE)
  add_library(Eigen3::Eigen ALIAS punctura_eigen)
  target_include_directories(punctura_eigen SYSTEM INTERFACE $<BUILD_INTERFACE:${PUNCTURA_EIGEN_DIR}>)
else()
  find_package(Eigen3 3.3 REQUIRED NO_MODULE)
endif()
