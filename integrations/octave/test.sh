#!/usr/bin/env bash
# The MEX file in Octave: the same forces as the core.
source "$(dirname "$0")/../tools.sh"
need octave-cli octave
need mkoctfile octave-dev
build_library
make_reference
mkdir -p "$work"
(cd "$work" && mkoctfile --mex -Wall -I"$header" -L"$library" -lpunctura "$here/punctura_mex.c" -o punctura_mex.mex)
export FOLDER=$reference SCENE=$reference/scene.toml
octave-cli --no-history --norc --path "$work" --path "$here" "$here/test.m"
octave-cli --no-history --norc --path "$work" --path "$here" "$here/example.m"
