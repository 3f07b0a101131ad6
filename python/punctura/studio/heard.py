"""When the page that moves the simulated hand was heard."""

from __future__ import annotations

import time
from collections import deque

import numpy as np
import numpy.typing as npt

KEPT = 4096  # words; a page sends at most some hundred a second


class Heard:
    """A page that says that it is awake is late when it is silent. One that never says so is never late."""

    def __init__(self) -> None:
        self._words: deque[float] = deque(maxlen=KEPT)  # time.monotonic()

    def forget(self) -> None:
        """A new run: its page must say first that it is awake."""
        self._words.clear()

    def hear(self, awake: bool = False) -> None:
        """From any thread: a word of the page. awake: it says that it is awake, and will go on to do so."""
        if awake or self._words:
            self._words.append(time.monotonic())

    def age(self, times: npt.NDArray[np.float64], now: float) -> npt.NDArray[np.float64]:
        """Time since the last word before each tick, s; 0 before the first word. times: of the ticks up to `now`, s."""
        words = np.array(list(self._words), np.float64)
        if len(words) == 0:
            return np.zeros(len(times))
        at = now - (times[-1] - times)
        last = np.searchsorted(words, at, side="right") - 1
        age: npt.NDArray[np.float64] = np.where(last >= 0, at - words[np.maximum(last, 0)], 0.0)
        return age
