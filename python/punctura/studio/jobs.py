"""A queue of jobs for one thread, which does them one after the other."""

from __future__ import annotations

import queue
from collections.abc import Callable
from concurrent.futures import Future
from typing import TypeVar

T = TypeVar("T")


class Jobs:
    """`post` and `call` from any thread, `do_next` in the working thread."""

    def __init__(self) -> None:
        self._waiting: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()

    def post(self, job: Callable[[], None]) -> None:
        """Adds a job; nobody waits for its end."""
        self._waiting.put(job)

    def call(self, job: Callable[[], T]) -> Future[T]:
        """Adds a job. The future gets its result or its exception."""
        future: Future[T] = Future()

        def do() -> None:
            if not future.set_running_or_notify_cancel():
                return
            try:
                future.set_result(job())
            except Exception as error:
                future.set_exception(error)

        self._waiting.put(do)
        return future

    def do_next(self, seconds: float) -> None:
        """Does one job, if one comes within this time (s)."""
        try:
            job = self._waiting.get(timeout=seconds) if seconds > 0 else self._waiting.get_nowait()
        except queue.Empty:
            return
        job()
