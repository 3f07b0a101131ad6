#!/usr/bin/env bash
# Runs the test.sh of each folder here, one after the other, and prints one line per integration.
#   integrations/run.sh              all of them
#   integrations/run.sh octave rust  only these
#
# A test.sh installs what it needs, then tests its integration. Exit status 0: passed. 77: its tool chain is missing,
# and the last line of its output says what and why. Any other: failed. ./test integrations runs this script.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
log=$here/../build/log
mkdir -p "$log"

names=("$@")
if [ ${#names[@]} -eq 0 ]; then
  for test in "$here"/*/test.sh; do test=${test%/test.sh} && names+=("${test##*/}"); done
fi

passed=0 missing=0 failed=0
for name in ${names[@]+"${names[@]}"}; do
  if [ ! -f "$here/$name/test.sh" ]; then
    echo "$name: there is no integrations/$name/test.sh. Run integrations/run.sh without a name to run all."
    failed=$((failed + 1))
    continue
  fi
  start=$SECONDS code=0 file=integration-$name.log
  (cd "$here/$name" && exec bash ./test.sh) >"$log/$file" 2>&1 </dev/null || code=$?
  case $code in
    0) passed=$((passed + 1)); echo "$name: passed, $((SECONDS - start)) s" ;;
    77)
      missing=$((missing + 1))
      echo "note: $name was not tested, its tool chain is missing: $(tail -n 1 "$log/$file")"
      ;;
    *)
      failed=$((failed + 1))
      echo "$name: FAILED with status $code after $((SECONDS - start)) s. The end of build/log/$file:"
      tail -n 40 "$log/$file" | sed 's/^/    /'
      ;;
  esac
done
echo "integrations: $passed passed, $failed failed, $missing not tested because a tool chain is missing"
[ $failed -eq 0 ]
