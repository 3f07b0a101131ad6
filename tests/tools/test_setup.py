"""The set-up of ./run and ./test installs the dependencies with uv, here an artificial one, and else with pip."""

from __future__ import annotations

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
pip() { if [ "$1" = config ]; then echo "$SETTINGS"; else echo "pip $*"; fi; }
step Title install install_all test
"""


class SetUp:
    """`install_all` in a separate tree, whose uv is a script."""

    def __init__(self, root: Path, uv: str, settings: str = "") -> None:
        """settings: of pip, as `pip config list` prints them."""
        self.root = root
        (root / "tools").symlink_to(ROOT / "tools")
        self.commands = root / ".venv/bin"
        self.commands.mkdir(parents=True)
        self.command("python", f'[ -z "$2" ] && set -- "$1" "{root}/packages"; exec "{sys.executable}" "$@"')
        self.command("uv", uv)
        done = subprocess.run(
            ["bash", "-c", INSTALL, "bash", str(root)],
            capture_output=True,
            text=True,
            timeout=60,
            env={**os.environ, "SETTINGS": settings},
        )
        assert done.returncode == 0, done.stdout + done.stderr

    def command(self, name: str, script: str) -> None:
        file = self.commands / name
        file.write_text(f"#!/bin/sh\n{script}\n")
        file.chmod(0o755)

    def log(self, name: str) -> str:
        return (self.root / "build/log" / f"{name}.log").read_text()


def incomplete_package(root: Path) -> Path:
    record = root / "packages/kind-1.dist-info"
    record.mkdir(parents=True)
    (record / "METADATA").write_text("Name: kind\nVersion: 1\n")
    return record


def test_a_package_that_an_interrupted_set_up_left_incomplete_is_installed_again(tmp_path):
    record = incomplete_package(tmp_path)
    set_up = SetUp(tmp_path, f'[ ! -e "{record}" ] && echo "installs all"')
    assert "installs all" in set_up.log("uv")


def test_pip_installs_what_a_failed_uv_left_incomplete(tmp_path):
    record = tmp_path / "packages/kind-1.dist-info"
    set_up = SetUp(tmp_path, f'mkdir -p "{record}"; echo "error: No space left on device"; exit 2')
    assert not record.exists()
    assert "pip install --progress-bar off --no-build-isolation" in set_up.log("install")


def test_what_uv_says_does_not_decide_about_the_advice_after_a_failure_of_pip(tmp_path):
    set_up = SetUp(tmp_path, 'echo "error: Failed to fetch: http://mirror/simple/h11/"; exit 2')
    assert "Failed to fetch" in set_up.log("uv")
    assert "Failed to fetch" not in set_up.log("install")


def test_settings_of_uv_for_other_projects_do_not_lead_the_dependencies_elsewhere(tmp_path):
    set_up = SetUp(tmp_path, 'echo "$@"')
    assert "pip install --no-config" in set_up.log("uv")


def test_settings_of_pip_that_uv_would_not_read_leave_all_to_pip(tmp_path):
    set_up = SetUp(tmp_path, 'echo "$@"', "global.index-url='https://mirror.example/simple'")
    assert "pip install --progress-bar off --no-build-isolation" in set_up.log("install")
    assert not (tmp_path / "build/log/uv.log").exists()


def test_a_folder_of_packages_in_pips_settings_is_given_to_uv(tmp_path):
    set_up = SetUp(tmp_path, 'echo "$@"', ":env:.find-links='/opt/wheels'\nglobal.cert='/etc/ssl/cert.pem'")
    assert "--find-links /opt/wheels --python" in set_up.log("uv")


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
