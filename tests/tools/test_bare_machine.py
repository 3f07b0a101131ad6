"""Checks the parts of tools/bare_machine.sh that need no new system."""

import subprocess
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[2] / "tools/bare_machine.sh"


@pytest.mark.parametrize("words", [["buster"], ["--help"], ["trixie", "/tmp"]])
def test_a_word_that_is_no_debian_we_know_makes_nothing_and_shows_the_usage(words: list[str]) -> None:
    done = subprocess.run([SCRIPT, *words], capture_output=True, text=True, check=False)
    assert done.returncode == 2 and done.stdout == ""
    assert "Debian 12 (bookworm), then Debian 13 (trixie)" in done.stderr and "--keep FOLDER" in done.stderr
