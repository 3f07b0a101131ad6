"""Which scene a tick has taken, when its snapshot says only that it took one."""

from __future__ import annotations

import threading
import time
from collections import deque

from punctura._core import Scene, ServoLoop
from punctura.record.scene_text import to_text

_PATIENCE_S = 0.5  # for a loop that is running and yet does not tick


class SceneLog:
    """Hands scenes to a loop, and remembers them until the tick that took them comes by.

    The loop must get its new scenes through here and from one thread, or the recording cannot know them.
    """

    def __init__(self, loop: ServoLoop) -> None:
        self._loop = loop
        self._rate = loop.scene.servo.rate
        self._lock = threading.Lock()
        # With the tick that takes it; None: the next tick that takes one.
        self._waiting: deque[tuple[str, int | None]] = deque()
        self._offered = -1  # ticks that had been when the last scene was offered to a running loop

    def exchange(self, scene: Scene) -> None:
        """ServoLoop.exchange. Raises ConfigurationError; then nothing has changed."""
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
        """The scenes that this tick took before its step; [] if they never came through here."""
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
        """Waits until what was given before has certainly been taken: each tick then takes one scene at most."""
        with self._lock:
            before = [tick for _, tick in self._waiting if tick is not None]
        needed = max([tick + 1 for tick in before] + ([self._offered + 2] if self._offered >= 0 else []), default=0)
        deadline = time.monotonic() + _PATIENCE_S
        while self._loop.running and self._ticks() < needed:
            if time.monotonic() > deadline:  # the loop drops an offer that no tick has taken when the next one comes
                with self._lock:
                    if self._waiting and self._waiting[-1][1] is None:
                        self._waiting.pop()
                return
            time.sleep(1e-3)
