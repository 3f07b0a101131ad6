#!/usr/bin/env bash
# The npm package: builds the module, compares its forces with the core's in Node, runs the example, packs it.
source "$(dirname "$0")/../tools.sh"
need clang++ clang
need wasm-ld lld
need node nodejs
for package in wasi-libc libc++-14-dev-wasm32 libc++abi-14-dev-wasm32 libclang-rt-14-dev-wasm32; do
  dpkg -s "$package" >/dev/null 2>&1 || { echo "$package is missing. Debian: apt-get install $package"; exit 77; }
done
make_reference
bash "$here/build.sh"
node "$here/test.mjs" "$reference"
node "$here/example.mjs" | awk '{ print; if ($3 > most) most = $3 } END { exit !(most > 0.4) }'
