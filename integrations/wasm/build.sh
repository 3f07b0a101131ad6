#!/usr/bin/env bash
# Compiles the C library without its TOML reader, and without the servo step, to WebAssembly.
#   integrations/wasm/build.sh        writes integrations/wasm/punctura.wasm
# Needs clang, lld, wasi-libc and libc++ for wasm32: test.sh names the packages of Debian 12.
# The stack is 1 MiB, because a scene is built on it.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd -P)
root=$(cd "$here/../.." && pwd -P)
version=$(sed -n 's/^ *"version": "\(.*\)",/\1/p' "$here/package.json")
exports=malloc,free
objects='scene|setup|membrane|insertion|proxy1d'
for name in $(grep -ohE "punctura_($objects)_[a-z_]+\(|punctura_(version|last_error|status_text)\(" \
  "$root/capi/include/punctura.h" | tr -d '(' | grep -vE '_from_|_field|_get$|_copy$' | sort -u); do
  exports=$exports,$name
done
clang++ --target=wasm32-wasi --sysroot=/usr -mexec-model=reactor -std=c++20 -O2 -ffp-contract=off -fno-exceptions \
  -fno-rtti -fno-threadsafe-statics -fno-c++-static-destructors -DPUNCTURA_STATIC -DPUNCTURA_VERSION="\"$version\"" \
  -I"$root/core" -I"$root/capi/include" \
  "$root"/capi/src/{errors,scene,insertion,proxy}.cpp \
  -Wl,-z,stack-size=1048576 -Wl,--strip-all,--gc-sections,"--export=${exports//,/,--export=}" -o "$here/punctura.wasm"
cp "$root/LICENSE" "$here/"
