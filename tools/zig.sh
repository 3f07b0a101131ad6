# Sourced, with root set. Zig's Clang from PyPI compiles for other systems, because it includes their C libraries.

# zig: installs it in build/zig. Sets: zig, its path. Fails if it cannot be had.
zig() {
  export ZIG_GLOBAL_CACHE_DIR=$root/build/zig/cache ZIG_LOCAL_CACHE_DIR=$root/build/zig/cache
  [ -x "$root/build/zig/venv/bin/python" ] || python3 -m venv "$root/build/zig/venv"
  "$root/build/zig/venv/bin/python" -c 'import ziglang' 2>/dev/null ||
    "$root/build/zig/venv/bin/pip" install -q --disable-pip-version-check "ziglang==0.17.*"
  zig=$(echo "$root"/build/zig/venv/lib/python*/site-packages/ziglang/zig)
  [ -x "$zig" ]
}
