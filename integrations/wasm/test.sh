#!/usr/bin/env bash
# The npm package and the page without a server: builds the module, compares its forces with the core's in Node, checks
# the types, runs the examples, builds the page and uses it in Chromium.
source "$(dirname "$0")/../tools.sh"
need clang++ clang
need wasm-ld lld
need node nodejs
need_header toml++/toml.h libtomlplusplus-dev
for package in wasi-libc libc++-14-dev-wasm32 libc++abi-14-dev-wasm32 libclang-rt-14-dev-wasm32; do
  dpkg -s "$package" >/dev/null 2>&1 || { echo "$package is missing. Debian: apt-get install $package"; exit 77; }
done
make_reference
bash "$here/build.sh"
node "$here/test.mjs" "$reference"
python3 "$here/live_reference.py" "$work/live"
node "$here/test_live.mjs" "$work/live"
node "$here/example.mjs" | awk '{ print; if ($3 > most) most = $3 } END { exit !(most > 0.4) }'
# The program of README.md, whose needle stops before the pop.
mkdir -p "$work"
awk '/^```/ { inside = /^```js/; next } inside' "$here/README.md" |
  sed "s|\"punctura\"|\"$here/punctura.mjs\"|" >"$work/readme.mjs"
node "$work/readme.mjs" | awk '{ if ($1 > most) most = $1 } END { exit !(most > 0.4) }'

python3 "$root/tools/build_backend/studio_page.py" --modules
"$root/web/node_modules/.bin/tsc" --noEmit --strict --target es2022 --module nodenext "$here/example_types.mts"

need_module playwright playwright
command -v chromium-headless-shell >/dev/null || command -v chromium >/dev/null ||
  command -v google-chrome >/dev/null ||
  { echo "Chromium is missing. Debian: apt-get install chromium-headless-shell"; exit 77; }
python3 "$root/tools/build_backend/static_page.py" --keep-wasm "$work/page"
python3 -m pytest -q -p no:cacheprovider "$here/test_page.py" --page "$work/page"
python3 -m pytest -q -p no:cacheprovider "$here/test_bundlers.py"
