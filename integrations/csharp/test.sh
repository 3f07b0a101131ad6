#!/usr/bin/env bash
# The C# binding in Mono: the same forces as the core.
source "$(dirname "$0")/../tools.sh"
need mcs mono-mcs
need mono mono-runtime
build_library
make_reference
mkdir -p "$work"
mcs -warnaserror -out:"$work/Test.exe" "$here"/*.cs "$here"/test/*.cs -main:Test
mcs -warnaserror -out:"$work/Example.exe" "$here/Native.cs" "$here/Punctura.cs" "$here/Example.cs"
mono "$work/Test.exe" "$reference"
mono "$work/Example.exe" "$reference/scene.toml"
