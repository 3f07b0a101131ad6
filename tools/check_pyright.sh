#!/usr/bin/env bash
# pyright, in strict mode, on the examples and on the user programs in tests/python/typing
# ([tool.pyright] in pyproject.toml).
# Not a part of ./test, which asks mypy: pyright comes from PyPI with its own Node (basedpyright, 60 MB), into
# build/pyright.
# Needs .venv with the package installed: ./test types makes it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[ -x build/pyright/bin/basedpyright ] ||
  { python3 -m venv build/pyright && build/pyright/bin/pip install -q "basedpyright==1.40.*"; }
exec build/pyright/bin/basedpyright
