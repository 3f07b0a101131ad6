# Prints one line per step on the terminal. All other output goes to build/log.

note() { printf '  %s\n' "$*"; }
fail() { printf '\n%s\n' "$*" >&2; exit 1; }
exec 8>&2  # the terminal, even while a step writes to a log
trap 'printf "\nStopped. Incomplete steps will be repeated: start again at any time.\n" >&8; exit 130' INT TERM HUP

# step TITLE LOG COMMAND...: runs the command with its output in build/log/LOG.log, and prints the title and the time
# in seconds. On a failure it prints the end of the log and the remedy, and exits.
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

# The remedy for the failure in a log.
advice() {
  if grep -qiE 'CERTIFICATE_VERIFY_FAILED|certificate verif|invalid peer certificate' "$1"; then
    echo "A certificate was not trusted. Install ca-certificates (or your organisation's certificate)," \
      "or set PIP_CERT and SSL_CERT_FILE to its file, then start again."
  elif grep -qiE -e 'NewConnectionError|Temporary failure (in name resolution|resolving)|Could not resolve' \
    -e 'Network is unreachable|Max retries exceeded|ConnectTimeout|Failed to fetch|ProxyError' "$1"; then
    echo "The network is not reachable (see above). Check the connection," \
      "or the proxy and the package index in your settings, then start again."
  elif grep -qiE 'No matching distribution found|No solution found' "$1"; then
    echo "The package index does not answer, or has no package for this Python ($python_version)." \
      "Check the network and pip's settings (pip config list), then start again. If you changed pyproject.toml, run" \
      "tools/lock.sh first."
  elif grep -qiE 'No space left on device' "$1"; then
    echo "The disk is full. Punctura needs about 2 GB; free some space, then start again."
  elif grep -qiE 'Permission denied' "$1"; then
    echo "A file could not be written. If another user ran this before," \
      "make yourself the owner of the folder (chown -R), then start again."
  elif grep -qiE 'dpkg was interrupted' "$1"; then
    echo "An earlier installation was interrupted. As root, run  dpkg --configure -a  and start again."
  elif grep -qiE 'Could not get lock|is another process using it' "$1"; then
    echo "Another program is installing packages. Wait until it has finished, then start again."
  else
    echo "See the error above. Fix it, then start again: finished steps are not repeated."
  fi
}
