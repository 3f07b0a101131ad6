#!/usr/bin/env bash
# The controller for SOFA: the same forces as the core, with stand-ins for SofaPython3, and in SOFA itself where it is
# installed (SOFA_ROOT, and PYTHONPATH with its site-packages).
source "$(dirname "$0")/../tools.sh"
make_reference
echo "the controller runs with stand-ins for SofaPython3"
PYTHONPATH=$here:$here/test/stand_ins python3 "$here/test/check.py" "$reference"
export PYTHONPATH=$here${PYTHONPATH:+:$PYTHONPATH}
if python3 -c "import Sofa.Simulation" >/dev/null 2>&1; then
  python3 "$here/test/in_sofa.py" "$reference"
else
  echo "SofaPython3 is not installed: SOFA itself was not tried"
fi
