#!/usr/bin/env bash
# The Arduino sketch compiles with the packed library, against a stand-in for Arduino.h.
source "$(dirname "$0")/../../tools.sh"
rm -rf "$work" && bash "$here/pack.sh" "$work"
g++ -std=c++20 -fno-exceptions -fno-rtti -Wall -Wextra -Werror -fsyntax-only -I"$here/stand_in" -I"$work/Punctura/src" \
  -include Arduino.h -x c++ "$work/Punctura/examples/Knob/Knob.ino"
echo "the sketch compiles against the stand-in for Arduino.h"
