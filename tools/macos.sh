#!/usr/bin/env bash
# Compiles and links core, runtime and their tests for macOS on Linux. It runs nothing, because macOS is not available.
#   tools/macos.sh [aarch64|x86_64]     default: aarch64
# The compiler is tools/zig.sh.
# Results: docs/windows-and-macos.md.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
cd "$root"
machine=${1:-aarch64}
out=build/macos/$machine

source tools/zig.sh && zig
mkdir -p "$out" build/macos/include && ln -sfn /usr/include/doctest build/macos/include/doctest

# The same warnings as elsewhere, all as errors. The tests hold the paths of the fakes, which are not opened here.
# doctest needs a constant of <cfloat> without including it, and uses __COUNTER__, which this Clang reports as an
# extension.
compiler=("$zig" c++ -target "$machine-macos" -std=c++20 -O1)
flags=(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -Icore -Iruntime -Itests -Itests/core
  -isystem build/macos/include '-DDBL_EPSILON=__DBL_EPSILON__' -Wno-c2y-extensions
  '-DPUNCTURA_FAKE_DRD="fake_drd"' '-DPUNCTURA_FAKE_DHD="fake_dhd"' '-DPUNCTURA_FAKE_DRD_OLD="fake_drd_old"'
  '-DFAKE_HD="fake_hd"' '-DFAKE_HD_INCOMPLETE="fake_hd_incomplete"')

# objects SOURCE...: compiles the sources and sets `made`. Zig caches unchanged files.
objects() {
  local source object
  made=()
  for source in "$@"; do
    object=$out/${source//\//_}.o
    made+=("$object")
    echo "$source"
    "${compiler[@]}" "${flags[@]}" -c "$source" -o "$object"
  done
}

mapfile -t runtime < <(find runtime/punctura_runtime/loop runtime/punctura_runtime/backends -name '*.cpp' | sort)
objects runtime/punctura_runtime/os/{macos,posix_library,socket}.cpp "${runtime[@]}"
library=("${made[@]}")
for fake in drd hd; do
  objects tests/fakes/$fake/*.cpp
  "${compiler[@]}" -shared "${made[@]}" -o "$out/fake_$fake.dylib"
done
# program NAME SOURCE...: links a test program with the shared objects.
program() {
  objects tests/core/main.cpp tests/core/support/allocations.cpp "${@:2}"
  "${compiler[@]}" "${made[@]}" "${library[@]}" -o "$out/$1"
  echo "compiled and linked for $machine-macos, not run: $out/$1"
}
mapfile -t tests < <(find tests/runtime -name '*_test.cpp' | sort)
program runtime_tests tests/runtime/support/{haply_fake,listener}.cpp "${tests[@]}"
mapfile -t tests < <(find tests/core -name '*_test.cpp' | sort)
program core_tests "${tests[@]}"
