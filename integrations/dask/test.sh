#!/usr/bin/env bash
# A study on a local Dask cluster, of which a worker is killed.
source "$(dirname "$0")/../tools.sh"
with_package dask "distributed>=2024.1"
"$python" "$here/check.py"
