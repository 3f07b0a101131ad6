#!/usr/bin/env bash
# FMUs of both versions in fmpy: the same forces as the core.
source "$(dirname "$0")/../tools.sh"
need_module fmpy fmpy
make_reference
mkdir -p "$work"
python3 "$here/check.py" "$reference" "$work"
