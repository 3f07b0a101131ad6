#!/usr/bin/env bash
# Fuzzes the C ABI, built without NDEBUG, or the parsers of the haply back-end, with Clang's libFuzzer and sanitizers.
#   tools/fuzz.sh c_abi|haply [SECONDS]     default: 10 minutes
# The corpus and failing inputs stay in build/fuzz/. The first inputs of the C ABI are the ready scenes. ./test runs a
# short version of haply with a fixed seed.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
cd "$root"
what=${1:-} seconds=${2:-600} first=build/fuzz/${1:-}
mkdir -p "$first"

case $what in
  c_abi)
    calls=$(for i in $(seq 400); do printf '\\x%02x' $((i * i * 37 % 251)); done)
    for scene in python/punctura/ready_scenes/*.toml; do
      { printf '\0'; cat "$scene"; printf "\0$calls"; } >"$first/$(basename "$scene" .toml)"
    done
    lines=''
    for number in needle.diameter=1e-3 needle.tip_angle=0.3 coupling.stiffness=400 coupling.damping=1 \
      membrane[0].{stiffness=570,precompression=0.4,friction=0.2,thickness=1e-3} \
      membrane[0].{point,inward_normal}{[0]=0,[1]=-1,[2]=0}; do lines+="$number\n"; done
    printf "\1$lines\0$calls" >"$first/values"
    sources=(-DPUNCTURA_C_TOML -DPUNCTURA_STATIC -DPUNCTURA_VERSION='"fuzzed"' -Icapi/include -Icapi/src capi/src/*.cpp)
    limits=(-timeout=60 -rss_limit_mb=2048) ;;
  haply) # a valid message as text, and as a frame
    message='{"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":0.0,"y":-0.12,"z":0.15}},'
    message+='"status":{"calibrated":true}}],'
    message+='"wireless_verse_grip":[{"state":{"orientation":{"w":1,"x":0,"y":0,"z":0},"buttons":{"a":true}}}]}'
    printf '\0%s' "$message" >"$first/text"
    printf '\1HTTP/1.1 101 x\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: x' >"$first/answer"
    printf '\x40\x01\x05{"inv\x89\x01?\x80\x09erse3":3}\x81\x02{}' >"$first/frames"
    sources=(-Iruntime -Itests
      runtime/punctura_runtime/backends/haply/{frames,json,state,service,websocket}.cpp
      runtime/punctura_runtime/os/{linux,socket}.cpp)
    limits=(-timeout=5 -rss_limit_mb=512) ;;
  *) sed -n '3s/^# *//p' "$0" >&2; exit 2 ;;
esac

clang++ -std=c++20 -O1 -g1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -Icore \
  "tests/fuzz/${what}_fuzz.cpp" "${sources[@]}" -o "build/fuzz/${what}_fuzz"
"build/fuzz/${what}_fuzz" -max_total_time="$seconds" -max_len=8192 "${limits[@]}" -print_final_stats=1 \
  -artifact_prefix="$first-" "$first"
