#!/usr/bin/env bash
# Fuzzes the C ABI, built without NDEBUG, with Clang's libFuzzer and sanitizers.
#   tools/fuzz_c_abi.sh [SECONDS]     default: 10 minutes
# The corpus and failing inputs stay in build/fuzz/. The first inputs are the ready scenes.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
cd "$root"
seconds=${1:-600}
mkdir -p build/fuzz/c_abi

calls=$(for i in $(seq 400); do printf '\\x%02x' $((i * i * 37 % 251)); done)
for scene in python/punctura/ready_scenes/*.toml; do
  { printf '\0'; cat "$scene"; printf "\0$calls"; } >"build/fuzz/c_abi/$(basename "$scene" .toml)"
done
lines=''
for number in needle.diameter=1e-3 needle.tip_angle=0.3 coupling.stiffness=400 coupling.damping=1 \
  membrane[0].{stiffness=570,precompression=0.4,friction=0.2,thickness=1e-3} \
  membrane[0].{point,inward_normal}{[0]=0,[1]=-1,[2]=0}; do lines+="$number\n"; done
printf "\1$lines\0$calls" >build/fuzz/c_abi/values

clang++ -std=c++20 -O1 -g1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -DPUNCTURA_C_TOML \
  -DPUNCTURA_STATIC -DPUNCTURA_VERSION='"fuzzed"' -Icore -Icapi/include -Icapi/src tests/fuzz/c_abi_fuzz.cpp \
  capi/src/*.cpp -o build/fuzz/c_abi_fuzz
build/fuzz/c_abi_fuzz -max_total_time="$seconds" -max_len=8192 -timeout=60 -rss_limit_mb=2048 -print_final_stats=1 \
  -artifact_prefix=build/fuzz/c_abi- build/fuzz/c_abi
