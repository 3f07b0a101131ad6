# Which Python: PYTHON if set; else the first complete one (>= 3.10, venv, headers), the system's before others; else the first that is new enough.

# python_facts PYTHON: prints its version; yes or old; complete, or what it lacks; and its real path (a shim or a venv leads elsewhere).
python_facts() {
  "$1" - <<'PY' 2>/dev/null
import importlib.util, os, sys, sysconfig
lacks = []
if not (importlib.util.find_spec("ensurepip") and importlib.util.find_spec("venv")):
    lacks.append("venv")
if not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")):
    lacks.append("headers")
print("%d.%d.%d" % sys.version_info[:3], "yes" if sys.version_info >= (3, 10) else "old", "+".join(lacks) or "complete", os.path.realpath(sys.executable))
PY
}

# Sets python (a path), python_version (3.11.2), python_minor (3.11) and python_lacks ("complete", "venv", "headers", "venv+headers").
find_python() {
  local candidate path facts version new_enough lacks real fallback="" seen=""
  for candidate in ${PYTHON:+"$PYTHON"} /usr/bin/python3 python3 python3.13 python3.12 python3.11 python3.10; do
    path=$(command -v "$candidate" 2>/dev/null) || continue
    facts=$(python_facts "$path") || continue
    read -r version new_enough lacks real <<<"$facts"
    if [ "$new_enough" = yes ]; then
      if [ "$lacks" = complete ] || [ "$candidate" = "${PYTHON:-}" ]; then
        python=$real python_version=$version python_minor=${version%.*} python_lacks=$lacks
        return 0
      fi
      [ -n "$fallback" ] || fallback="$version $lacks $real"
    else
      seen="$seen $path ($version)"
    fi
    if [ -n "${PYTHON:-}" ]; then break; fi
  done
  if [ -n "${PYTHON:-}" ]; then
    fail "PYTHON=$PYTHON is ${seen:+too old:$seen. }${seen:-no Python that runs. }Punctura needs Python 3.10 or newer; name one, or leave PYTHON unset."
  fi
  [ -n "$fallback" ] || fail "Punctura needs Python 3.10 or newer.${seen:+ Found only:$seen.} Install one (Debian, Ubuntu: apt-get install python3), or say where it is: PYTHON=/path/to/python3 ./run"
  read -r python_version python_lacks python <<<"$fallback"
  python_minor=${python_version%.*}
}
