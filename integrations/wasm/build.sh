#!/usr/bin/env bash
# Compiles the C library and the run of the page (live/) to WebAssembly.
#   integrations/wasm/build.sh        writes punctura.wasm and embedded.mjs here; exit status 77: a tool is missing
# Needs clang, lld, wasi-libc and libc++ for wasm32, and toml++: test.sh names the packages of Debian 12.
# The stack is 1 MiB, because a scene is built on it.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd -P)
root=$(cd "$here/../.." && pwd -P)
objects=$root/build/integrations/wasm-objects
mkdir -p "$objects/include"
version=$(sed -n 's/^ *"version": "\(.*\)",/\1/p' "$here/package.json")

# Only toml++ is taken from /usr/include: the other headers there belong to this machine.
toml=${PUNCTURA_TOML_DIR:-/usr/include}/toml++
[ -f "$toml/toml.h" ] || { echo "toml++ is missing. Debian: apt-get install libtomlplusplus-dev" >&2; exit 77; }
ln -sfn "$toml" "$objects/include/toml++"

# Named, because clang also searches the libc++ of this machine, if there is one.
libcxx=/usr/include/wasm32-wasi/c++/v1
[ -f "$libcxx/__config" ] || { echo "libc++ for wasm32 is missing. Debian 12: libc++-14-dev-wasm32" >&2; exit 77; }

flags="--target=wasm32-wasi --sysroot=/usr -std=c++20 -O2 -ffp-contract=off -fno-exceptions
  -fno-rtti -fno-threadsafe-statics -fno-c++-static-destructors -DPUNCTURA_STATIC -DPUNCTURA_C_TOML
  -DPUNCTURA_VERSION=\"$version\" -isystem $objects/include -I$root/core -I$root/capi/include -I$root/capi/src"
compiled=()
for source in "$root"/capi/src/{errors,scene,values,toml,insertion,proxy,servo}.cpp "$here"/live/*.cpp; do
  object=$objects/$(basename "$source" .cpp).o
  compiled+=("$object")
  # shellcheck disable=SC2086  # the flags are several words
  ${CMAKE_CXX_COMPILER_LAUNCHER:-} clang++ $flags -nostdinc++ -isystem "$libcxx" -c "$source" -o "$object"
done
exported=$(grep -ohE "punctura_[a-z0-9_]+\(" "$root/capi/include/punctura.h" "$here"/live/exports.cpp |
  grep -vE "punctura_check_abi" | tr -d '(' | sort -u)
exported+=" $(grep -oE "^[a-zA-Z].* \*?live_[a-z_]+\(" "$here/live/exports.cpp" | grep -oE "live_[a-z_]+" | sort -u)"
links=--export=malloc,--export=free
for name in $exported; do links=$links,--export=$name; done
# shellcheck disable=SC2086
clang++ $flags -mexec-model=reactor "${compiled[@]}" -Wl,-z,stack-size=1048576 -Wl,--strip-all,--gc-sections,"$links" \
  -o "$here/punctura.wasm"
# The same bytes as text, for a bundler that does not copy files.
printf 'export const text = "%s";\n' "$(base64 -w 0 "$here/punctura.wasm")" >"$here/embedded.mjs"
cp "$root/LICENSE" "$here/"
