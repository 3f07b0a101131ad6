"""CMakeLists.txt defines the version; files that cannot read it from there have the same one."""

import json
import re
from importlib.metadata import version
from pathlib import Path

import punctura

ROOT = Path(__file__).parents[2]


def test_every_place_has_the_same_version():
    number = re.search(r"project\(punctura VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
    assert punctura.__version__ == number
    assert version("punctura") == number
    assert json.loads((ROOT / "web" / "package.json").read_text())["version"] == number
    assert f"\nversion: {number}\n" in (ROOT / "CITATION.cff").read_text()
    assert f"## {number}" in (ROOT / "CHANGELOG.md").read_text()
