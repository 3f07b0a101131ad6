"""A user's type checker accepts right programs and finds mistakes. pyright gives the same, but needs a download."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("mypy")
HERE = Path(__file__).parent


@pytest.fixture(scope="module")
def refused():
    """The lines that mypy refuses, by file."""
    files = ["tests/python/typing/user_program.py", "tests/python/typing/user_mistakes.py"]
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", "build/mypy", *files]
    done = subprocess.run(command, cwd=HERE.parents[2], capture_output=True, text=True, timeout=300)
    assert done.returncode == 1 and "errors" in done.stdout.splitlines()[-1], done.stdout + done.stderr
    lines: dict[str, set[int]] = {}
    for path, line in re.findall(r"^(.+?):(\d+): error: ", done.stdout, re.MULTILINE):
        lines.setdefault(path, set()).add(int(line))
    return lines


def test_mistakes_are_found_where_they_are_and_a_right_program_is_accepted(refused):
    text = (HERE / "user_mistakes.py").read_text(encoding="utf-8")
    wrong = {number for number, line in enumerate(text.splitlines(), 1) if line.endswith("# wrong")}
    assert len(wrong) == 7 and refused == {"tests/python/typing/user_mistakes.py": wrong}
