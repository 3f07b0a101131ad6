"""A signal ends a run, and nothing else: the force ends before the program does."""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from types import FrameType
from typing import Any

from punctura.live.wake_socket import WakeSocket

RETRY_S = 0.05
TRIES = 100
ENDING = ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT", "SIGBREAK")
# A suspended program gives no tick, and the device would keep its last force: Ctrl-Z ends a run, too.
ENDING_A_RUN = (*ENDING, "SIGTSTP")


class Ended(BaseException):
    """A signal asked the run to end. Not an Exception: nothing on the way may take it for an error and go on."""

    def __init__(self, number: int) -> None:
        self.number = number
        self.name = signal.Signals(number).name
        super().__init__(self.name)


def ignore_more_signals() -> None:
    """For a program that ends anyway: nothing that comes now makes a difference but to its last words."""
    for name in ENDING_A_RUN:
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_IGN)


class Signals:
    """The signals of one `ends_on_signals` block. The first one counts, later ones are ignored.

    It reaches the thread that waits for it at once, whatever the main thread does. The main thread gets Ended: inside a
    `raised` block at once, elsewhere at the end of the whole block. So cleaning up is never cut short.
    """

    _innermost: Signals | None = None

    def __init__(self, wake_socket: WakeSocket) -> None:
        self.number = 0  # of the first signal, as soon as the main thread has taken it
        self._came = 0
        self._wake_socket = wake_socket
        self._raises = False
        self._before: dict[int, Any] = {}
        self._wakeup = -1
        self._outer = Signals._innermost

    @contextmanager
    def raised(self) -> Iterator[None]:
        """Of the main thread: in this block, and only there, the first signal raises Ended at once."""
        self._raises = True
        try:
            if self.number:
                raise Ended(self.number)
            yield
        finally:  # a signal that comes in these lines may still raise, and then no other one does
            self._raises = False

    def wait(self, seconds: float) -> bool:
        """Of one thread: whether a signal came. Waits so long for it (s, above 0), or until `wake`.

        A signal for which the caller has installed a handler of its own meanwhile is the caller's.
        """
        for number in self._wake_socket.wait(seconds):
            if self._is_ours(number):
                self._came = self._came or number
        return self._came != 0

    def resend(self) -> None:
        """Of the same thread: sees to it that the main thread takes a signal that came.

        One that comes just before the main thread begins to wait in the system does not end that wait by itself.
        Gives up after 5 s, and at once where the caller has installed a handler of its own.
        """
        main = threading.main_thread().ident
        if main is None or not hasattr(signal, "pthread_kill"):
            return
        for _ in range(TRIES):
            if self.number or not self._is_ours(self._came):
                return
            signal.pthread_kill(main, self._came)
            time.sleep(RETRY_S)

    def wake(self) -> None:
        """From any thread."""
        self._wake_socket.wake()

    def take(self, names: Sequence[str]) -> None:
        """Installs the handlers. What the program ignores already (nohup) stays ignored."""
        Signals._innermost = self
        for number in (getattr(signal, name) for name in names if hasattr(signal, name)):
            before = signal.getsignal(number)
            if before not in (signal.SIG_IGN, None):
                self._before[number] = before
                signal.signal(number, self._handle)
        self._wakeup = signal.set_wakeup_fd(self._wake_socket.fileno(), warn_on_full_buffer=False)

    def give_back(self) -> None:
        """Installs what was there before, where nobody has installed something else meanwhile."""
        signal.set_wakeup_fd(self._wakeup, warn_on_full_buffer=False)
        Signals._innermost = self._outer
        for number, handler in self._before.items():
            if self._is_ours(number):
                signal.signal(number, handler)

    def _is_ours(self, number: int) -> bool:
        """Whether this block took the signal, and its handler is still the one that is installed."""
        return number in self._before and signal.getsignal(number) == self._handle

    def _handle(self, number: int, _frame: FrameType | None) -> None:
        """Takes no lock: the code that it interrupts may hold it."""
        if self.number:
            return
        block: Signals | None = self
        while block is not None:  # for the blocks around this one it is the first signal, too
            block.number, block = block.number or number, block._outer
        if self._raises:
            raise Ended(number)


@contextmanager
def ends_on_signals(names: Sequence[str] = ENDING_A_RUN) -> Iterator[Signals]:
    """In this block these signals raise Ended, in place of what they do otherwise; see Signals for the moment.

    Does nothing in a thread other than the main one: only that one may take signals.
    """
    with WakeSocket() as wake_socket:
        signals = Signals(wake_socket)
        if threading.current_thread() is not threading.main_thread():
            yield signals
            return
        try:
            signals.take(names)
            yield signals
        finally:
            signals.give_back()
        if signals.number:
            raise Ended(signals.number)
