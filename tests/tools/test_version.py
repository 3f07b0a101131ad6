"""CMakeLists.txt defines the version; files that cannot read it from there have the same one."""

import json
import re
from importlib.metadata import version
from pathlib import Path

import punctura

ROOT = Path(__file__).parents[2]
INTEGRATIONS = {  # each file and the line with the version
    "untried/arduino/library/library.json": r'"version": "(.*)"',
    "untried/arduino/library/library.properties": r"version=(.*)",
    "untried/ros2/package.xml": r"<version>(.*)</version>",
    "untried/ros2/setup.py": r'version="(.*)"',
    "rust/Cargo.toml": r'\nversion = "(.*)"',
    "wasm/package.json": r'"version": "(.*)"',
}


def test_every_place_has_the_same_version():
    number = re.search(r"project\(punctura VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
    assert punctura.__version__ == number
    assert version("punctura") == number
    assert json.loads((ROOT / "web" / "package.json").read_text())["version"] == number
    assert f"\nversion: {number}\n" in (ROOT / "CITATION.cff").read_text()
    assert f"## {number}" in (ROOT / "CHANGELOG.md").read_text()
    for file, line in INTEGRATIONS.items():
        found = re.search(line, (ROOT / "integrations" / file).read_text())
        assert found and found[1] == number, file
