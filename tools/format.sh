#!/usr/bin/env bash
# Formats all sources as ./test requires.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
source "$root/tools/setup.sh"
source "$root/tools/steps.sh"

[ $# -eq 0 ] || { sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0" >&2; exit 2; }
set_up test
cd "$root"
ruff check --fix-only --exit-zero . && ruff format .
ours '*.hpp' '*.cpp' | xargs -0 clang-format -i
