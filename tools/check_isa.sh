#!/usr/bin/env bash
# Checks that the objects of an instruction set share no code with others. A linker keeps one copy of a shared template:
# if it kept that of line_avx2.cpp, a processor without AVX2 would stop there.
#   tools/check_isa.sh BUILD_FOLDER
set -euo pipefail
checked=0
for object in "$1"/runtime/CMakeFiles/punctura_batch.dir/punctura_runtime/batch/line_avx*.cpp.o; do
  isa=$(basename "$object" .cpp.o)
  isa=${isa#line_}
  code=$(nm -C --extern-only --defined-only "$object" | awk '$2 ~ /^[TWiu]$/')
  grep -qi "$isa" <<<"$code" || { echo "$object has no code of $isa"; exit 1; }
  shared=$(grep -vi "$isa" <<<"$code" || true)
  if [ -n "$shared" ]; then
    echo "$object is compiled for $isa, and has code that other objects can use:"
    echo "$shared"
    echo "Move what needs it to a file that is compiled for any processor."
    exit 1
  fi
  checked=$((checked + 1))
done
echo "instruction sets: $checked objects"
