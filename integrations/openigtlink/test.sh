#!/usr/bin/env bash
# The OpenIGTLink server with a client of pyigtl: the forces of the core.
source "$(dirname "$0")/../tools.sh"
need_module pyigtl pyigtl
make_reference
PYTHONPATH=$here python3 "$here/check.py" "$reference"
