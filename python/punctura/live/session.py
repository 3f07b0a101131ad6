"""Runs a scene on a device until it is over, and leaves the device without force on every way out."""

import time
from collections.abc import Callable, Sequence

from punctura import Scene
from punctura._core import Device, Fault, ForceLimits, GateLimits, Placement, Rival, ServoLoop, ThumbLoop
from punctura.live.choose import gate_for
from punctura.live.run_notes import run_notes
from punctura.live.summary import RunSummary
from punctura.live.supervisor import POLL_S, Supervisor
from punctura.process.signals import Ended, ends_on_signals

LATCH_S = 0.1  # for the needle's ticks to latch a fault of the second device


def run_live(
    device: Device,
    scene: Scene,
    duration: float | None = None,
    gate: GateLimits | None = None,
    limits: ForceLimits | None = None,
    placement: Placement | None = None,
    watch: Callable[[RunSummary], None] | None = None,
    prepare: Callable[[ServoLoop], Callable[[], None]] | None = None,
    thumb: ThumbLoop | None = None,
    rivals: Sequence[Rival] = (),
) -> RunSummary:
    """Runs until `duration` (s) is over, a fault is latched, ticks cease, the device ends, or a signal comes.

    Separate threads end the run and the force, so `watch` may block. It may even hold the GIL, except for the end by a
    signal or a fault. A signal raises Ended: inside `watch` at once; otherwise at the end, so that neither `prepare`
    nor the function that it returns is interrupted. Its `summary` is that of the run.

    watch: called about 20 times a second with the summary; its `statements` begin with run_notes(). prepare: called
    with the loop before it starts, to add listeners; it returns a function that is called after the stop. thumb: a
    second device, on the plunger of the scene's syringe; a fault of either device ends the run. rivals: force models
    of other authors in place of the scene's law, one, or one for each membrane.
    """
    info = device.info
    summary = RunSummary.of(scene, f"{info.backend}: {info.model}", info.rate)
    if thumb is not None:
        summary.second_device = f"{thumb.device.info.backend}: {thumb.device.info.model}"
    try:
        _run(device, scene, summary, duration, gate, limits, placement, watch, prepare, thumb, rivals)
    except Ended as end:
        end.summary = summary
        raise
    return summary


def _run(
    device: Device,
    scene: Scene,
    summary: RunSummary,
    duration: float | None,
    gate: GateLimits | None,
    limits: ForceLimits | None,
    placement: Placement | None,
    watch: Callable[[RunSummary], None] | None,
    prepare: Callable[[ServoLoop], Callable[[], None]] | None,
    thumb: ThumbLoop | None,
    rivals: Sequence[Rival],
) -> None:
    with ends_on_signals() as signals:
        force, stands = limits or ForceLimits(), placement or Placement()
        loop = ServoLoop(device, scene, gate or gate_for(device), force, stands, thumb, rivals=rivals)
        summary.statements = run_notes(loop)
        listener = loop.listen()
        watched = Watched(loop, thumb, duration)
        supervisor = Supervisor(signals, watched.begin, watched.over, loop.stop)
        finish: Callable[[], None] | None = None
        try:
            finish = prepare(loop) if prepare else None
            supervisor.start()
            ended = False
            while not ended:
                ended = supervisor.wait(POLL_S)
                summary.add(listener.read())  # a signal in this line must not lose the ticks that were read
                summary.fault = summary.fault or loop.silence
                if summary.fault and ended:  # not before the stop: the driver may take time to answer
                    summary.add_trouble(device, thumb)
                if watch:
                    with signals.raised():
                        watch(summary)
        finally:
            try:
                supervisor.stop()
            finally:
                loop.stop()
                summary.add(listener.read())
                summary.finish(loop, thumb, None if signals.number else duration)
                if finish:
                    finish()


class Watched:
    """A loop as its supervisor sees it."""

    def __init__(self, loop: ServoLoop, thumb: ThumbLoop | None = None, duration: float | None = None) -> None:
        self._loop, self._thumb, self._duration = loop, thumb, duration
        self._thumb_seen: tuple[float, int] | None = None  # when its fault was seen: s, and the needle's ticks then

    def begin(self) -> None:
        """Raises DeviceError."""
        self._loop.arm()
        self._loop.start(self._duration)

    def over(self) -> bool:
        ended = getattr(self._loop.device, "finished", False) or self._loop.latest()["fault"][0]
        return bool(self._loop.over or ended or self._thumb_is_over())

    def _thumb_is_over(self) -> bool:
        """True after a fault of the second device, once the needle's ticks had the time to latch and record it.

        Needle ticks that come latch it at once, and end the force. Ticks that do not come leave the needle's last
        force on, so the wait is short. In a scene without a syringe they latch nothing, and the run ends all the same.
        """
        if self._thumb is None or self._thumb.fault == Fault.none:
            return False
        now, ticks = time.monotonic(), self._loop.report()["ticks"]
        if self._thumb_seen is None:
            self._thumb_seen = now, ticks
        seen, before = self._thumb_seen
        return ticks >= before + 2 or now - seen >= LATCH_S  # one tick may have begun before the fault
