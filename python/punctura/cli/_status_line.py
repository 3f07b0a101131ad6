"""The status line of a live run, rewritten in place on a terminal."""

from __future__ import annotations

import time

from punctura.live import RunSummary, felt_force
from punctura.process.dropping_stream import DroppingStream

EVERY_S = 0.1


class StatusLine:
    """Prints nothing without a terminal, or while the terminal takes no text."""

    def __init__(self, stream: DroppingStream) -> None:
        self._stream = stream
        self._next = 0.0
        self._width = 0

    def __call__(self, summary: RunSummary, trouble: str = "") -> None:
        """trouble: of the recording, in words."""
        now = time.monotonic()
        if now >= self._next:
            self._next = now + EVERY_S
            self.show(status_text(summary) + (f"  RECORDING: {trouble}" if trouble else ""))

    def show(self, text: str) -> None:
        if self._stream.isatty() and self._stream.offer("\r" + text.ljust(self._width)):
            self._width = len(text)

    def end(self) -> None:
        if self._width:
            self._stream.write("\r" + " " * self._width + "\r")
            self._stream.flush()
            self._width = 0


def status_text(summary: RunSummary) -> str:
    """Time, rate, state, force, and of each membrane depth and phase."""
    x, y, z = summary.force_N
    wanted = summary.force_scale * summary.model_force_N
    cut = f" (of {wanted:.2f} N: {summary.limit})" if summary.limit else ""
    membranes = "  ".join(
        f"{name} {depth * 1e3:.1f} mm {phase.replace('_', ' ')}"
        for name, depth, phase in zip(summary.membranes, summary.depth_m, summary.phases, strict=False)
    )
    thumb = f"  thumb {summary.thumb_N:+.2f} N" if summary.second_device else ""
    return (
        f"{summary.time_s:6.1f} s  {summary.rate_hz:g} Hz  {summary.state}  "
        f"{felt_force(summary.force_scale)} {x:+.2f} {y:+.2f} {z:+.2f} N{cut}{thumb}  {membranes}  lost {summary.lost}"
    )
