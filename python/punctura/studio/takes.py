"""Recordings that have ended, while their files are finished: beside the worker, who has the next run to look after."""

from __future__ import annotations

import threading
from collections.abc import Callable

from punctura.record import Recorder, RecorderStatus


class Takes:
    """`finish` returns at once; `wait` when all are done."""

    def __init__(self) -> None:
        self._threads: list[threading.Thread] = []

    def finish(self, recorder: Recorder, then: Callable[[RecorderStatus], None]) -> None:
        """Turns the recording of a stopped loop into its last form; `then` is called in a thread of its own."""
        thread = threading.Thread(target=lambda: then(recorder.finish()), name="punctura-finish")
        self._threads = [t for t in self._threads if t.is_alive()] + [thread]
        thread.start()

    def wait(self) -> None:
        for thread in self._threads:
            thread.join()
