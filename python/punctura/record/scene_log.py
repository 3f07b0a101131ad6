"""Finds the scene that a tick took; the tick's snapshot only says that it took one."""

import threading
import time
from collections import deque

from punctura._core import Scene, ServoLoop
from punctura.record.header import to_text

_PATIENCE_S = 0.5  # wait this long for a running loop that does not tick


class SceneLog:
    """Passes scenes to a loop and keeps them until the tick that took them arrives.

    All scene changes must go through this class, from one thread; otherwise the recording lacks their scenes.
    """

    def __init__(self, loop: ServoLoop) -> None:
        self._loop = loop
        self._rate = loop.scene.servo.rate
        self._lock = threading.Lock()
        # Each scene with the tick that takes it; None means the next tick that takes a scene.
        self._waiting: deque[tuple[str, int | None]] = deque()
        self._offered = -1  # tick count when the last scene was offered to a running loop

    def exchange(self, scene: Scene) -> None:
        """Calls ServoLoop.exchange. On ConfigurationError nothing has changed."""
        text = to_text(scene, self._rate)
        running = self._loop.running
        if running:
            self._settle()
        ticks = self._ticks()
        entry = (text, None if running else ticks)
        with self._lock:
            self._waiting.append(entry)
        try:
            self._loop.exchange(scene)
        except BaseException:
            with self._lock:
                self._waiting.remove(entry)
            raise
        self._offered = ticks if running else -1

    def taken(self, tick: int) -> list[str]:
        """The scenes that this tick took before its step; [] if this log does not know them."""
        with self._lock:
            scenes = []
            while self._waiting and self._waiting[0][1] is not None and self._waiting[0][1] <= tick:
                scenes.append(self._waiting.popleft()[0])
            if not scenes and self._waiting and self._waiting[0][1] is None:
                scenes.append(self._waiting.popleft()[0])
            return scenes

    def _ticks(self) -> int:
        return int(self._loop.report()["ticks"])

    def _settle(self) -> None:
        """Waits until the loop has taken the previous scene, so that a tick takes at most one scene."""
        with self._lock:
            before = [tick for _, tick in self._waiting if tick is not None]
        needed = max([tick + 1 for tick in before] + ([self._offered + 2] if self._offered >= 0 else []), default=0)
        deadline = time.monotonic() + _PATIENCE_S
        while self._loop.running and self._ticks() < needed:
            if time.monotonic() > deadline:  # no tick took the offer; the next one replaces it
                with self._lock:
                    if self._waiting and self._waiting[-1][1] is None:
                        self._waiting.pop()
                return
            time.sleep(1e-3)
