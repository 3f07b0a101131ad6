#!/usr/bin/env bash
# The CHAI3D effect: the same forces as the core, with stand-ins for CHAI3D's headers. The example is compiled where
# CHAI3D is installed.
source "$(dirname "$0")/../tools.sh"
build_library
make_reference
mkdir -p "$work"
flags="-std=c++17 -O1 -Wall -Wextra -Wpedantic -Werror -I$here -I$header"
c++ $flags -I"$here/test/stand_ins" "$here/test/test.cpp" -L"$library" -lpunctura -o "$work/test"
"$work/test" "$reference"
if printf '#include <chai3d.h>\n' | c++ -std=c++17 ${CHAI3D_FLAGS:-} -x c++ -fsyntax-only - >/dev/null 2>&1; then
  c++ -std=c++17 ${CHAI3D_FLAGS:-} -I"$here" -I"$header" -fsyntax-only "$here/example.cpp"
  echo "the example compiles with CHAI3D"
else
  echo "CHAI3D is not installed (CHAI3D_FLAGS names its include folders): the example was not compiled"
fi
