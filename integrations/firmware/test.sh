#!/usr/bin/env bash
# The knob on a Cortex-M4F and on a 32-bit RISC-V, both in an emulator: forces, instructions, code, heap.
source "$(dirname "$0")/../tools.sh"
need arm-none-eabi-g++ gcc-arm-none-eabi
need riscv64-unknown-elf-g++ gcc-riscv64-unknown-elf
[ -f "$(arm-none-eabi-g++ -print-file-name=libstdc++.a)" ] ||
  { echo "libstdc++ is missing. Debian: apt-get install libstdc++-arm-none-eabi-newlib"; exit 77; }
with_package unicorn unicorn==2.1.4
mkdir -p "$work"
cd "$work"
flags="-std=c++20 -I$root/core -fno-exceptions -fno-rtti -ffp-contract=off -fno-math-errno -Wall -Wextra -Werror"
g++ $flags -O2 -shared -fPIC "$here/knob.cpp" -o libknob.so

# on PROCESSOR COMPILER_PREFIX LIBC FLAG...: compiles the knob at -O2 and -Os, and runs it.
on() {
  local processor=$1 prefix=$2 libc=$3 level called
  shift 3
  for level in -O2 -Os; do
    "$prefix-g++" $flags "$@" -ffunction-sections -fdata-sections $level -c "$here/knob.cpp" -o knob.o
    # What the program calls besides itself: no function of libm, no heap.
    called=$("$prefix-nm" -u knob.o | awk '$2 != "memcpy" && $2 != "memset" { print $2 }')
    [ -z "$called" ] || { echo "the knob calls $called"; exit 1; }
    "$prefix-gcc" "$@" $level -nostdlib -Wl,--gc-sections,-Ttext=0x1000,-Tdata=0x20000000 \
      -Wl,-e,knob_tick,-u,knob_setup,--no-warn-rwx-segments knob.o "$libc" -lgcc -o knob.elf
    "$prefix-nm" knob.elf >symbols
    echo "$processor $level: $("$prefix-size" knob.elf |
      awk 'NR == 2 { print $1 " bytes of code, " $2 + $3 " of RAM" }')"
    "$python" "$here/run.py" "$processor" knob.elf "$PWD/libknob.so" symbols
  done
}
cortex="-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16"
on cortex-m4f arm-none-eabi "$(arm-none-eabi-gcc $cortex -print-file-name=libc.a)" -Wno-psabi $cortex

# Debian has no C++ library for RISC-V. The core needs only headers of it, and those of the ARM compiler do not depend
# on the processor.
# Relaxed code would need the register gp, which start-up code sets.
headers=$(find /usr/include/newlib/c++ -maxdepth 1 -name "1*" | sort | tail -n 1)
picolibc=/usr/lib/picolibc/riscv64-unknown-elf
[ -d "$picolibc" ] || { echo "picolibc is missing. Debian: apt-get install picolibc-riscv64-unknown-elf"; exit 77; }
on riscv32 riscv64-unknown-elf "$picolibc/lib/release/rv32imafc/ilp32f/libc.a" \
  -march=rv32imafc -mabi=ilp32f -Wl,--no-relax -isystem "$headers" \
  -isystem "$headers/arm-none-eabi" -isystem "$picolibc/include"
