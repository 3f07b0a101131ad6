"""Ends a run in time, even if the terminal or the caller's code blocks."""

import math
import threading
import time
from collections.abc import Callable

from punctura.process.signals import Signals

POLL_S = 0.05


class Supervisor:
    """One thread begins and ends a run: after its duration, when `over` returns True, at a signal, or at `stop`.

    It prints nothing, and calls nothing that may wait for a terminal, a file or a page.
    """

    def __init__(
        self,
        signals: Signals,
        begin: Callable[[], None],
        over: Callable[[], bool],
        end: Callable[[], None],
        duration: float | None = None,
    ) -> None:
        """over: called about 20 times a second. end: called once, also if `over` raises. duration: s."""
        self._signals, self._begin, self._is_over, self._end = signals, begin, over, end
        self._duration = math.inf if duration is None else duration
        self._asked = self._started = False
        self._begun, self._ended = threading.Event(), threading.Event()
        self._error: BaseException | None = None
        self._thread = threading.Thread(target=self._work, name="punctura-supervisor", daemon=True)

    def start(self) -> None:
        """Returns when the run has begun. Raises what `begin` raises; `end` is not called then.

        Not for use inside a `raised` block: a half-started thread cannot be stopped.
        """
        self._thread.start()
        self._started = True
        self._begun.wait()
        self._raise_error()

    def wait(self, seconds: float | None = None) -> bool:
        """Waits at most this time (s) for the end of the run; without a number, until it ends. True if it has ended."""
        return self._ended.wait(seconds)

    def stop(self) -> None:
        """Returns when the run has ended. Raises what `over` or `end` has raised."""
        self._asked = True
        self._signals.wake()
        if self._started:
            self._thread.join()
        self._raise_error()

    def _raise_error(self) -> None:
        error, self._error = self._error, None
        if error is not None:
            raise error

    def _work(self) -> None:
        try:
            if self._asked or self._signals.number:
                return
            self._begin()
            try:
                self._begun.set()
                self._watch()
            finally:
                self._end()
                self._signals.resend()
        except BaseException as error:  # raised in the thread that waits
            self._error = error
        finally:
            self._begun.set()
            self._ended.set()

    def _watch(self) -> None:
        ends_at = time.monotonic() + self._duration
        while not self._asked and not self._is_over():
            left = ends_at - time.monotonic()
            if left <= 0 or self._signals.wait(min(POLL_S, left)):
                return
