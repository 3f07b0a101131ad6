#!/usr/bin/env bash
# The notebooks are made by jupytext and run in real kernels.
source "$(dirname "$0")/../tools.sh"
with_package jupytext jupytext
for module in nbclient ipykernel; do
  "$python" -c "import $module" >/dev/null 2>&1 || { echo "$module is missing: pip install $module"; exit 77; }
done
rm -rf "$work" && mkdir -p "$work"
MPLBACKEND= "$python" "$here/check.py" "$work"
