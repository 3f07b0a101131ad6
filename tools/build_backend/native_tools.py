"""Checks for a C++20 compiler and Python's headers, which pip cannot install and CMake reports unclearly."""

import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

# The compilers that CMake tries if CXX is not set.
COMPILERS = ("c++", "CC", "g++", "clang++", "icpx", "icx")
PROBE = "#include <concepts>\nint main() { return std::same_as<int, int> ? 0 : 1; }\n"
OS_RELEASE = Path("/etc/os-release")
# Keys: ID and ID_LIKE of os-release.
INSTALL = {
    "debian": "sudo apt-get install g++ python3-dev",
    "fedora": "sudo dnf install gcc-c++ python3-devel",
    "suse": "sudo zypper install gcc-c++ python3-devel",
    "arch": "sudo pacman -S gcc",
    "alpine": "sudo apk add g++ python3-dev",
}
NAMES = {
    "debian": "Debian, Ubuntu",
    "fedora": "Fedora, Red Hat",
    "suse": "openSUSE",
    "arch": "Arch",
    "alpine": "Alpine",
}
ON_MACOS = "xcode-select --install"


class ToolsError(Exception):
    """A tool is missing. The message says how to install it."""


def check() -> None:
    """Raises ToolsError. Checks nothing on Windows or if a compiler was given to CMake itself: only CMake can tell."""
    named = os.environ.get("CMAKE_ARGS", "") + " ".join(name for name in os.environ if name == "CMAKE_TOOLCHAIN_FILE")
    if sys.platform == "win32" or "CMAKE_CXX_COMPILER=" in named or "CMAKE_TOOLCHAIN_FILE" in named:
        return
    missing = [trouble for trouble in (_compiler(), _headers()) if trouble]
    if missing:
        raise ToolsError(
            f"Punctura cannot be compiled: {'; '.join(missing)}. Install the missing tools and try again:\n{remedy()}"
        )


def remedy() -> str:
    """The install command for this system, or those for all systems if this one is unknown."""
    if sys.platform == "darwin":
        return f"    {ON_MACOS}"
    ids = _ids()
    for system, line in INSTALL.items():
        if system in ids:
            return f"    {line}"
    lines = [f"    {NAMES[system] + ':':<18}{line}" for system, line in INSTALL.items()]
    return "\n".join(
        [
            *lines,
            f"    {'macOS:':<18}{ON_MACOS}",
            "    elsewhere:        a C++20 compiler (GCC 10, Clang 14 or newer), Python's headers",
        ]
    )


def _compiler() -> str:
    """The reason why there is no usable compiler; empty if there is one."""
    asked = os.environ.get("CXX", "").strip()
    if asked:
        trouble = _trouble(shlex.split(asked), f"CXX={asked}")
        return trouble and f"{trouble}: name another one, or leave CXX unset"
    found = next((path for name in COMPILERS if (path := shutil.which(name))), None)
    return _trouble([found], found) if found else "there is no C++ compiler"


def _trouble(command: list[str], name: str) -> str:
    flags = ["-std=c++20", "-x", "c++", "-fsyntax-only", "-"]
    try:
        probe = subprocess.run([*command, *flags], input=PROBE, capture_output=True, text=True, check=False)
    except OSError as error:
        return f"{name} does not start ({error.strerror})"
    if probe.returncode == 0:
        return ""
    first = next(iter(probe.stderr.strip().splitlines()), "no reason given")
    return f"{name} is not a C++20 compiler ({first})"


def _headers() -> str:
    include = sysconfig.get_path("include")
    if (Path(include) / "Python.h").is_file():
        return ""
    return f"Python's headers are missing ({include}/Python.h)"


def _ids() -> set[str]:
    """The ids of this system and of similar ones: debian, ubuntu, ..."""
    ids: set[str] = set()
    if OS_RELEASE.is_file():
        for line in OS_RELEASE.read_text().splitlines():
            key, _, value = line.partition("=")
            if key in ("ID", "ID_LIKE"):
                ids.update(value.strip("\"'").replace("opensuse", "suse").replace("rhel", "fedora").split())
    return ids
