"""Wakes a thread that waits, also from a signal handler: no lock is taken, which the interrupted code might hold."""

from __future__ import annotations

import socket
from contextlib import suppress
from types import TracebackType


class Bell:
    """One thread waits; any thread, and the system's own signal handler by `fileno`, may ring."""

    def __init__(self) -> None:
        self._waiter, self._ringer = socket.socketpair()
        self._ringer.setblocking(False)  # a full socket wakes as well

    def fileno(self) -> int:
        """For signal.set_wakeup_fd: each signal is one byte, its number."""
        return self._ringer.fileno()

    def ring(self) -> None:
        with suppress(BlockingIOError):
            self._ringer.send(b"\0")

    def wait(self, seconds: float) -> bytes:
        """What has come, 0 for a `ring`; empty if nothing came in this time (s, above 0)."""
        self._waiter.settimeout(seconds)
        try:
            return self._waiter.recv(256)
        except TimeoutError:
            return b""

    def __enter__(self) -> Bell:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._waiter.close()
        self._ringer.close()
