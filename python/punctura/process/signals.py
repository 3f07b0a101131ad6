"""A signal ends the run, not the program: the force ends first."""

from __future__ import annotations

import signal
import socket
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from types import FrameType, TracebackType
from typing import Any


class WakeSocket:
    """One thread waits; any thread may wake it, and so may the system's signal handler, through `fileno`.

    It takes no lock, because the interrupted code may hold it.
    """

    def __init__(self) -> None:
        self._receiver, self._sender = socket.socketpair()
        self._sender.setblocking(False)  # a full socket wakes the thread, too

    def fileno(self) -> int:
        """For signal.set_wakeup_fd: each signal is one byte, its number."""
        return self._sender.fileno()

    def wake(self) -> None:
        with suppress(BlockingIOError):
            self._sender.send(b"\0")

    def wait(self, seconds: float) -> bytes:
        """The bytes that came, 0 for a `wake`; empty if nothing came in this time (s, above 0)."""
        self._receiver.settimeout(seconds)
        try:
            return self._receiver.recv(256)
        except TimeoutError:
            return b""

    def __enter__(self) -> WakeSocket:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._receiver.close()
        self._sender.close()


RETRY_S = 0.05
TRIES = 100
ENDING = ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT", "SIGBREAK")
# A suspended program gives no tick, and the device would keep its last force: Ctrl-Z ends a run, too.
ENDING_A_RUN = (*ENDING, "SIGTSTP")


class Ended(BaseException):
    """A signal ended the run. Not an Exception, so that no `except Exception` catches it."""

    summary: Any = None  # the RunSummary of a run that had begun, complete

    def __init__(self, number: int) -> None:
        self.number = number
        self.name = signal.Signals(number).name
        super().__init__(self.name)


def ignore_more_signals() -> None:
    """For a program that is ending: another signal could only cut its last messages."""
    for name in ENDING_A_RUN:
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_IGN)


class Signals:
    """The signals of one `ends_on_signals` block. The first one counts, later ones are ignored.

    The waiting thread gets it at once, whatever the main thread does. The main thread gets Ended: inside a `raised`
    block at once, elsewhere at the end of the whole block. So clean-up code is never interrupted.
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
        """For the main thread: in this block, and only there, the first signal raises Ended at once."""
        self._raises = True
        try:
            if self.number:
                raise Ended(self.number)
            yield
        finally:  # a signal that comes in these lines may still raise, and then no other one does
            self._raises = False

    def wait(self, seconds: float) -> bool:
        """For one thread: whether a signal came. Waits at most this time (s, above 0), or until `wake`.

        If the caller has installed a handler for a signal meanwhile, that signal does not count.
        """
        for number in self._wake_socket.wait(seconds):
            if self._is_ours(number):
                self._came = self._came or number
        return self._came != 0

    def resend(self) -> None:
        """For the same thread: makes sure that the main thread handles a signal that came.

        A signal that comes just before a blocking system call of the main thread does not interrupt that call.
        Gives up after 5 s, or at once if the caller has installed a handler.
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
        """Installs the handlers. A signal that the program ignores (nohup) stays ignored."""
        Signals._innermost = self
        for number in (getattr(signal, name) for name in names if hasattr(signal, name)):
            before = signal.getsignal(number)
            if before not in (signal.SIG_IGN, None):
                self._before[number] = before
                signal.signal(number, self._handle)
        self._wakeup = signal.set_wakeup_fd(self._wake_socket.fileno(), warn_on_full_buffer=False)

    def give_back(self) -> None:
        """Restores the handlers from before, unless somebody has replaced ours meanwhile."""
        signal.set_wakeup_fd(self._wakeup, warn_on_full_buffer=False)
        Signals._innermost = self._outer
        for number, handler in self._before.items():
            if self._is_ours(number):
                signal.signal(number, handler)

    def _is_ours(self, number: int) -> bool:
        """Whether this block handles the signal, and its handler is still installed."""
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
    """In this block these signals raise Ended; class Signals says when.

    Does nothing outside the main thread: only the main thread handles signals.
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
