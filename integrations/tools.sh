# Sourced by the test.sh of each integration. Exit status: 0 passed, 77 a tool chain is missing, otherwise failed.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
[ ! -d "$root/.venv/bin" ] || PATH="$root/.venv/bin:$root/build/tools/bin:$root/build/node/bin:$PATH"
here=$(cd "$(dirname "$0")" && pwd -P)
work=$root/build/integrations/$(basename "$here")

# need PROGRAM PACKAGE: ends the test with 77 if the program is missing.
need() {
  command -v "$1" >/dev/null || { echo "$1 is missing. Debian: apt-get install $2"; exit 77; }
}
need_header() {
  printf '#include <%s>\n' "$1" | c++ -std=c++20 -x c++ -fsyntax-only - >/dev/null 2>&1 ||
    { echo "the header $1 is missing. Debian: apt-get install $2"; exit 77; }
}
# need_module MODULE PACKAGE: installs a package of Python if it is missing, or ends the test with 77.
need_module() {
  python3 -c "import $1" >/dev/null 2>&1 || python3 -m pip install -q "$2" >/dev/null 2>&1 ||
    { echo "the Python package $1 is missing: pip install $2"; exit 77; }
}

# Builds libpunctura. Sets: library, its folder; header, the folder of punctura.h.
build_library() {
  need cmake cmake
  need_header toml++/toml.h libtomlplusplus-dev
  local build=$root/build/integrations/library
  mkdir -p "$build"
  { cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DPUNCTURA_C=ON && cmake --build "$build"; } \
    >"$build/log" 2>&1 || { tail -n 40 "$build/log"; exit 1; }
  library=$build/capi header=$root/capi/include
  export LD_LIBRARY_PATH="$library${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
}

# The motion and the forces of the core with which all integrations compare theirs. Sets: reference, its folder.
make_reference() {
  python3 -c "import punctura" 2>/dev/null ||
    { echo "punctura is missing: pip install . in the project's root"; exit 77; }
  reference=$root/build/integrations/reference
  python3 "$root/integrations/reference.py" "$reference"
}

# with_package NAME REQUIREMENT...: installs packages from PyPI beside those of .venv, in an environment of their own.
# Sets: python, which has both.
with_package() {
  local base name=$1 venv=$root/build/integrations/python-$1
  shift
  need python3 python3
  need_module punctura "'.[test]'   (in the root of the project)"
  python=$(command -v python3)
  ! "$python" -c "import $name" >/dev/null 2>&1 || return 0
  base=$python python=$venv/bin/python
  ! "$python" -c "import $name" >/dev/null 2>&1 || return 0
  "$base" -m venv --without-pip --clear "$venv"
  "$base" -c 'import sysconfig; print(sysconfig.get_path("purelib"))' \
    >"$("$python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/punctura.pth"
  "$base" -m pip --python "$python" install -q "$@" || { echo "$* cannot be installed here"; exit 77; }
}
