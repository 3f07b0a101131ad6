#!/usr/bin/env bash
# Compiles the core without exceptions and RTTI for WebAssembly and for a Cortex-M4F without an operating system.
#   tools/small_targets.sh        the programs below
#   tools/small_targets.sh gpu    the kernels in tests/core/gpu for a GPU (sm_90), with nvcc from PyPI; runs nothing
# Two programs each: tests/core/without_exceptions, and tests/core/without_heap, which is linked without the C++ library
# and its operator new. Node runs the WebAssembly programs, which must compute the expected forces. The programs for the
# Cortex are linked and their sizes printed, but they do not run. Needs packages of Debian 12 and prints the missing
# ones.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
cd "$root"

if [ "${1:-}" = gpu ]; then
  out=build/small-targets
  venv=$out/nvcc
  [ -x "$venv/bin/pip" ] || python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check "nvidia-cuda-nvcc==13.0.*" "nvidia-nvvm==13.0.*" \
    "nvidia-cuda-crt==13.0.*" "nvidia-cuda-cccl==13.0.*" "nvidia-cuda-runtime==13.0.*" ||
    { echo "nvcc is not here: PyPI has no nvidia-cuda-nvcc 13.0 for this computer, or cannot be reached" >&2; exit 1; }
  nvcc=$(echo "$venv"/lib/python3*/site-packages/nvidia/cu13/bin/nvcc)
  # --expt-relaxed-constexpr: a kernel may call constexpr functions. -fmad=false: the bits of a processor.
  "$nvcc" -std=c++20 --expt-relaxed-constexpr -fmad=false -O3 -arch=sm_90 -Icore -Werror all-warnings -cubin \
    tests/core/gpu/kernel.cu -o "$out/kernel.cubin"
  echo "tests/core/gpu, sm_90: $(stat -c %s "$out/kernel.cubin") bytes, compiled, not run"
  exit
fi

packages="gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib clang lld wasi-libc
  libc++-14-dev-wasm32 libc++abi-14-dev-wasm32 libclang-rt-14-dev-wasm32 nodejs"
missing=""
for package in $packages; do
  [ "$package" = nodejs ] && command -v node >/dev/null && continue
  dpkg -s "$package" >/dev/null 2>&1 || missing="$missing $package"
done
if [ -n "$missing" ]; then echo "Missing: apt-get install$missing" >&2; exit 1; fi

out=build/small-targets
mkdir -p "$out"
flags="-std=c++20 -Icore -fno-exceptions -fno-rtti -ffp-contract=off -Wall -Wextra -Werror"

cat >"$out/run.mjs" <<'JS'
import { readFile } from "node:fs/promises";
import { WASI } from "node:wasi";
const wasi = new WASI({ version: "preview1", returnOnExit: true });
const module = await WebAssembly.compile(await readFile(process.argv[2]));
process.exitCode = wasi.start(await WebAssembly.instantiate(module, wasi.getImportObject()));
JS

# small PROGRAM CLANG GCC: the drivers clang++ and g++ bring the C++ library; clang and gcc do not.
small() {
  local program=$1 source=tests/core/$1/main.cpp
  "$2" --target=wasm32-wasi --sysroot=/usr $flags -O2 -x c++ "$source" -o "$out/$program.wasm"
  node --no-warnings "$out/run.mjs" "$out/$program.wasm"
  echo "$program, WebAssembly: $(stat -c %s "$out/$program.wasm") bytes, passed"
  "arm-none-eabi-$3" $flags -Wno-psabi -Os -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 \
    -ffunction-sections -fdata-sections -Wl,--gc-sections,--no-warn-mismatch --specs=nosys.specs \
    -x c++ "$source" -lm -o "$out/$program-m4f.elf" 2>"$out/m4f.log" ||
    { cat "$out/m4f.log" >&2; return 1; }
  echo "$program, Cortex-M4F: $(arm-none-eabi-size "$out/$program-m4f.elf" |
    awk 'NR == 2 { print $1 " bytes of code and constants, " $2 + $3 " bytes of data" }')"
}
small without_exceptions clang++ g++
small without_heap clang gcc
