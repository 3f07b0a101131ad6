# The steps of ./test, each a function step_NAME. A step fails by its exit status. All chosen steps run, then a
# summary is printed.

all_steps="tree format types web cpp asan tsan consumer examples instructions docs page python"
fast_steps="tree format types web cpp python"
named_steps="tidy statistics integrations"  # they run only by name

choose_steps() {
  local name
  steps=$all_steps
  case ${1:-} in
    "") return 0 ;;
    --fast) steps=$fast_steps ;;
    --list) echo "$all_steps $named_steps"; exit 0 ;;
    -h | --help) sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$root/test"; exit 0 ;;
    *)
      steps=$(printf '%s\n' "$@" | awk '!seen[$0]++')  # each one once
      for name in "$@"; do
        case " $all_steps $named_steps " in
          *" $name "*) ;;
          *) fail "No step is called '$name'. The steps: $all_steps $named_steps" ;;
        esac
      done
      ;;
  esac
}

# Steps that run side by side: each string is a row of steps, one after another. What compiles and computes goes beside
# the Python tests, which wait for processes and clocks. The page comes last: a browser needs both cores for itself.
# A row has its steps in the order of all_steps. Those that build/dev is for are in one row, because two builds of one
# folder disturb each other; web brings the modules that page needs.
rows=(tree format types "web cpp asan tsan consumer examples instructions docs page" python "$named_steps")

# Groups of processes that run in the background; they end with this program, however it ends.
groups=""
end_groups() {
  local group
  for group in $groups; do kill -- "-$group" 2>/dev/null || true; done
}

run_steps() {
  local name row passed=0 failed="" count=0 began=$SECONDS log code seconds processor group started=""
  cd "$root"
  for name in $steps; do rm -f "build/log/test-$name.log.result"; done
  trap end_groups EXIT
  trap 'printf "\nStopped.\n" >&8; exit 130' INT TERM HUP
  set -m  # each in a process group of its own, because a background job does not get Ctrl-C
  for row in "${rows[@]}"; do
    row=$(chosen_of $row)
    [ -n "$row" ] || continue
    run_row $row &
    groups="$groups $!"
    disown  # so that bash does not print that it has ended
    for name in $row; do started="$started $name:$!"; done
  done
  set +m
  for name in $steps; do
    log=build/log/test-$name.log
    group=${started##* $name:} group=${group%% *}
    printf '  %-12s ' "$name"
    while [ ! -s "$log.result" ] && kill -0 "$group" 2>/dev/null; do sleep 0.2; done
    kill -0 "$group" 2>/dev/null || groups=${groups/ $group/}  # its number may soon be another group's
    { read -r code seconds processor <"$log.result"; } 2>/dev/null || code=137 seconds=0 processor=0  # it was killed
    if [ "$code" -eq 0 ]; then
      passed=$((passed + 1))
      printf 'passed %4d s, %4d s of a processor   %s\n' "$seconds" "$processor" "$(closing_line "$log")"
      sed -n 's/^note: /               /p' "$log"
    else
      failed="$failed $name" count=$((count + 1))
      printf 'FAILED %4d s   the end of %s:\n' "$seconds" "$log"
      tail -n "${PUNCTURA_LOG_LINES:-60}" "$log" | sed 's/^/    /'
    fi
  done
  [ -z "$failed" ] || printf '\nFailed:%s. To repeat only these: ./test%s\n' "$failed" "$failed"
  printf '\nIn %d s, steps:\n%d passed, %d failed\n' $((SECONDS - began)) $passed $count
  [ -z "$failed" ]
}

# chosen_of STEP...: those of them that are to run.
chosen_of() {
  local name
  for name in "$@"; do case " $(echo $steps) " in *" $name "*) printf '%s ' "$name" ;; esac; done
}

run_row() {
  local name
  for name in "$@"; do run_step "$name"; done
}

# run_step NAME: runs the step with its output in its log, and writes its exit status, its time (s) and that of its
# processors (s) beside it.
run_step() {
  local log=build/log/test-$1.log start=$SECONDS code=0 TIMEFORMAT='%U %S' user system
  { time { ("step_$1") >"$log" 2>&1 </dev/null || code=$?; }; } 2>"$log.time"
  read -r user system < <(tail -n 1 "$log.time")
  echo "$code $((SECONDS - start)) $((${user%%[.,]*} + ${system%%[.,]*}))" >"$log.result"
}

# The last line of the step's test runner with the number of passed tests.
closing_line() {
  grep -aE -e '^=+ .*(passed|failed).* =+$|[0-9]+ passed.* in [0-9.]+s|^\[doctest\] (test cases|assertions):' \
    -e '^Success: no issues|^tree: |^ *Tests +[0-9]+' "$1" | tail -n 1 | tr -s ' =' || true
}

# Checks the rules of the source tree: rooms, sizes, equations, numbers in text and standard headers.
step_tree() {
  local check code=0
  for check in rooms sizes equations locale includes; do python "tools/check_$check.py" || code=1; done
  return $code
}

ours() {
  git ls-files -z --cached --others --exclude-standard "$@" |
    while IFS= read -r -d '' f; do [ ! -f "$f" ] || printf '%s\0' "$f"; done
}
step_format() {
  local code=0
  ruff check . || code=1
  ruff format --check . || code=1
  ours '*.hpp' '*.cpp' | xargs -0 clang-format --dry-run -Werror || code=1
  return $code
}
step_types() { mypy; }

# compile PRESET [TARGET...]: configures if needed, then builds on all cores, with less weight than the tests that run
# meanwhile. A build folder of another path is configured afresh. What the wheel's build has compiled is not
# compiled again in dev, and beside asan neither are the tests of the runtime that asan runs whole.
compile() {
  local preset=$1 fresh="" settings=() beside_asan=OFF cache=build/$1/CMakeCache.txt
  shift
  if [ -f "$cache" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then fresh=--fresh; fi
  if [ "$preset" = dev ]; then
    ! has_run asan || beside_asan=ON
    settings=("-DPUNCTURA_COMPILED=$(of_the_wheel)" "-DPUNCTURA_BESIDE_ASAN=$beside_asan")
  fi
  cmake $fresh --preset "$preset" -DCMAKE_COLOR_DIAGNOSTICS=OFF ${settings[@]+"${settings[@]}"} &&
    nice -n 5 cmake --build --preset "$preset" ${1:+--target "$@"}
}

# The folder of the wheel's last build: there is one for each Python, and objects.cmake keeps its date in a later build.
of_the_wheel() { dirname "$(ls -t "$root"/build/python/*/.ninja_log | head -n 1)"; }

# side_by_side A B: runs two single-threaded programs at the same time. Prints the output of a failed one last.
side_by_side() {
  local logs=build/log/side-by-side a_failed=0 b_failed=0 a b
  "$1" >"$logs-a.log" 2>&1 & a=$!
  "$2" >"$logs-b.log" 2>&1 & b=$!
  trap 'kill $a $b 2>/dev/null; exit 130' INT TERM HUP  # background jobs of a script do not get Ctrl-C
  wait $a || a_failed=1
  wait $b || b_failed=1
  trap - INT TERM HUP
  if [ $a_failed -eq 1 ]; then cat "$logs-b.log" "$logs-a.log"; else cat "$logs-a.log" "$logs-b.log"; fi
  return $((a_failed || b_failed))
}
# both_tests PRESET [OPTION]: the tests of core and runtime.
both_tests() { tests=build/$1/tests option=${2:-} && side_by_side core_tests runtime_tests; }
core_tests() { "$tests/core/core_tests" $option; }
runtime_tests() { "$tests/runtime/runtime_tests" $option; }

# The C++ tests, compiled by GCC. The golden forces also run with fused multiply-add allowed.
step_cpp() {
  if grep -qsw fma /proc/cpuinfo; then
    compile dev all golden_forces_fma && build/dev/tests/core/golden_forces_fma || return
  else
    compile dev || return
  fi
  build/dev/tests/core/core_without_exceptions && build/dev/tests/core/core_without_heap &&
    build/dev/tests/core/core_c_decimals && build/dev/tests/capi/capi_tests &&
    tools/check_exports.sh build/dev/capi/libpunctura.so && check_isa && both_tests dev
}
check_isa() { [ "$(uname -m)" != x86_64 ] || tools/check_isa.sh "$(of_the_wheel)"; }

# Compiles the runtime, tests and each header alone with Clang, for its warnings. Runs the tests under sanitizers with
# fewer random cases and without numbers whose code other tests reach, because sanitizers are slow. Without AVX: that
# code differs from the usual one in the width of a vector only, and -O2 with a sanitizer compiles slowly. cpp tests it.
step_asan() {
  compile asan core_tests runtime_tests punctura_headers || return
  export UBSAN_OPTIONS=print_stacktrace=1 PUNCTURA_CASES="${PUNCTURA_CASES:-14}"
  both_tests asan --test-suite-exclude=numbers
}
# Without AVX: the threads of a batch run the same code with each instruction set.
step_tsan() {
  compile tsan runtime_tests || return
  # The sanitizer does not support threads in the child of a fork.
  tsan_tests=("$root/build/tsan/tests/runtime/runtime_tests" --test-case-exclude='the child of a fork*'
    --test-suite-exclude=numbers)
  export PUNCTURA_CASES="${PUNCTURA_CASES:-14}"
  # The sanitizer cannot start if the kernel randomizes addresses too much; setarch -R turns that off.
  local listed
  listed=$("${tsan_tests[@]}" --list-test-cases 2>&1) || case $listed in
    *"unexpected memory mapping"*) tsan_tests=(setarch "$(uname -m)" -R "${tsan_tests[@]}") ;;
  esac
  side_by_side tsan_makers tsan_others
}
tsan_makers() { "${tsan_tests[@]}" --source-file='*force_dimension*,*haply*'; }
tsan_others() { "${tsan_tests[@]}" --source-file-exclude='*force_dimension*,*haply*'; }

# An external project: with the core installed, with core, runtime and C library installed, with the Python package,
# and with Punctura as a subfolder. Most of the time is one compiler at a time, so the ways go side by side.
step_consumer() {
  rm -rf build/consumer
  compile dev && side_by_side consumer_installed consumer_in_tree
}
consumer_installed() {
  local prefix=$root/build/consumer/prefix built=$root/build/consumer/from-runtime
  cmake --install build/dev --prefix "$prefix/runtime" &&
    use_it from-runtime -DCMAKE_PREFIX_PATH="$prefix/runtime" -DWITH_RUNTIME=ON -DWITH_C=ON &&
    "$built/own_device" && "$built/devices" && "$built/insert" python/punctura/ready_scenes/k06-fig12.toml &&
    use_it from-wheel -Dpunctura_DIR="$(punctura paths --cmake)"
}
consumer_in_tree() {
  local prefix=$root/build/consumer/prefix
  cmake -S . -B build/consumer/core -G Ninja && cmake --install build/consumer/core --prefix "$prefix/core" &&
    use_it from-core -DCMAKE_PREFIX_PATH="$prefix/core" &&
    use_it subfolder -DPUNCTURA_TREE="$root" -DWITH_RUNTIME=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
}
use_it() {
  cmake -S tests/consumer -B "build/consumer/$1" -G Ninja "${@:2}" && cmake --build "build/consumer/$1" &&
    "build/consumer/$1/consumer"
}

# The instructions of a tick, counted by valgrind, are not more than the stored ones.
step_instructions() { python benchmarks/instructions.py --check; }

# A sixteenth of the random cases; the step `statistics` draws all of them. Each worker imports and finds all tests,
# which takes 17 s of a processor.
step_python() { PUNCTURA_CASES="${PUNCTURA_CASES:-1/16}" python_tests -n 2 --dist loadgroup; }
python_tests() {
  local but=()
  if ! has_siconos; then
    if known python3-siconos; then
      echo "Siconos is missing. Run: apt-get install python3-siconos"
      return 1
    fi
    echo "note: this system's archives have no python3-siconos." \
      "The comparison with Siconos is skipped; that with SciPy runs."
    local file=tests/python/proxy/test_relay_siconos.py
    but=(--deselect "$file"::test_the_force_of_33_is_the_force_that_siconos_finds_for_the_same_relay)
  fi
  python -m pytest --durations=15 "$@" ${but[@]+"${but[@]}"}
}

# The studio's page: types, of which those of the server's messages are made first; lint, unused exports, tests, size.
step_web() {
  local code=0
  export NO_COLOR=1
  python tools/build_backend/studio_page.py && python tools/build_backend/studio_page.py --modules || return
  python tools/check_bundle.py || code=1
  cd web || return
  npm run -s check || code=1
  npm run -s lint || code=1
  npm run -s unused || code=1
  # Modules are imported once for all files, which takes a third of the time, but for tests that need their own.
  local alone="tests/frames.test.ts tests/panel.test.ts tests/hand/awake.test.ts tests/plots/kit/svg_pen.test.ts"
  npm test -- --pool=threads $alone || code=1
  npm test -- --pool=threads --no-isolate $(printf -- '--exclude %s ' $alone) || code=1
  return $code
}

# The studio in a real browser, used as a person uses it.
step_page() {
  local package
  if has_browser; then
    python -m pytest -n 2 --dist loadscope --no-loadscope-reorder --durations=8 tests/page
  elif package=$(browser_package); then
    echo "Chromium is missing. Run: apt-get install $package"
    return 1
  else
    echo "note: the page was NOT tested: there is no Chromium, and this system's archives have no package of it." \
      "Install Google Chrome (google.com/chrome), then run ./test page."
  fi
}

# The documentation: every code block runs, and the site builds without a warning.
step_docs() { side_by_side docs_snippets docs_site; }
docs_snippets() {
  if has_run cpp; then export PUNCTURA_FAKES=$root/build/dev/tests/runtime/fakes; fi
  PYTHONPATH=tests/docs:docs/site python -m pytest -n 2 --dist loadfile -p snippets \
    tests/docs README.md CONTRIBUTING.md examples/README.md docs
}
docs_site() {
  if has_run examples; then export PUNCTURA_EXAMPLES=$root/build/dev/examples; fi
  python docs/site/build.py --quick
}
# has_run STEP: a step before has compiled what build/dev has for it.
has_run() { [ -n "$(chosen_of "$1")" ]; }

# Runs every example in C++. The gallery of the documentation runs those in Python, and draws their results.
step_examples() {
  local example
  compile dev && mkdir -p build/examples && cd build/examples || return
  for example in "$root"/examples/cpp/*.cpp; do
    example=$(basename "$example" .cpp)
    echo "examples/cpp/$example.cpp" && "$root/build/dev/examples/$example" || return
  done
  "$root/build/dev/examples/faulty_law"
  [ $? = 1 ] || { echo "a fault of example 08 does not end it with 1"; return 1; }
}

# The steps below run only by name.

# Slow, and its findings are a matter of taste.
step_tidy() { pip install -q "clang-tidy==23.*" && compile tidy punctura_headers; }

# What is too slow for every run: statistical checks with many seeds, and the tests with all their random cases. Some
# take more than the usual ten minutes on a busy computer.
step_statistics() {
  local drawing
  drawing=$(git grep -lE 'cases\.(batches|count|asked)|@given' -- 'tests/python/*/test_*.py') &&
    python_tests -n 2 --timeout 3600 $drawing && python -m pytest -n 2 --durations=15 --timeout 3600 -m statistics
}

# Each environment that Punctura plugs into, with its own tool chain: integrations/README.md.
step_integrations() {
  if [ -f integrations/run.sh ]; then bash integrations/run.sh; else echo "note: there is no integrations/run.sh"; fi
}
