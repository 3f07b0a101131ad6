"""mypy accepts the examples and a user's program in strict mode. tools/check_pyright.sh asks pyright the same."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[3]


def test_mypy_accepts_the_examples_and_a_program_that_passes_arrays() -> None:
    files = ["tests/python/typing/arrays_program.py", *map(str, sorted(ROOT.glob("examples/python/*.py")))]
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", "build/mypy", *files]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
