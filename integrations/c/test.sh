#!/usr/bin/env bash
# The C library as its users get it: Debian package, pkg-config, find_package, and only punctura_* exported.
source "$(dirname "$0")/../tools.sh"
need cpack cmake
need dpkg-deb dpkg
need dpkg-shlibdeps dpkg-dev
need pkg-config pkg-config
build_library
rm -rf "$work" && mkdir -p "$work"

(cd "$root/build/integrations/library" && cpack -G DEB -B "$work" >"$work/log" 2>&1) || { cat "$work/log"; exit 1; }
dpkg-deb -x "$work"/*.deb "$work/root"
dpkg-deb -I "$work"/*.deb | grep -E '^ (Package|Version|Depends)'
libdir=$(dirname "$(find "$work/root" -name 'libpunctura.so')")
scene=$root/python/punctura/ready_scenes/k06-fig12.toml

PKG_CONFIG_PATH=$libdir/pkgconfig
export PKG_CONFIG_PATH
cc -std=c99 -Wall -Wextra -Wpedantic -Werror "$here/insert.c" $(pkg-config --cflags --libs punctura) -o "$work/insert"
LD_LIBRARY_PATH=$libdir "$work/insert" "$scene" >"$work/by-pkg-config"
cmake -S "$here" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/root/usr" >>"$work/log"
cmake --build "$work/build" >>"$work/log"
LD_LIBRARY_PATH=$libdir "$work/build/insert" "$scene" >"$work/by-cmake"
cmp "$work/by-pkg-config" "$work/by-cmake"
cat "$work/by-cmake"

# The force falls at a pop.
awk '{ pops += $3 < before - 0.1; before = $3 } END { exit !pops }' "$work/by-cmake"
"$root/tools/check_exports.sh" "$libdir/libpunctura.so"
echo "c: the package, pkg-config and find_package work"
