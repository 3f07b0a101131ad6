# Selects Python: PYTHON if set; else the first complete one (>= 3.10, venv, headers), the system's before others; else
# the first that is new enough.

# python_facts PYTHON: prints its version; yes or old; complete, or what it lacks; and its real path (a shim or a venv
# leads elsewhere).
python_facts() {
  "$1" - <<'PY' 2>/dev/null
import importlib.util, os, sys, sysconfig
lacks = []
if not (importlib.util.find_spec("ensurepip") and importlib.util.find_spec("venv")):
    lacks.append("venv")
if not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")):
    lacks.append("headers")
print("%d.%d.%d" % sys.version_info[:3], "yes" if sys.version_info >= (3, 10) else "old", "+".join(lacks) or "complete",
      os.path.realpath(sys.executable))
PY
}

# Sets python (a path), python_version (3.11.2), python_minor (3.11) and python_lacks ("complete", "venv", "headers",
# "venv+headers").
find_python() {
  local candidate path version new_enough lacks real best="" old=""
  for candidate in "${PYTHON:-/usr/bin/python3}" python3 python3.13 python3.12 python3.11 python3.10; do
    if path=$(command -v "$candidate" 2>/dev/null) &&
      read -r version new_enough lacks real <<<"$(python_facts "$path")"; then
      if [ "$new_enough" = old ]; then old="$old $path ($version)"; fi
      if [ "$new_enough" = yes ]; then
        [ -n "$best" ] || best="$version $lacks $real"
        if [ "$lacks" = complete ]; then best="$version $lacks $real" && break; fi
      fi
    fi
    [ -z "${PYTHON:-}" ] || break
  done
  if [ -z "$best" ] && [ -n "${PYTHON:-}" ]; then
    old=$([ -n "$old" ] && echo "too old:$old" || echo "not a working Python")
    fail "PYTHON=$PYTHON is $old. Punctura needs Python 3.10 or newer: set another one, or leave PYTHON unset."
  elif [ -z "$best" ]; then
    fail "Punctura needs Python 3.10 or newer.${old:+ Found only:$old.}" \
      "Install one (Debian, Ubuntu: apt-get install python3), or give its path: PYTHON=/path/to/python3 ./run"
  fi
  read -r python_version python_lacks python <<<"$best"
  python_minor=${python_version%.*}
}
