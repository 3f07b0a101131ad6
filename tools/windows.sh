#!/usr/bin/env bash
# Builds core, runtime and their tests for Windows with mingw-w64, and runs them under Wine where possible; starts an
# FMU in a folder whose name is not ASCII.
#   tools/windows.sh            builds and runs
# Needs Debian's g++-mingw-w64-x86-64-posix, wine, wine64 and doctest-dev; installs them as root. Results:
# docs/windows-and-macos.md.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
cd "$root"

# Tests that cannot pass under Wine, by name, each with the reason.
left_out=()

need=""
command -v x86_64-w64-mingw32-g++-posix >/dev/null || need="$need g++-mingw-w64-x86-64-posix"
wine=$(command -v wine64 || command -v wine || true)
[ -n "$wine" ] || [ -x /usr/lib/wine/wine64 ] || need="$need wine wine64"
[ -e /usr/include/doctest/doctest.h ] || need="$need doctest-dev"
[ -e build/tools/bin/cmake ] || { echo "tools/windows.sh: run ./test once first; it installs CMake" >&2; exit 1; }
if [ -n "$need" ]; then
  if [ "$(id -u)" = 0 ]; then
    apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq $need >/dev/null
  else
    echo "tools/windows.sh needs packages. Type: sudo apt-get install$need" >&2
    exit 1
  fi
fi
wine=$(command -v wine64 || command -v wine || echo /usr/lib/wine/wine64)

export PATH=$root/.venv/bin:$root/build/tools/bin:$PATH
# Copy doctest alone, because its folder also has system headers that are not for Windows.
mkdir -p build/windows/include && ln -sfn /usr/include/doctest build/windows/include/doctest
cmake -S . -B build/windows/tree -G Ninja -DCMAKE_TOOLCHAIN_FILE="$root/cmake/mingw-w64.cmake" \
  -DCMAKE_BUILD_TYPE=Release -DPUNCTURA_TESTS=ON -DPUNCTURA_DOCTEST_DIR="$root/build/windows/include"

# A separate Wine folder, without prompts for Mono and Gecko. Fewer random cases, because ./test runs all of them.
export WINEPREFIX=$root/build/windows/wine WINEDEBUG=-all WINEDLLOVERRIDES="mscoree=;mshtml="
export PUNCTURA_CASES="${PUNCTURA_CASES:-20}"
failed=0
for tests in runtime core; do
  cmake --build build/windows/tree --target ${tests}_tests --parallel "${PUNCTURA_JOBS:-$(nproc)}"
  echo "== $tests under Wine"
  "$wine" "build/windows/tree/tests/$tests/${tests}_tests.exe" \
    ${left_out[@]+"--test-case-exclude=$(IFS=,; echo "${left_out[*]}")"} || failed=1
done

echo "== an FMU under Wine"
compiler=(x86_64-w64-mingw32-g++-posix -std=c++20 -O1 -static -Icore -Icapi/include -Icapi/src)
"${compiler[@]}" -shared -DPUNCTURA_STATIC -DPUNCTURA_VERSION='""' integrations/fmi/*.cpp capi/src/*.cpp \
  -o build/windows/fmu.dll
"${compiler[@]}" tests/windows/fmu_folder.cpp -o build/windows/fmu_folder.exe
python -c "import punctura as pn; from punctura.fmu.description import scene_file_text
print(end=scene_file_text(pn.load_scene('k06-fig12')))" >build/windows/scene.txt
"$wine" build/windows/fmu_folder.exe build/windows/fmu.dll build/windows/scene.txt || failed=1
exit $failed
