#!/usr/bin/env bash
# The controller for SOFA: the same forces as the core, with stand-ins for SofaPython3.
source "$(dirname "$0")/../tools.sh"
make_reference
echo "the controller runs with stand-ins for SofaPython3"
PYTHONPATH=$here:$here/test/stand_ins python3 "$here/test/check.py" "$reference"
