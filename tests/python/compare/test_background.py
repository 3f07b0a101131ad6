"""The priority of computations beside a run."""

import os
import subprocess
import sys

from punctura.compare.background import LOWEST, NICE

PROGRAM = f"""
import os
from punctura.compare.background import step_back
print(max(os.nice(0), 0))
os.environ[{NICE!r}] = "0"
step_back()
print(os.nice(0))
os.environ[{NICE!r}] = "much"
step_back()
print(os.nice(0))
"""


def test_a_computation_gets_the_lowest_priority_or_the_one_that_is_asked_for():
    ran = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True, env=os.environ)
    before, asked, lowest = map(int, ran.stdout.split())
    assert (asked, lowest) == (before, LOWEST)
