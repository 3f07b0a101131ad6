# One calm line per step on the terminal; everything else in build/log.

note() { printf '  %s\n' "$*"; }
fail() { printf '\n%s\n' "$*" >&2; exit 1; }
exec 8>&2  # the terminal, also where a step has its output in a log
trap 'printf "\nStopped. Nothing half-made is believed: start again when you like.\n" >&8; exit 130' INT TERM

# step TITLE LOG COMMAND...: runs the command with its output in build/log/LOG.log, and prints the title and the seconds it took.
# On a failure the end of the log and what to do; returns only if all went well.
step() {
  local title=$1 log=$root/build/log/$2.log start=$SECONDS code=0
  shift 2
  mkdir -p "$root/build/log"
  printf '  %s ... ' "$title"
  "$@" >"$log" 2>&1 </dev/null || code=$?
  [ $code -ne 0 ] || { printf '%d s\n' $((SECONDS - start)); return 0; }
  printf 'FAILED after %d s\n' $((SECONDS - start))
  { echo; tail -n 15 "$log" | sed 's/^/    /'; } >&2
  fail "$(advice "$log")
The whole log: $log"
}

# What a person can do about the failure in a log.
advice() {
  if grep -qiE 'CERTIFICATE_VERIFY_FAILED|certificate verif' "$1"; then
    echo "A certificate was not trusted. Install ca-certificates (or your organisation's certificate), or set PIP_CERT, then start again."
  elif grep -qiE 'NewConnectionError|Temporary failure (in name resolution|resolving)|Could not resolve|Network is unreachable|Max retries exceeded|ConnectTimeout|Failed to fetch|ProxyError' "$1"; then
    echo "The network could not be reached (see above). Check the connection, or the proxy and the package index in your settings, then start again."
  elif grep -qiE 'No matching distribution found' "$1"; then
    echo "The package index does not answer, or has nothing for this Python ($python_version). Check the network and pip's settings (pip config list), then start again."
  elif grep -qiE 'No space left on device' "$1"; then
    echo "The disk is full. Punctura needs about 2 GB; make room, then start again."
  elif grep -qiE 'Permission denied' "$1"; then
    echo "A file could not be written. If an earlier run was made as another user, give the folder back to yours (chown -R), then start again."
  elif grep -qiE 'dpkg was interrupted' "$1"; then
    echo "An earlier installation was cut off. As root, type  dpkg --configure -a  and start again."
  elif grep -qiE 'Could not get lock|is another process using it' "$1"; then
    echo "Another program is installing packages. Wait until it is done, then start again."
  else
    echo "The lines above say what went wrong. When it is mended, start again: finished steps are not repeated."
  fi
}
