#!/usr/bin/env bash
# Compiles the lanes for 64-bit ARM, with Neon, and runs the tests of all batches on an emulated processor.
#   tools/neon.sh
# The tests compare all results with those of the scalar core, which is compiled for the same processor. This shows that
# the bits are equal. It shows nothing about speed. Needs packages of Debian 12 and prints the missing ones.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
cd "$root"

missing=""
for package in g++-aarch64-linux-gnu qemu-user doctest-dev; do
  dpkg -s "$package" >/dev/null 2>&1 || missing="$missing $package"
done
if [ -n "$missing" ]; then echo "Missing: apt-get install$missing" >&2; exit 1; fi

export out=build/neon
mkdir -p "$out/include"
ln -sfn /usr/include/doctest "$out/include/doctest"  # the rest of /usr/include is for another processor
export flags="-std=c++20 -O2 -ffp-contract=off -Wall -Wextra
  -Icore -Iruntime -Itests -isystem $out/include"

compile() { aarch64-linux-gnu-g++ $flags -c "$1" -o "$out/$(basename "$1" .cpp).o"; }
export -f compile
rm -f "$out"/*.o
{ printf '%s\n' tests/core/main.cpp tests/runtime/batch/*_test.cpp
  printf 'runtime/punctura_runtime/batch/%s.cpp\n' line_base line_batch blocks run_line lane_trials \
    scene_batch fleet; } |
  xargs -P 2 -I{} bash -ec 'compile {}'
aarch64-linux-gnu-g++ -static "$out"/*.o -pthread -o "$out/tests"
qemu-aarch64 "$out/tests"
