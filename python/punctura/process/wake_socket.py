"""Wakes a waiting thread, also from a signal handler: it takes no lock, because the interrupted code may hold it."""

from __future__ import annotations

import socket
from contextlib import suppress
from types import TracebackType


class WakeSocket:
    """One thread waits; any thread may wake it, and so may the system's signal handler, through `fileno`."""

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
