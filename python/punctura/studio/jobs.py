"""The worker's queue of jobs, and the threads that finish recordings meanwhile."""

import queue
import threading
from collections.abc import Callable
from concurrent.futures import Future
from typing import TypeVar

from punctura.record import Recorder, RecorderStatus

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


class Takes:
    """`finish` returns at once; `wait` returns when all are done."""

    def __init__(self) -> None:
        self._threads: list[threading.Thread] = []

    def finish(self, recorder: Recorder, then: Callable[[RecorderStatus], None]) -> None:
        """Finishes the recording of a stopped loop in a new thread, which then calls `then`."""
        thread = threading.Thread(target=lambda: then(recorder.finish()), name="punctura-finish")
        self._threads = [t for t in self._threads if t.is_alive()] + [thread]
        thread.start()

    def wait(self) -> None:
        for thread in self._threads:
            thread.join()
