#!/usr/bin/env bash
# Writes a library for Arduino and PlatformIO: the folder TO/Punctura.
#   integrations/untried/arduino/pack.sh TO
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd -P)
mkdir -p "$1"
cp -r "$here/library/." "$1/Punctura"
cp -r "$here/../../../core/punctura" "$1/Punctura/src/"
cp "$here/../../../LICENSE" "$1/Punctura/"
