"""Runs a scene on a device until it is over, and leaves the device without force on every way out."""

from __future__ import annotations

import time
from collections.abc import Callable

from punctura import Scene
from punctura._core import Device, ForceLimits, GateLimits, Placement, ServoLoop
from punctura.live.choose import gate_for
from punctura.live.signals import ends_on_signals
from punctura.live.silence import SilenceWatch
from punctura.live.summary import RunSummary

ROOM_S = 8.0  # s of snapshots that wait for a reader who is late
POLL_S = 0.05


def run_live(
    device: Device,
    scene: Scene,
    duration: float | None = None,
    gate: GateLimits | None = None,
    limits: ForceLimits | None = None,
    placement: Placement | None = None,
    watch: Callable[[RunSummary], None] | None = None,
    prepare: Callable[[ServoLoop], Callable[[], None]] | None = None,
) -> RunSummary:
    """Ticks until `duration` (s) is over, a fault is latched, ticks cease, the device has ended, or a signal comes.

    A signal raises Ended, after the stop. watch: called some 20 times a second with the summary. prepare: called
    with the loop before it starts, to add listeners; what it returns is called after the stop.
    """
    info = device.info
    summary = RunSummary.of(scene, f"{info.backend}: {info.model}", info.rate)
    with ends_on_signals():
        loop = ServoLoop(device, scene, gate or gate_for(device), limits or ForceLimits(), placement or Placement())
        listener = loop.listen(int(ROOM_S * info.rate))
        finish: Callable[[], None] | None = None
        try:
            finish = prepare(loop) if prepare else None
            loop.arm()
            loop.start()
            silence, began = SilenceWatch(loop), time.monotonic()
            while not summary.fault and not getattr(device, "finished", False):
                left = POLL_S if duration is None else min(POLL_S, duration - (time.monotonic() - began))
                if left <= 0:
                    break
                time.sleep(left)
                summary.add(listener.read())
                summary.fault = summary.fault or silence.ceased()
                if summary.fault:
                    summary.blame(device)
                if watch:
                    watch(summary)
        finally:
            loop.stop()
            summary.add(listener.read())
            summary.finish(loop)
            if finish:
                finish()
    return summary
