# System packages that pip cannot install: a compiler and Python's headers; for ./test a second compiler and some
# Debian packages; for ./bench one package. Checks for abilities, not for package names, so that other systems and
# manual installations work too.

has_compiler() {
  printf '#include <concepts>\nint main() { return std::same_as<int, int> ? 0 : 1; }\n' |
    $1 -std=c++20 -x c++ -fsyntax-only - >/dev/null 2>&1
}
has_sanitizers() {
  local program
  program=$(mktemp) && printf 'int main() { return 0; }\n' |
    clang++ -fsanitize=address,undefined -x c++ - -o "$program" >/dev/null 2>&1
  local code=$?
  rm -f "$program"
  return $code
}
has_header() { printf '#include <%s>\n' "$1" | g++ -std=c++20 -x c++ -fsyntax-only - >/dev/null 2>&1; }
has_browser() {
  command -v chromium-headless-shell || command -v chromium || command -v chromium-browser || command -v google-chrome
} >/dev/null
has_cyclictest() { command -v cyclictest >/dev/null; }
has_siconos() {
  /usr/bin/python3 -c 'import importlib.util, sys; sys.exit(importlib.util.find_spec("siconos") is None)' 2>/dev/null
}

# find_missing KIND: sets `missing` to Debian's package names, and `needs` to descriptions for other systems.
find_missing() {
  missing="" needs=""
  local browser lacking="$python_lacks" compiler="${CXX:-c++}" prefix="python$python_minor"
  if [ "$python" = "$(readlink -f /usr/bin/python3 2>/dev/null)" ]; then prefix=python3; fi
  lack() { missing="$missing $1" needs="$needs
  - $2"; }
  if [ "$1" = test ]; then compiler=g++; fi  # the tests compile with GCC and Clang, independent of CXX
  has_compiler "$compiler" ||
    lack g++ "a C++20 compiler (g++ 10 or newer, clang 14 or newer; Fedora: gcc-c++; macOS: xcode-select --install)"
  case $lacking in *headers*) lack "$prefix-dev" "the headers of $python (Python.h; Fedora: python3-devel)" ;; esac
  case $lacking in *venv*) lack "$prefix-venv" "the modules venv and ensurepip of $python" ;; esac
  # The reference for the servo loop's wake-ups. If no archive has it, ./bench reports that and continues.
  if [ "$1" = bench ]; then has_cyclictest || ! known rt-tests || lack rt-tests "cyclictest, of rt-tests"; fi
  [ "$1" = test ] || return 0
  has_compiler clang++ || lack clang "clang++, the second compiler of the tests"
  has_sanitizers ||
    lack libclang-rt-dev "the address and undefined-behaviour sanitizers of clang++ (Fedora: compiler-rt)"
  if ! has_browser && browser=$(browser_package); then
    lack "$browser" "Chromium (or Google Chrome), in which the studio's page is tested"
  fi
  has_header doctest/doctest.h || lack doctest-dev "doctest, the C++ test framework (its header as doctest/doctest.h)"
  has_header toml++/toml.h || lack libtomlplusplus-dev "toml++, a TOML reader for C++ (its header as toml++/toml.h)"
  command -v valgrind >/dev/null || lack valgrind "valgrind, which counts instructions"
  # An independent solver for the system's Python, compared with the clamp. Only some Debian releases have it. Elsewhere
  # its single test is left out, which ./test reports, and SciPy's solver remains.
  has_siconos || ! known python3-siconos || lack python3-siconos "Siconos for /usr/bin/python3"
}

# browser_package: the name of Chromium's package. Fails on a system that has none, such as Ubuntu, whose archives refer
# to a snap: the step `page` then says that it tests nothing.
browser_package() {
  # Debian's Chromium without windows starts and draws faster than the whole one.
  if known chromium-headless-shell; then
    echo chromium-headless-shell
  elif known chromium || { ! has_lists && ! grep -qs '^ID=ubuntu$' /etc/os-release; }; then
    echo chromium
  else
    return 1
  fi
}

# has_lists: whether this machine has package lists of an archive.
has_lists() { command -v apt-cache >/dev/null && [ -n "$(apt-cache madison coreutils 2>/dev/null)" ]; }

# known PACKAGE: whether the package lists of this machine contain it.
known() { command -v apt-cache >/dev/null && apt-cache show --no-all-versions "$1" >/dev/null 2>&1; }

apt() { $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0 "$@"; }

# If a package's file is gone from the archive, the lists are out of date: update them and try again.
apt_install() {
  apt install --no-install-recommends "$@" || { apt update && apt install --no-install-recommends "$@"; }
}

provide_packages() {
  local as_root="" line answer package found=""
  if [ -n "${CXX:-}" ] && ! has_compiler "$CXX"; then
    fail "CXX=$CXX is not a C++20 compiler. Set another one, or leave CXX unset."
  fi
  find_missing "$1"
  [ -n "$missing" ] || return 0
  if ! command -v apt-get >/dev/null; then fail "Punctura needs, and this system lacks:$needs
Install these in your system's way, then start again."; fi

  line="apt-get update && apt-get install -y --no-install-recommends$missing"
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then fail "Some Debian packages are missing. As root (su -), type
  $line
then start again."; fi
    line="sudo apt-get update && sudo apt-get install -y --no-install-recommends$missing"
    if [ ! -t 0 ] || [ -n "${CI:-}" ]; then fail "Some Debian packages are missing. Type
  $line
then start again."; fi
    printf 'Some Debian packages are missing:%s\nInstall them now with sudo? [Y/n] ' "$missing"
    read -r answer || answer=n
    case $answer in "" | [Yy]*) ;; *) fail "Run this command yourself, then start again:
  $line" ;; esac
    sudo -v || fail "sudo was refused. An administrator must run
  $line"
    as_root=sudo
  fi
  if ! has_lists; then  # as on a fresh machine
    step "Debian's package lists" package-lists apt update
    find_missing "$1"
  fi
  for package in $missing; do known "$package" && found="$found $package"; done  # one that is unknown would stop all
  [ -z "$found" ] || step "Debian packages:$found" packages apt_install $found
  find_python
  find_missing "$1"
  if [ -n "$missing" ]; then fail "Installed:${found:- nothing}. Still lacking:$needs
See build/log/packages.log."; fi
}
