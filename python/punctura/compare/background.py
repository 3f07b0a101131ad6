"""The priority of a computation beside a run: the loop and the page come first."""

import contextlib
import math
import os
import time
from pathlib import Path

NICE = "PUNCTURA_LAB_NICE"
LOWEST = 19


def processor_s(process: int) -> float:
    """The processor time that a process has taken, s; infinite where the system does not say it, as outside Linux."""
    try:
        return time.clock_gettime(~process << 3 | 2)  # the number of its clock
    except (AttributeError, OSError):
        return math.inf


def step_back() -> None:
    """Gives this process the lowest priority, or the niceness in PUNCTURA_LAB_NICE (0 to 19).

    On Linux, too: a process with a session of its own has a scheduling group of its own, whose share does not depend
    on the niceness of its processes, so the group steps back as well; and without memory, this process ends first. The
    group of another session, such as a terminal's, stays as it is.
    """
    word = os.environ.get(NICE, "")
    level = min(int(word), LOWEST) if word.isdecimal() else LOWEST
    if hasattr(os, "nice"):
        os.nice(max(0, level - os.nice(0)))  # without rights, a process cannot become less nice
    alone = hasattr(os, "getsid") and os.getsid(0) == os.getpid()
    for file, value in (*([("autogroup", level)] if alone else []), ("oom_score_adj", 1000)):
        with contextlib.suppress(OSError):  # another system, or a kernel without it
            Path("/proc/self", file).write_text(str(value))
