"""The priority of computations beside a run."""

import os
import subprocess
import sys

import pytest
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
    ran = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True)
    before, asked, lowest = map(int, ran.stdout.split())
    assert (asked, lowest) == (before, LOWEST)


SESSION = """
import subprocess, sys
subprocess.run([sys.executable, "-c", "from punctura.compare.background import step_back; step_back()"], check=True)
print(open("/proc/self/autogroup").read())
"""


@pytest.mark.skipif(not os.path.exists("/proc/self/autogroup"), reason="only Linux schedules by sessions")
def test_the_other_programs_of_its_terminal_keep_their_priority():
    ran = subprocess.run(
        [sys.executable, "-c", SESSION], capture_output=True, text=True, check=True, start_new_session=True
    )
    assert ran.stdout.split()[-1] == "0"
