#!/usr/bin/env bash
# The Unity components in Mono, with stand-ins for Unity: the same forces as the binding for C#.
source "$(dirname "$0")/../../tools.sh"
need mcs mono-mcs
need mono mono-runtime
build_library
mkdir -p "$work"
mcs -warnaserror -out:"$work/Test.exe" "$root"/integrations/csharp/{,test/}*.cs "$here"/{,test/}*.cs -main:UnityTest
mono "$work/Test.exe"
