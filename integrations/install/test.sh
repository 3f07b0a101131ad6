#!/usr/bin/env bash
# A stranger's first commands, with a wheel in empty environments: by pip, by uv tool and by pipx.
#   WHEEL=FILE integrations/install/test.sh     with the wheel of a release; without WHEEL, one is compiled
source "$(dirname "$0")/../tools.sh"
need python3 python3
need curl curl
rm -rf "$work" && mkdir -p "$work/home" "$work/wheel"
wheel=${WHEEL:-}
if [ -z "$wheel" ]; then
  python3 -m pip wheel -q --no-deps -w "$work/wheel" "$root" >"$work/log" 2>&1 || { tail -n 30 "$work/log"; exit 1; }
  wheel=$(echo "$work"/wheel/*.whl)
fi
wheel=$(realpath "$wheel")
python=$(python3 -c 'import sys; print(sys._base_executable)') # not that of .venv
"$python" -m venv "$work/tools"
"$work/tools/bin/pip" install -q uv pipx || { echo "uv and pipx cannot be installed here"; exit 77; }
export HOME=$work/home UV_PYTHON=$python PIPX_DEFAULT_PYTHON=$python PATH=$work/tools/bin:/usr/bin:/bin
unset VIRTUAL_ENV PYTHONPATH

# first_commands: those of the first screens of README.md and of docs/identify.md.
first_commands() (
  rm -rf "$work/empty" && mkdir "$work/empty" && cd "$work/empty"
  punctura --version
  punctura scenes
  punctura example motion
  punctura simulate venipuncture --motion motion.csv --out out.csv
  punctura devices
  punctura schema >schema.json
  punctura reproduce
  punctura example trace
  punctura identify trace.csv --needle diameter_mm=1.2,tip_angle_rad=0.4 --scene found.toml
  punctura simulate found.toml --motion motion.csv --out found.parquet
  punctura run --headless --device simulated --duration 1 found.toml
  punctura run --no-browser >studio.log 2>&1 &
  trap 'kill $!' EXIT
  for _ in $(seq 300); do ! grep -q http:// studio.log || break; sleep 0.2; done
  address=$(grep -oE 'http://[^[:space:]]+' studio.log | head -n 1)
  curl -sSfL -o page.html "$address" && grep -qi '<!doctype html>' page.html
  echo "the studio's page opens at its address"
)

"$python" -m venv "$work/venv"
"$work/venv/bin/pip" install -q "${wheel}[all]"
(PATH=$work/venv/bin:$PATH first_commands)
awk '/^```/ { inside = /^```python/ && ++blocks == 1; next } inside' "$root/README.md" >"$work/readme.py"
(cd "$work/home" && "$work/venv/bin/python" "$work/readme.py" && "$work/venv/bin/python" -m punctura --version)
echo "pip: the first commands and the first program of README.md"

uv tool install -q "${wheel}[all]"
(PATH=$HOME/.local/bin:$PATH first_commands) >"$work/by-uv"
uv tool uninstall -q punctura
echo "uv tool: the first commands"
pipx install -q "${wheel}[all]"
(PATH=$HOME/.local/bin:$PATH first_commands) >"$work/by-pipx"
echo "pipx: the first commands"
