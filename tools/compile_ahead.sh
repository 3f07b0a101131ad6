# Compiles the C++ of ./test. It starts in the background, at the lowest priority, while other steps leave a processor
# idle.

# compile PRESET [TARGET...]: configures if needed, then builds on all cores. A build folder of another path is
# configured afresh. Waits while the preset is compiled ahead; then little is left to do, but an error shows here.
compile() {
  local preset=$1 fresh="" cache=build/$1/CMakeCache.txt
  shift
  while [ -n "$ahead" ] && [ -f "build/log/ahead-$preset" ] && kill -0 "$ahead" 2>/dev/null; do sleep 0.2; done
  if [ -f "$cache" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then fresh=--fresh; fi
  cmake $fresh --preset "$preset" -DCMAKE_COLOR_DIAGNOSTICS=OFF && cmake --build --preset "$preset" ${1:+--target "$@"}
}

# compile_NAME: the compilation of step_NAME. The golden forces also run with fused multiply-add allowed.
compile_cpp() { if has_fma; then compile dev all golden_forces_fma; else compile dev; fi; }
compile_asan() { compile asan all punctura_headers; }
compile_tsan() { compile tsan runtime_tests; }
has_fma() { grep -qsw fma /proc/cpuinfo; }
preset_of() { if [ "$1" = cpp ]; then echo dev; else echo "$1"; fi; }

ahead=""  # the process group that compiles ahead

# compile_ahead STEP...: starts to compile for those of these steps that have a compile_NAME. Does nothing if no long
# step runs meanwhile: then they compile at the usual priority.
compile_ahead() {
  local name later="" others=""
  rm -f build/log/ahead-*
  for name in "$@"; do
    if declare -F "compile_$name" >/dev/null; then later="$later $name"; fi
    case $name in python | docs | page) others=yes ;; esac
  done
  if [ -z "$later" ] || [ -z "$others" ]; then return 0; fi
  for name in $later; do : >"build/log/ahead-$(preset_of "$name")"; done
  set -m  # a process group of its own
  (
    renice -n 19 -p "$BASHPID" || true
    for name in $later; do
      kill -0 "$$" || break  # ./test was killed
      "compile_$name" || true
      rm -f "build/log/ahead-$(preset_of "$name")"
    done
  ) >build/log/ahead.log 2>&1 </dev/null &
  ahead=$!
  set +m
}
