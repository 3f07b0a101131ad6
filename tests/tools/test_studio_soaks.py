"""Runs the soak test and the fuzzer of the studio for a few seconds each. `./test statistics` runs it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

TOOLS = Path(__file__).parents[2] / "tools"


@pytest.mark.statistics
@pytest.mark.skipif(os.name != "posix", reason="ends the studio by a signal")
@pytest.mark.parametrize(
    "command",
    [
        ["soak_studio.py", "--minutes", "0.05"],
        ["fuzz_studio.py", "--minutes", "0.05"],
        ["soak_sockets.py", "silent", "--seconds", "2"],
    ],
    ids=" ".join,
)
def test_a_short_run_passes(command):
    tool, *more = command
    done = subprocess.run([sys.executable, str(TOOLS / tool), *more], capture_output=True, text=True, timeout=180)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "passed" in done.stdout
