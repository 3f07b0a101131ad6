"""A signal ends a run, and nothing else: the force ends before the program does."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

# A suspended program gives no tick, and the device would keep its last force: Ctrl-Z ends a run, too.
ENDING = ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT", "SIGTSTP", "SIGBREAK")


class Ended(BaseException):
    """A signal asked the run to end. Not an Exception: nothing on the way may take it for an error and go on."""

    def __init__(self, number: int) -> None:
        self.number = number
        self.name = signal.Signals(number).name
        super().__init__(self.name)


def ignore_more_signals() -> None:
    """For a program that ends anyway: nothing that comes now makes a difference but to its last words."""
    for name in ENDING:
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_IGN)


@contextmanager
def ends_on_signals() -> Iterator[None]:
    """Turns an interrupt, a termination, a suspension and a closed terminal into Ended, the first of them only.

    What the first has begun, no force and a recording made whole, is not cut short by a second. What the caller ignores
    (nohup) stays ignored.
    """
    if threading.current_thread() is not threading.main_thread():  # only the main thread may take signals
        yield
        return
    ended = False

    def end(number: int, _frame: FrameType | None) -> None:
        nonlocal ended
        if not ended:
            ended = True
            raise Ended(number)

    numbers = [getattr(signal, name) for name in ENDING if hasattr(signal, name)]
    before = {number: signal.getsignal(number) for number in numbers}
    taken = [number for number in numbers if before[number] not in (signal.SIG_IGN, None)]
    for number in taken:
        signal.signal(number, end)
    try:
        yield
    finally:
        for number in taken:
            signal.signal(number, before[number])
