"""Finishes the files of ended recordings in threads of their own, while the worker runs the next run."""

from __future__ import annotations

import threading
from collections.abc import Callable

from punctura.record import Recorder, RecorderStatus


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
