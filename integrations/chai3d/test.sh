#!/usr/bin/env bash
# The CHAI3D effect: the same forces as the core, with stand-ins for CHAI3D's headers, and in CHAI3D's own world where
# CHAI3D is built:   chai3d_DIR=FOLDER integrations/chai3d/test.sh
source "$(dirname "$0")/../tools.sh"
build_library
make_reference
mkdir -p "$work"
flags="-std=c++17 -O1 -Wall -Wextra -Wpedantic -Werror -I$here -I$header"
c++ $flags -I"$here/test/stand_ins" "$here/test/test.cpp" -L"$library" -lpunctura -o "$work/test"
"$work/test" "$reference"

cmake --install "$root/build/integrations/library" --prefix "$work/root" >"$work/log"
cd "$work" # where --find-package leaves a folder
if ! cmake --find-package -DNAME=chai3d -DCOMPILER_ID=GNU -DLANGUAGE=CXX -DMODE=EXIST \
  ${chai3d_DIR:+-Dchai3d_DIR="$chai3d_DIR"} >/dev/null 2>&1; then
  echo "CHAI3D is not built here (chai3d_DIR names the folder): CHAI3D's own world was not tried"
  exit 0
fi
{ cmake -S "$here" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/root" \
  ${chai3d_DIR:+-Dchai3d_DIR="$chai3d_DIR"} && cmake --build "$work/build"; } >>"$work/log" 2>&1 ||
  { tail -n 40 "$work/log"; exit 1; }
"$work/build/world" "$reference"
"$work/build/example" "$reference/scene.toml" --hand |
  awk '{ print; if ($3 > most) most = $3 } END { exit !(most > 0.4) }'
