#!/usr/bin/env bash
# Checks that what the objects of an instruction set share with others runs on any processor. A linker keeps one copy of
# a shared template: if it kept that of line_avx2.cpp with AVX2 in it, a processor without AVX2 would stop there.
#   tools/check_isa.sh BUILD_FOLDER
set -euo pipefail
checked=0
for object in "$1"/runtime/CMakeFiles/punctura_batch.dir/punctura_runtime/batch/line_avx*.cpp.o; do
  isa=$(basename "$object" .cpp.o)
  isa=${isa#line_}
  code=$(nm --extern-only --defined-only "$object" | awk '$2 ~ /^[TWiu]$/ { print $3 }')
  grep -qi "$isa" <<<"$code" || { echo "$object has no code of $isa"; exit 1; }
  # Of such an instruction set: v... and k..., popcnt, crc32. What only throws, as in Clang's vector, has none of them.
  bound=$(objdump -d --no-show-raw-insn "$object" | awk '
    NR == FNR { shared[$1]; next }
    /^[0-9a-f]+ </ { name = substr($2, 2, length($2) - 3); next }
    name in shared && $2 ~ /^(v|k|popcnt|crc32)/ && !seen[name]++ { print name }' <(grep -vi "$isa" <<<"$code") - |
    c++filt)
  if [ -n "$bound" ]; then
    echo "$object has code of $isa that other objects can use:"
    echo "$bound"
    echo "Move what needs it to a file that is compiled for any processor."
    exit 1
  fi
  checked=$((checked + 1))
done
echo "instruction sets: $checked objects"
