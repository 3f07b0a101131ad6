"""mypy accepts the examples and correct user programs, and finds mistakes. tools/check_pyright.sh asks pyright."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("mypy")
HERE = Path(__file__).parent
ROOT = HERE.parents[2]
PROGRAMS = ("arrays_program", "user_program", "user_mistakes")


def test_mistakes_are_found_where_they_are_and_right_programs_and_the_examples_are_accepted():
    files = [f"tests/python/typing/{name}.py" for name in PROGRAMS] + list(map(str, ROOT.glob("examples/python/*.py")))
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", "build/mypy", *files]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300)
    assert done.returncode == 1 and "errors" in done.stdout.splitlines()[-1], done.stdout + done.stderr
    refused: dict[str, set[int]] = {}
    for path, line in re.findall(r"^(.+?):(\d+): error: ", done.stdout, re.MULTILINE):
        refused.setdefault(path, set()).add(int(line))
    text = (HERE / "user_mistakes.py").read_text(encoding="utf-8")
    wrong = {number for number, line in enumerate(text.splitlines(), 1) if line.endswith("# wrong")}
    assert len(wrong) == 7 and refused == {"tests/python/typing/user_mistakes.py": wrong}
