#!/usr/bin/env bash
# Writes requirements.lock anew, for each Python from 3.10 on and each system. It names no index, so that a mirror
# serves it, too.
#   tools/lock.sh [OPTION of uv pip compile]...     for example --upgrade
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
source "$root/tools/setup.sh"

cd "$root"
find_python
[ -x "$tools/bin/uv" ] || step "Build tools from PyPI" build-tools make_tools ""
take_settings_of_pip
node=$(cd tools/build_backend && "$python" -c "import studio_page; print(studio_page.NODE_FROM_PYPI)")
printf '%s\n' uv cmake ninja $(build_requirements) "$node" |
  uv pip compile --universal --python-version 3.10 --no-annotate --custom-compile-command tools/lock.sh --quiet "$@" \
    --extra all --extra test --extra docs -o requirements.lock pyproject.toml -
