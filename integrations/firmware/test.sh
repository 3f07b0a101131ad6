#!/usr/bin/env bash
# The knob on a Cortex-M4F in an emulator: forces, instructions, code, heap; and the Arduino sketch, against a stand-in.
source "$(dirname "$0")/../tools.sh"
need arm-none-eabi-g++ gcc-arm-none-eabi
[ -f "$(arm-none-eabi-g++ -print-file-name=libstdc++.a)" ] ||
  { echo "libstdc++ is missing. Debian: apt-get install libstdc++-arm-none-eabi-newlib"; exit 77; }
with_package unicorn unicorn==2.1.4
mkdir -p "$work"
cd "$work"
flags="-std=c++20 -I$root/core -fno-exceptions -fno-rtti -ffp-contract=off -fno-math-errno -Wall -Wextra -Werror"
arm="-Wno-psabi -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 -ffunction-sections -fdata-sections"
g++ $flags -O2 -shared -fPIC "$here/knob.cpp" -o libknob.so
for level in -O2 -Os; do
  arm-none-eabi-g++ $flags $arm $level -c "$here/knob.cpp" -o "knob$level.o"
  # What the program calls besides itself: no function of libm, no heap.
  called=$(arm-none-eabi-nm -u "knob$level.o" | awk '$2 != "memcpy" && $2 != "memset" { print $2 }')
  [ -z "$called" ] || { echo "the knob calls $called"; exit 1; }
  arm-none-eabi-g++ $flags $arm $level -nostartfiles -Wl,--gc-sections,-Ttext=0x1000,-Tdata=0x20000000 \
    -Wl,-e,knob_tick,-u,knob_setup,--no-warn-rwx-segments "knob$level.o" -o "knob$level.elf"
  arm-none-eabi-nm "knob$level.elf" >symbols
  echo "$level: $(arm-none-eabi-size "knob$level.elf" |
    awk 'NR == 2 { print $1 " bytes of code, " $2 + $3 " of RAM" }')"
  "$python" "$here/run.py" "knob$level.elf" "$PWD/libknob.so" symbols
done
rm -rf library
bash "$here/pack.sh" library
g++ ${flags/-I"$root/core"/} -fsyntax-only -I"$here/stand_in" -Ilibrary/Punctura/src -include Arduino.h -x c++ \
  library/Punctura/examples/Knob/Knob.ino
echo "the sketch compiles against the stand-in for Arduino.h"
