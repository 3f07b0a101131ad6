#!/usr/bin/env bash
# Checks and times ./run and ./test in a fresh clone on a bare Debian that has only git, Python and certificates.
#   sudo tools/bare_machine.sh                    Debian 12 (bookworm), then Debian 13 (trixie)
#   sudo tools/bare_machine.sh testing            only one of them, or the next Debian
#   sudo tools/bare_machine.sh --keep FOLDER ...  keeps systems and logs in FOLDER; the next call reuses the bare system
# Needs debootstrap, 8 GB of disk and about an hour per system. Prints the tables of docs/bare-machine.md.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)

suites=() folder="" words=("$@")
while [ $# -gt 0 ]; do
  case $1 in
    bookworm | trixie | testing) suites+=("$1") ;;
    --keep) folder=${2:?"--keep needs a folder"} && shift ;;
    *) sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
  esac
  shift
done
[ ${#suites[@]} -gt 0 ] || suites=(bookworm trixie)

if [ "$(id -u)" -ne 0 ]; then echo "Creating a bare system needs root rights. Run: sudo $0" >&2; exit 1; fi
command -v debootstrap >/dev/null || { echo "debootstrap is missing: apt-get install debootstrap" >&2; exit 1; }

# Run each system separately, so that a failure of one does not skip the other.
if [ ${#suites[@]} -gt 1 ]; then
  failed=0
  for suite in "${suites[@]}"; do "$0" ${folder:+--keep "$folder"} "$suite" || failed=1; done
  exit $failed
fi
suite=${suites[0]}

# A private mount namespace, so that no mount is left behind.
if [ -z "${PUNCTURA_IN_NAMESPACE:-}" ]; then
  PUNCTURA_IN_NAMESPACE=1 exec unshare --mount --propagation private "$0" "${words[@]}"
fi

place=${folder:-$(mktemp -d /var/tmp/punctura-bare.XXXXXX)}
place=$(mkdir -p "$place/$suite" && cd "$place/$suite" && pwd -P)
log=$place/log
mkdir -p "$log"
say() { printf '%s\n' "$*" >&2; }
clean_up() {
  local mounted
  for mounted in "$place"/*/proc "$place"/*/dev; do if mountpoint -q "$mounted"; then umount -R -l "$mounted"; fi; done
  if [ -z "$folder" ]; then rm -rf --one-file-system "$(dirname "$place")"; fi
}
trap clean_up EXIT

# Copies this machine's network settings for Debian's archive and PyPI.
first_mirror() {
  apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 2>/dev/null |
    grep -v security | sort -u | head -n 1
}
mirror=${MIRROR:-$(first_mirror)}
mirror=${mirror:-http://deb.debian.org/debian}
carry() {
  local into=$1 file name
  cp -L /etc/resolv.conf /etc/hosts "$into/etc/"
  for file in $(grep -lsE '^\s*Acquire' /etc/apt/apt.conf /etc/apt/apt.conf.d/* | grep -v docker) /etc/pip.conf; do
    if [ -f "$file" ]; then install -D -m 644 "$file" "$into$file"; fi
  done
  if [ -d /usr/local/share/ca-certificates ]; then cp -rL /usr/local/share/ca-certificates "$into/usr/local/share/"; fi
  chroot "$into" update-ca-certificates >/dev/null 2>&1
  settings=()
  for name in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY \
    PIP_INDEX_URL PIP_EXTRA_INDEX_URL PIP_CERT SSL_CERT_FILE REQUESTS_CA_BUNDLE NODE_EXTRA_CA_CERTS; do
    if [ -n "${!name:-}" ]; then settings+=("$name=${!name}"); fi
  done
}

# inside SYSTEM USER COMMAND: runs the command as in that user's login shell, without this session's environment.
inside() {
  local system=$1 user=$2 home
  home=$(chroot "$system" getent passwd "$user" | cut -d: -f6)
  chroot --userspec="$user" "$system" /usr/bin/env -i HOME="$home" USER="$user" TERM=dumb LANG=C.UTF-8 \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "${settings[@]}" bash -c "cd && $3" </dev/null
}

# a_system NAME: a fresh copy of the bare system, with the repository to clone in /srv.
a_system() {
  local system=$place/$1
  rm -rf --one-file-system "$system"
  cp -a "$place/base" "$system"
  mkdir -p "$system/proc" "$system/dev"
  mount -t proc proc "$system/proc"
  mount --rbind /dev "$system/dev"
  git clone -q --bare "$root" "$system/srv/punctura.git"
  git config --file "$system/etc/gitconfig" safe.directory '*'
  chroot "$system" useradd --create-home --shell /bin/bash ann
  echo "$system"
}

table=""
# timed SYSTEM USER WORDS COMMAND EXPECTED-EXIT: runs the command, checks its exit status, adds a row to the table.
timed() {
  local code=0 file=$log/${1##*/}-${3// /-}.log took
  TIMEFORMAT='%0R s | %0U s'
  took=$({ time inside "$1" "$2" "$4" >"$file" 2>&1; } 2>&1) || code=$?
  say "$3: $took, exit $code"
  table="$table| $3 | $took |
"
  if [ $code -ne "$5" ]; then
    say "expected exit status $5; the end of $file:"
    tail -n 40 "$file" >&2
    report
    exit 1
  fi
}

# report: prints the table so far, and the steps of the first ./test.
report() {
  printf '\nDebian %s (%s; debootstrap minbase + git python3 ca-certificates), %s cores, commit %s\n\n' \
    "$(cat "$place/base/etc/debian_version")" "$suite" "$(nproc)" "$(git -C "$root" rev-parse --short HEAD)"
  printf '| what | by the clock | of the processor |\n|---|---|---|\n%s\n' "$table"
  grep -hE '^  [a-z]+ +(passed|FAILED) ' "$log/root-test,-after-run.log" 2>/dev/null || true
}

if [ ! -f "$place/base/.made" ]; then
  say "Creating a bare $suite ..."
  rm -rf --one-file-system "$place/base"
  debootstrap --variant=minbase --include=git,python3,ca-certificates "$suite" "$place/base" "$mirror" \
    >"$log/debootstrap.log" 2>&1 ||
    { tail -n 20 "$log/debootstrap.log" >&2; exit 1; }
  touch "$place/base/.made"
fi
carry "$place/base"

# As root, from another folder, with a space in the path.
system=$(a_system root)
inside "$system" root "git clone -q /srv/punctura.git 'a clone'"
# The studio runs until Ctrl-C, so limit it to one second.
timed "$system" root "run, first time, to the studio's page" "'a clone/run' run --no-browser --duration 1" 0
timed "$system" root "run, second time" "'a clone/run' run --no-browser --duration 1" 0
timed "$system" root "run reproduce" "'a clone/run' reproduce" 0
timed "$system" root "test, after run" "'a clone/test'" 0
timed "$system" root "test tree, second time" "'a clone/test' tree" 0
installed=$(inside "$system" root 'awk "/^Commandline: apt-get/ { \$1 = \"\"; print }" /var/log/apt/history.log' |
  sed 's/.*--no-install-recommends//')
sizes=$(inside "$system" root 'cd "a clone" && du -sh .venv build | tr "\t\n" " ;"')

# A user without root rights and sudo: ./run prints the command that root must type.
system=$(a_system user)
timed "$system" ann "run, by a user without rights" \
  "git clone -q /srv/punctura.git punctura && punctura/run run --no-browser --duration 1" 1
line=$(grep -m 1 -o 'apt-get update && apt-get install .*' "$log/user-run,-by-a-user-without-rights.log")
inside "$system" root "$line" >"$log/line.log" 2>&1
timed "$system" ann "run, by that user, after root typed the line" "punctura/run run --no-browser --duration 1" 0

report
printf '\nDebian packages installed by it:\n%s\n\nDisk: %s\n' "$installed" "$sizes"
