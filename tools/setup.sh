# The set-up of ./run, ./test and ./bench: Debian packages, a virtual environment, and the project installed in it.
# Sourced by bash with $root set. Each stage writes a stamp with a hash of its inputs, and is skipped while the stamp
# is valid.
set -euo pipefail

source "$root/tools/say.sh"
source "$root/tools/python.sh"
source "$root/tools/packages.sh"

venv=$root/.venv
site() { "$venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))'; }

# digest: one hash of standard input.
digest() { if command -v sha256sum >/dev/null; then sha256sum; else shasum -a 256; fi | cut -c1-32; }

# digest_files PATH...: one hash of names and contents of all files below the paths, without caches.
digest_files() {
  (cd "$root" && find "$@" -type f ! -path '*/__pycache__/*' ! -name '*.pyc' ! -path '*/node_modules/*' \
    ! -path '*/studio/page/*' -print0 2>/dev/null | LC_ALL=C sort -z |
    xargs -0 $(command -v sha256sum || echo shasum -a 256)) | digest
}

stamped() { [ -f "$venv/.punctura/$1" ] && [ "$(cat "$venv/.punctura/$1")" = "$2" ]; }
stamp() {
  mkdir -p "$venv/.punctura" && echo "$2" >"$venv/.punctura/$1.new" &&
    mv "$venv/.punctura/$1.new" "$venv/.punctura/$1"
}
unstamp() { rm -f "$venv/.punctura/$1"; }

# Only one set-up runs in a clone at a time; a second one waits. (Without flock, as on macOS, there is no lock.)
lock() {
  mkdir -p "$root/build/log"
  command -v flock >/dev/null || return 0
  exec 9>"$root/build/log/.lock"
  flock -n 9 || { note "another set-up is running in this folder; waiting for it"; flock 9; }
}
unlock() { { exec 9>&-; } 2>/dev/null || true; }

# A virtual environment is valid only with a stamp that names this folder and this Python; the stamp is written last.
# A working one that the user made is kept; an incomplete one is made again.
make_venv() {
  local key="$root $python $python_minor" made_by_hand=""
  stamped venv "$key" && [ -x "$venv/bin/python" ] && return 0
  if [ -d "$venv" ] && [ ! -d "$venv/.punctura" ]; then
    made_by_hand=$(
      "$venv/bin/python" -c 'import sys, pip; print("%d.%d" % sys.version_info[:2], sys.prefix)' 2>/dev/null || true
    )
  fi
  if [ "$made_by_hand" != "$python_minor $venv" ]; then
    # The folder .punctura marks this venv as ours, even after an interruption here.
    rm -rf "$venv" "$root/build/python" && mkdir -p "$venv/.punctura"
    step "Virtual environment .venv with Python $python_version" venv "$python" -m venv "$venv"
  fi
  stamp venv "$key"
}

# The build requirements from pyproject.toml. They include CMake and Ninja, so that the system need not have them, and
# Node for the studio's page if it is missing.
build_requirements() {
  "$venv/bin/python" - "$root/pyproject.toml" <<'PY'
import sys
try:
    import tomllib
except ModuleNotFoundError:  # Python 3.10
    from pip._vendor import tomli as tomllib
print("\n".join(tomllib.load(open(sys.argv[1], "rb"))["build-system"]["requires"]))
PY
}
pip() { "$venv/bin/python" -m pip --disable-pip-version-check --no-input --no-color "$@"; }
# Of an interrupted start, or of a uv that has failed.
remove_incomplete() { "$venv/bin/python" "$root/tools/incomplete_packages.py"; }
pip_build_tools() {
  local requirements
  remove_incomplete
  requirements=$(build_requirements && "$venv/bin/python" "$root/tools/build_backend/studio_page.py" --requires) &&
    pip install --progress-bar off $requirements "cmake>=3.26" "ninja>=1.11"
}

# Builds in a permanent folder instead of pip's temporary one, so that only changed files are compiled again. Python
# compiles a module at its first import: compiling all modules of all dependencies here would take half a minute.
pip_project() { pip install --progress-bar off --no-build-isolation --no-compile "$@" && empty_precompiled_headers; }

# GCC's precompiled headers take 190 MB. An empty one of the same age is up to date for Ninja, and GCC reads the headers
# themselves instead: 2 to 3 s more for each file that is compiled after a change.
empty_precompiled_headers() {
  local file
  [ ! -d "$root/build/python" ] || find "$root/build/python" -name '*.gch' -size +0 | while IFS= read -r file; do
    touch -r "$file" "$file.age" && : >"$file" && touch -r "$file.age" "$file" && rm "$file.age"
  done
}

# uv installs the dependencies in a tenth of pip's time, and leaves to pip what it could not install. It does not read
# pip's settings: only pip runs if they name another index, a constraint or a proxy. uv's own settings are for other
# projects: they could install elsewhere. The output has a log of its own, so that an error of uv does not choose the
# advice after an error of pip.
uv_dependencies() {
  local extra extras="" settings links log=$root/build/log/uv.log
  remove_incomplete
  settings=$(pip config list)
  if grep -qE '\.(index-url|extra-index-url|no-index|constraint|proxy)=' <<<"$settings"; then return 0; fi
  links=$(sed -nE "s/.*\.find-links='(.*)'/\1/p" <<<"$settings" | tail -n 1)
  for extra in ${1//,/ }; do extras="$extras --extra $extra"; done
  pip install --progress-bar off "uv==0.13.*" >"$log" 2>&1 &&
    "$venv/bin/uv" pip install --no-config --system-certs ${links:+--find-links "$links"} \
      --python "$venv/bin/python" -r "$root/pyproject.toml" $extras >>"$log" 2>&1 ||
    { echo "uv has failed (build/log/uv.log). pip installs the dependencies." && remove_incomplete; }
}
install_all() { uv_dependencies "$1" && pip_project "$root[$1]"; }

# set_up KIND: KIND is run or test.
set_up() {
  local kind=$1 extra=all deps sources node
  [ "$kind" = run ] || extra=test,docs  # with all, too
  export PIP_USER=0 PIP_REQUIRE_VIRTUALENV=0 PYTHONNOUSERSITE=1
  [ "$kind" = run ] || export PUNCTURA_KEEP_NODE_MODULES=1  # ./test web needs them; the page is seldom built
  # Python keeps compiled modules; without them each start of a command takes twice as long.
  unset PYTHONPATH PYTHONHOME PYTHONDONTWRITEBYTECODE
  lock
  find_python
  packages_key() { echo "$(digest_files tools/packages.sh) $python $python_minor ${CXX:-}"; }
  if ! stamped "packages-$kind" "$(packages_key)"; then
    provide_packages "$kind"
    find_python  # the installed packages may have completed another Python
    make_venv
    stamp "packages-$kind" "$(packages_key)"
  fi
  make_venv
  # The system's Node: one from PyPI in the virtual environment would look like a change.
  node=$(command -v node || true)
  export PATH="$venv/bin:$PATH"
  deps="$(digest_files pyproject.toml tools/build_backend)"
  # capi and integrations/fmi are in the package, too: the binary of the FMUs
  sources="$deps $(digest_files pyproject.toml CMakeLists.txt cmake core runtime capi integrations/fmi python web)"
  sources="$sources ${CXX:-}"
  if ! stamped build-tools "$deps $node"; then
    step "Build tools from PyPI" build-tools pip_build_tools
    stamp build-tools "$deps $node"
  fi
  if ! stamped "needs-$kind" "$deps"; then
    unstamp sources
    step "Punctura, built and installed with its dependencies (a minute or two)" \
      install install_all "$extra"
    stamp "needs-$kind" "$deps"
    stamp sources "$sources"
  elif ! stamped sources "$sources"; then
    step "Punctura, built again" install pip_project --no-deps --force-reinstall "$root"
    stamp sources "$sources"
  fi
  unlock
}
