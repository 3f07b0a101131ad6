"""Waits for a condition with a time limit, for tests and tools."""

import time
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")

PATIENCE_S = 240.0  # long enough for a busy computer, where a program takes a minute to start
POLL_S = 1e-3
LATE_ALLOWED = {"stale": 30.0, "deadline": 30.0}  # s, of a gate: a tick that a busy computer delays is no fault


def wait_until(condition: Callable[[], T], seconds: float = PATIENCE_S, poll: float = POLL_S) -> T:
    """Returns what `condition` returns as soon as that is true. Raises TimeoutError after `seconds`."""
    end = time.monotonic() + seconds
    while not (found := condition()):
        if time.monotonic() > end:
            raise TimeoutError(f"the condition did not become true within {seconds:g} s")
        time.sleep(poll)
    return found
