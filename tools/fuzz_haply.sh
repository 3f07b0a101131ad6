#!/usr/bin/env bash
# Fuzzes the parsers of the haply back-end with Clang's libFuzzer and sanitizers.
#   tools/fuzz_haply.sh [SECONDS]     default: 10 minutes
# The corpus and failing inputs stay in build/fuzz/. ./test runs a short version with a fixed seed.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
cd "$root"
seconds=${1:-600}
mkdir -p build/fuzz/haply

# The first inputs: a valid message as text, and as a frame.
message='{"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":0.0,"y":-0.12,"z":0.15}},'
message+='"status":{"calibrated":true}}],'
message+='"wireless_verse_grip":[{"state":{"orientation":{"w":1,"x":0,"y":0,"z":0},"buttons":{"a":true}}}]}'
printf '\0%s' "$message" >build/fuzz/haply/text
printf '\1HTTP/1.1 101 x\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: x' \
  >build/fuzz/haply/answer
printf '\x40\x01\x05{"inv\x89\x01?\x80\x09erse3":3}\x81\x02{}' >build/fuzz/haply/frames

clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -Icore -Iruntime -Itests \
  tests/fuzz/haply_fuzz.cpp \
  runtime/punctura_runtime/backends/haply/{frames,handshake,json,state,service,url,websocket}.cpp \
  runtime/punctura_runtime/os/{linux,socket}.cpp -o build/fuzz/haply_fuzz
build/fuzz/haply_fuzz -max_total_time="$seconds" -max_len=8192 -timeout=5 -rss_limit_mb=512 -print_final_stats=1 \
  -artifact_prefix=build/fuzz/haply- build/fuzz/haply
