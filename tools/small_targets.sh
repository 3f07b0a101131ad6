#!/usr/bin/env bash
# Compiles the core without exceptions and RTTI for WebAssembly and for a Cortex-M4F without an operating system.
#   tools/small_targets.sh
# Node runs the WebAssembly program, which must compute the forces of tests/core/without_exceptions. The program for
# the Cortex is linked and its size printed, but not run. Needs packages of Debian 12 and prints the missing ones.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
cd "$root"

packages="gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib clang lld wasi-libc libc++-14-dev-wasm32 libc++abi-14-dev-wasm32 libclang-rt-14-dev-wasm32 nodejs"
missing=""
for package in $packages; do
  [ "$package" = nodejs ] && command -v node >/dev/null && continue
  dpkg -s "$package" >/dev/null 2>&1 || missing="$missing $package"
done
if [ -n "$missing" ]; then echo "Missing: apt-get install$missing" >&2; exit 1; fi

out=build/small-targets
mkdir -p "$out"
source=tests/core/without_exceptions/main.cpp
flags="-std=c++20 -Icore -fno-exceptions -fno-rtti -ffp-contract=off -Wall -Wextra -Werror"

clang++ --target=wasm32-wasi --sysroot=/usr $flags -O2 "$source" -o "$out/core.wasm"
cat >"$out/run.mjs" <<'JS'
import { readFile } from "node:fs/promises";
import { WASI } from "node:wasi";
const wasi = new WASI({ version: "preview1", returnOnExit: true });
const module = await WebAssembly.compile(await readFile(process.argv[2]));
process.exitCode = wasi.start(await WebAssembly.instantiate(module, wasi.getImportObject()));
JS
node --no-warnings "$out/run.mjs" "$out/core.wasm"
echo "WebAssembly: $(stat -c %s "$out/core.wasm") bytes with the C++ library, passed"

arm-none-eabi-g++ $flags -Wno-psabi -Os -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 -ffunction-sections -fdata-sections \
  -Wl,--gc-sections,--no-warn-mismatch --specs=nosys.specs "$source" -o "$out/core-m4f.elf" 2>"$out/m4f.log" || { cat "$out/m4f.log" >&2; exit 1; }
echo "Cortex-M4F: $(arm-none-eabi-size "$out/core-m4f.elf" | awk 'NR == 2 { print $1 " bytes of code and constants, " $2 + $3 " bytes of data" }') with the C and C++ library"
