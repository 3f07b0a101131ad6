# The set-up of ./run, ./test and ./bench: Debian packages, a virtual environment, and the project installed in it.
# Sourced by bash with $root set. A finished stage leaves a stamp with a hash of its inputs, and is skipped while the
# stamp is valid.
set -euo pipefail

source "$root/tools/say.sh"
source "$root/tools/python.sh"
source "$root/tools/packages.sh"

venv=$root/.venv
tools=$root/build/tools  # uv, CMake, Ninja
node=$root/build/node    # Node if the system has none: for a page that must be built, and for ./test

# digest PATH...: one hash of names and contents of all files below the paths, without caches.
digest() {
  local sum=sha256sum
  command -v $sum >/dev/null || sum="shasum -a 256"
  (cd "$root" && find "$@" -type f ! -path '*/__pycache__/*' ! -name '*.pyc' ! -path '*/node_modules/*' \
    ! -path '*/studio/page/*' ! -path web/src/wire/messages.ts ! -path '*/support/*.json' -print0 2>/dev/null |
    LC_ALL=C sort -z | xargs -0 $sum) | $sum | cut -c1-32
}

stamped() { [ -f "$venv/.punctura/$1" ] && [ "$(cat "$venv/.punctura/$1")" = "$2" ]; }
stamp() {
  mkdir -p "$venv/.punctura" && echo "$2" >"$venv/.punctura/$1.new" &&
    mv "$venv/.punctura/$1.new" "$venv/.punctura/$1"
}

# Only one set-up runs in a clone at a time; a second one waits. (Without flock, as on macOS, there is no lock.)
lock() {
  mkdir -p "$root/build/log"
  command -v flock >/dev/null || return 0
  exec 9>"$root/build/log/.lock"
  flock -n 9 || { note "another set-up is running in this folder; waiting for it"; flock 9; }
}
unlock() { { exec 9>&-; } 2>/dev/null || true; }

# uv does not read pip's settings. A mirror, a proxy or a certificate that is set for pip is meant for it, too. As for
# `pip install`: the environment wins over the files, [install] over [global], and a later file over an earlier one.
take_settings_of_pip() {
  local listed section key value word index="" extra="" strategy="" links="" hosts="" proxy="" without="" constraints=""
  local certificate=${REQUESTS_CA_BUNDLE:-${CURL_CA_BUNDLE:-}}
  listed=$("$tools/bin/python" -m pip config list) || return
  while IFS='=' read -r key value; do
    value=${value#\'} value=${value%\'} value=${value//\\n/ }
    [ -n "$value" ] || continue
    case $key in
      index-url) index=$value ;;
      extra-index-url) extra=$value strategy=unsafe-best-match ;;  # as pip chooses
      find-links) links=$value ;;
      trusted-host) hosts=$value ;;
      proxy) proxy=$value ;;
      cert) certificate=$value ;;
      no-index) without=$value ;;
      constraint) constraints=$value ;;
    esac
  done < <(for section in global install :env:; do sed -n "s/^$section\.//p" <<<"$listed"; done)
  unless_set UV_DEFAULT_INDEX "$index"
  unless_set UV_INDEX "$extra"
  unless_set UV_INDEX_STRATEGY "$strategy"
  unless_set UV_FIND_LINKS "$(echo $links | tr ' ' ,)"
  unless_set UV_INSECURE_HOST "$hosts"
  unless_set ALL_PROXY "$proxy"
  unless_set SSL_CERT_FILE "$certificate"
  from_pip=""
  for word in $constraints; do from_pip="$from_pip -c $word"; done
  case $without in [1yYtT]* | [oO][nN]) from_pip="$from_pip --no-index" ;; esac
}
unless_set() { [ -z "$2" ] || [ -n "${!1:-}" ] || export "$1=$2"; }
# Without the files of settings that uv has for other projects: they could install elsewhere.
uv() { "$tools/bin/uv" --no-config --system-certs --color never --no-progress "$@"; }

# uv, and by it the other tools in the versions of requirements.lock.
make_tools() {
  local locked=$root/requirements.lock
  rm -rf "$tools" && "$python" -m venv "$tools" &&
    "$tools/bin/python" -m pip install --disable-pip-version-check --no-input --no-color --progress-bar off \
      --no-compile -c "$locked" uv && take_settings_of_pip &&
    uv pip install $from_pip --python "$tools" -c "$locked" cmake ninja && echo "$1" >"$tools/made"
}

# lacking_node --requires|--node: the packages of Node that studio_page.py asks for. An interrupted one is made again.
lacking_node() {
  [ -e "$node/made" ] || rm -rf "$node"
  "$python" -B "$root/tools/build_backend/studio_page.py" "$1"
}
make_node() {
  rm -rf "$node" && take_settings_of_pip && uv venv --python "$python" "$node" &&
    uv pip install $from_pip --python "$node" -c "$root/requirements.lock" "$@" && touch "$node/made"
}

# An environment is valid only with a stamp that names this folder and this Python. A working one that the user made is
# kept. One in which an installation was interrupted has incomplete packages, and is made again.
python_key() { echo "$root $python $python_minor"; }
unfinished() { [ -f "$venv/.punctura/unfinished" ]; }
by_hand() { [ -f "$venv/.punctura/by-hand" ]; }
make_venv() {
  if [ -d "$venv" ] && [ ! -d "$venv/.punctura" ] && [ "$python_minor $venv" = \
    "$("$venv/bin/python" -c 'import sys; print("%d.%d" % sys.version_info[:2], sys.prefix)' 2>/dev/null)" ]; then
    stamp by-hand yes && stamp venv "$(python_key)"
  elif ! stamped venv "$(python_key)" || [ ! -x "$venv/bin/python" ]; then
    rm -rf "$venv" "$root/build/python"
  elif unfinished && ! by_hand; then
    rm -rf "$venv"
  fi
  # The folder .punctura marks it as ours, even after an interruption here.
  stamped venv "$(python_key)" || { mkdir -p "$venv/.punctura" &&
    uv venv --allow-existing --python "$python" "$venv" && stamp venv "$(python_key)"; }
}

# into_venv ARGUMENT...: an interruption, or a full disk, leaves the mark of unfinished work.
into_venv() {
  local again=""
  ! unfinished || again=--reinstall
  stamp unfinished yes && uv pip install --python "$venv/bin/python" $again "$@" && rm "$venv/.punctura/unfinished"
}

# GCC's precompiled headers take 190 MB. An empty one of the same age is up to date for Ninja, and GCC reads the headers
# themselves instead: 2 to 3 s more for each file that is compiled after a change.
empty_precompiled_headers() {
  local file
  [ ! -d "$root/build/python" ] || find "$root/build/python" -name '*.gch' -size +0 | while IFS= read -r file; do
    touch -r "$file" "$file.age" && : >"$file" && touch -r "$file.age" "$file" && rm "$file.age"
  done
}

# install_project: builds in a permanent folder with what is in .venv, so that only changed files are compiled again.
install_project() {
  local wheels=$root/build/wheel
  rm -rf "$wheels" &&
    uv build --wheel --no-build-isolation --python "$venv/bin/python" --out-dir "$wheels" "$root" &&
    into_venv --no-cache --no-deps --reinstall-package punctura "$wheels"/*.whl && rm -r "$wheels" &&
    empty_precompiled_headers
}

# install_all EXTRA...: the dependencies in the versions of requirements.lock, and the project. pip is for the user.
build_requirements() { sed -n 's/^requires = \[\(.*\)\]$/\1/p' "$root/pyproject.toml" | tr -d '",'; }
install_all() {
  take_settings_of_pip && make_venv &&
    into_venv $from_pip -c "$root/requirements.lock" -r "$root/pyproject.toml" $(printf -- '--extra %s ' "$@") \
      pip $(build_requirements) && install_project
}

# set_up KIND: KIND is run, bench or test. `run` leaves neither Node nor the modules of the page behind.
set_up() {
  local kind=${1/bench/run} extras=all needs sources tools_key lacking install="" title="" for_node=--requires
  [ "$kind" != test ] || extras="test docs" for_node=--node  # with all, too
  [ "$1" = run ] || export PUNCTURA_KEEP_NODE_MODULES=1
  export PIP_USER=0 PIP_REQUIRE_VIRTUALENV=0 PYTHONNOUSERSITE=1
  # Python keeps compiled modules; without them each start of a command takes twice as long.
  unset PYTHONPATH PYTHONHOME PYTHONDONTWRITEBYTECODE
  lock
  find_python
  packages_key() { echo "$(digest tools/packages.sh) $(python_key) ${CXX:-}"; }
  if ! stamped "packages-$kind" "$(packages_key)"; then
    provide_packages "$kind"
    find_python  # the installed packages may have completed another Python
  fi
  needs="$(digest pyproject.toml requirements.lock tools/build_backend)"
  # capi and integrations/fmi are in the package, too: the binary of the FMUs
  sources="$needs $(digest CMakeLists.txt cmake core runtime capi integrations/fmi python web) ${CXX:-}"
  tools_key="$needs $(python_key)"
  export PATH="$venv/bin:$tools/bin:$node/bin:$PATH"

  if unfinished || [ ! -x "$venv/bin/python" ] || ! stamped venv "$(python_key)" ||
    ! stamped "needs-$kind" "$needs"; then
    install="install_all $extras" title="Punctura, built and installed with its dependencies (a minute or two)"
  elif ! stamped sources "$sources"; then
    install=install_project title="Punctura, built again"
  fi
  if [ "$1$install" != run ]; then
    [ "$(cat "$tools/made" 2>/dev/null)" = "$tools_key" ] ||
      step "Build tools from PyPI" build-tools make_tools "$tools_key"
    lacking=$(lacking_node $for_node)
    [ -z "$lacking" ] || step "Node from PyPI" node make_node $lacking
  fi
  if [ -n "$install" ]; then
    step "$title" install $install
    [ "$1" != run ] || [ -f "$venv/.punctura/needs-test" ] || rm -rf "$node"
    stamp "needs-$kind" "$needs" && stamp sources "$sources"
  fi
  stamped "packages-$kind" "$(packages_key)" || stamp "packages-$kind" "$(packages_key)"
  unlock
}
