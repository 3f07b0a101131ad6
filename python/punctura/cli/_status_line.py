"""One line that says how a live run is doing, rewritten in place on a terminal."""

from __future__ import annotations

import sys
import time
from contextlib import suppress
from typing import TextIO

from punctura.live import RunSummary

EVERY_S = 0.1


class StatusLine:
    """Silent where nobody watches."""

    def __init__(self, stream: TextIO | None = None) -> None:
        self._stream = stream or sys.stderr
        self._next = 0.0
        self._width = 0

    def __call__(self, summary: RunSummary, trouble: str = "") -> None:
        """trouble: of the recording, in words."""
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + EVERY_S
        text = status_text(summary) + (f"  RECORDING: {trouble}" if trouble else "")
        with suppress(OSError, ValueError):  # the terminal may be gone
            if self._stream.isatty():
                self._stream.write("\r" + text.ljust(self._width))
                self._stream.flush()
                self._width = len(text)

    def end(self) -> None:
        with suppress(OSError, ValueError):
            if self._width:
                self._stream.write("\r" + " " * self._width + "\r")
                self._stream.flush()


def status_text(summary: RunSummary) -> str:
    """Time, rate, state, force, and of each membrane depth and phase."""
    x, y, z = summary.force_N
    cut = f" (of {summary.model_force_N:.2f} N: {summary.limit})" if summary.limit else ""
    membranes = "  ".join(
        f"{name} {depth * 1e3:.1f} mm {phase.replace('_', ' ')}"
        for name, depth, phase in zip(summary.membranes, summary.depth_m, summary.phases, strict=False)
    )
    return (
        f"{summary.time_s:6.1f} s  {summary.rate_Hz:g} Hz  {summary.state}  "
        f"force {x:+.2f} {y:+.2f} {z:+.2f} N{cut}  {membranes}  lost {summary.gaps}"
    )
