"""Stops a loop whose ticks have ceased: a device without ticks keeps its last force."""

from __future__ import annotations

import threading
from collections.abc import Callable

from punctura._core import ServoLoop, ThumbLoop
from punctura.defects import explain
from punctura.live import SilenceWatch

POLL_S = 0.05


class Watchdog:
    """A thread that does nothing else, so that no file, page or exercise can block it."""

    def __init__(self, tell: Callable[[ServoLoop, str], None]) -> None:
        """tell: called with the loop that is being stopped, and the reason. It must not block."""
        self._tell = tell
        self._watched: tuple[ServoLoop, SilenceWatch] | None = None
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._work, name="punctura-watchdog", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def end(self) -> None:
        """Does not wait for the thread: it may be inside the driver's stop, which may never return."""
        self._over.set()

    def watch(self, loop: ServoLoop, thumb: ThumbLoop | None = None) -> None:
        """From any thread: watches this started loop instead of the one before."""
        self._watched = (loop, SilenceWatch(loop, thumb))

    def _work(self) -> None:
        stopped = None
        while not self._over.wait(POLL_S):
            watched = self._watched
            if watched is None or watched is stopped or not watched[0].running:
                continue
            loop, watch = watched
            if words := self._ceased(watch):
                stopped = watched
                self._tell(loop, words)  # first: a driver's stop may never return
                loop.stop()  # does nothing if the worker has stopped the loop meanwhile

    @staticmethod
    def _ceased(watch: SilenceWatch) -> str:
        try:
            return watch.ceased()
        except Exception as error:  # without a view of the ticks the force must end
            return f"the ticks cannot be watched, and the run is stopped: {explain(error)}"
