"""The summary of a live run, collected during the run in constant memory."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from punctura import Phase, Scene
from punctura._core import Device, Fault, Limit, ServoLoop, ServoState, ThumbLoop, describe
from punctura.device_words import statements_of, words_of
from punctura.live.force_words import CUTS, LIMIT_WORDS
from punctura.live.run_notes import run_notes
from punctura.ticks import ABSENT, Ticks

ENOUGH = 0.99  # of the ticks that were asked for: fewer are worth a word


@dataclass(frozen=True)
class Ticked:
    """How a run of a given duration ticked, in numbers. SI."""

    duration: float  # s, that was asked for
    rate: float  # Hz, that the device states
    ticks: int
    span: float  # s, from the first tick to the last one
    late: int  # ticks that came late
    longest: float  # s, from one tick to the next
    device_ended: bool = False  # such as a replay whose recording is over
    fault: str = ""  # in words, if one ended the run

    def why_short(self) -> str:
        """A sentence; empty for a run that has its ticks."""
        wanted = round(self.duration * self.rate)
        if self.ticks == 0 or self.ticks >= ENOUGH * wanted - 1:
            return ""
        head = f"{self.ticks} ticks came, and {self.duration:g} s at {self.rate:g} Hz are {wanted}: "
        if self.fault or self.device_ended:
            return head + ("the fault ended the run" if self.fault else f"the device ended after {self.span:.3g} s")
        causes = []
        left_out = round(self.span * self.rate) + 1 - self.ticks
        if left_out > (1 - ENOUGH) / 2 * wanted:
            slow = f"the device ticks at {self.ticks / self.span:.4g} Hz"
            busy = f"{left_out} were left out because the computer or the device was late {self.late} times, by up to "
            busy += f"{max(0.0, self.longest - 1 / self.rate):.2g} s"
            causes.append(busy if self.late else slow)
        if self.duration - self.span > (1 - ENOUGH) / 2 * self.duration:
            causes.append(f"for {self.duration - self.span:.2g} s at the beginning or the end the device gave none")
        return head + " and ".join(causes)


def strongest(force: NDArray[np.float64], ceiling: NDArray[np.float64]) -> float:
    """The greatest norm of the forces (n, 3), N, under the ceilings (n,) that permitted them.

    A force that was scaled to its ceiling exceeds it by the rounding of its three numbers: that is the ceiling itself.
    """
    norm = np.linalg.norm(force, axis=1)
    rounding = 8 * np.finfo(float).eps * ceiling
    return float(np.where(norm <= ceiling + rounding, np.minimum(norm, ceiling), norm).max())


@dataclass
class RunSummary:
    """The result of a live run, SI. `punctura run --headless --json` prints all fields."""

    scene: str  # its name
    device: str  # back-end and model
    rate_hz: float  # ticks a second
    membranes: list[str]  # their names
    ticks: int = 0  # that its listener read
    lost: int = 0  # ticks whose snapshot never came
    force_scale: float = 1.0  # how much of the model's force the device gives, before the limits
    felt_peak_N: float = 0.0  # of the felt force
    peak_N: float = 0.0  # largest force of the model
    deepest_m: list[float] = field(default_factory=list)  # of each membrane
    limited_ticks: int = 0  # by peak, continuous and temperature limits; ramp-in apart
    limited_by: dict[str, int] = field(default_factory=dict)  # ticks, by the names in CUTS
    second_device: str = ""  # empty without one
    thumb_peak_N: float = 0.0  # felt force of the thumb on the second device
    injected_m3: float = 0.0  # the most that had left the scene's syringe
    fault: str = ""  # in words; empty: none
    too_few_ticks: str = ""  # why there are fewer than the duration asks for; empty: there are enough
    late: int = 0  # ticks that came late
    compute_p99_9_s: float = 0.0  # of a tick: 99.9 % were faster
    period_p50_s: float = 0.0  # from tick to tick, median
    statements: list[str] = field(default_factory=list)  # what to know about run and device
    # The last tick, for a status line.
    force_N: tuple[float, float, float] = (0.0, 0.0, 0.0)
    thumb_N: float = 0.0  # felt force of the thumb
    model_force_N: float = 0.0  # before force scale and limits, norm
    limit: str = ""  # which limit cuts the force, in words
    depth_m: list[float] = field(default_factory=list)  # now, in each membrane
    phases: list[str] = field(default_factory=list)  # now, in each membrane
    state: str = "disarmed"  # now: a ServoState
    force_was_on: bool = False  # at any time
    start_s: float | None = None  # of the first tick, since the start
    time_s: float = 0.0  # since the start

    @classmethod
    def of(cls, scene: Scene, device: str, rate: float) -> RunSummary:
        names = [placed.name for placed in scene.membranes]
        return cls(scene.name, device, rate, names, deepest_m=[0.0] * len(names))

    def add(self, ticks: Ticks) -> None:
        """Adds the ticks of a batch, as Listener.read() returns it."""
        tick = ticks.tick
        n = len(tick)
        if n == 0:
            return
        self.ticks += n
        self.start_s = float(ticks.time[0]) if self.start_s is None else self.start_s
        self.lost = int(tick[-1]) + 1 - self.ticks
        self.force_scale = float(ticks.force_scale[-1])
        self.felt_peak_N = max(self.felt_peak_N, strongest(ticks.force, ticks.ceiling))
        self.peak_N = max(self.peak_N, float(np.linalg.norm(ticks.model_force, axis=1).max()))
        deepest = ticks.depth.max(axis=0)
        self.deepest_m = [max(a, float(b)) for a, b in zip(self.deepest_m, deepest, strict=False)]
        self.thumb_peak_N = max(self.thumb_peak_N, float(np.abs(ticks.thumb_felt).max()))
        self.thumb_N = float(ticks.thumb_felt[-1])
        self.injected_m3 = max(self.injected_m3, float(np.fmax.reduce(ticks.injected, initial=0.0)))
        self.limited_by = {name: int(ticks[f"{name}_limited"][-1]) for name in CUTS}
        self.limited_ticks = sum(self.limited_by.values())
        x, y, z = ticks.force[-1]
        self.force_N = (float(x), float(y), float(z))
        self.model_force_N = float(np.linalg.norm(ticks.model_force[-1]))
        last = Limit(int(ticks.limit[-1])).name
        self.limit = LIMIT_WORDS[last] if last in CUTS else ""
        self.depth_m = [float(d) for d in ticks.depth[-1]]
        self.phases = [Phase(int(p)).name for p in ticks.phase[-1] if p != ABSENT]
        self.state = ServoState(int(ticks.state[-1])).name
        self.force_was_on = self.force_was_on or bool((ticks.state == ServoState.active).any())
        self.time_s = float(ticks.time[-1])
        if fault := int(ticks.fault[-1]):
            self.fault = describe(Fault(fault))

    def finish(self, loop: ServoLoop, thumb: ThumbLoop | None = None, duration: float | None = None) -> None:
        """Adds the times and the lost ticks of a loop that has stopped. duration: s, unless a signal ended it."""
        report = loop.report()
        self.lost = max(self.lost, report["ticks"] - self.ticks)  # including ticks after the last read
        self.late = report["late"]
        self.compute_p99_9_s = report["compute"]["p99_9"]
        self.period_p50_s = report["period"]["p50"]
        self.statements = [*statements_of(loop.device, thumb), *run_notes(loop)]
        self.add_trouble(loop.device, thumb)
        if duration is not None and self.start_s is not None:
            ended = bool(getattr(loop.device, "finished", False))
            span, longest = self.time_s - self.start_s, report["period"]["largest"]
            ticked = (duration, self.rate_hz, report["ticks"], span, self.late, longest, ended, self.fault)
            self.too_few_ticks = Ticked(*ticked).why_short()

    def add_trouble(self, device: Device, thumb: ThumbLoop | None = None) -> None:
        """Adds the devices' explanations of a fault, or of trouble outside ticks."""
        self._add(device.trouble())
        if thumb is None:
            return
        if thumb.fault != Fault.none and not self.fault:  # no tick of the needle came any more to latch it
            self.fault = describe(Fault.thumb)
        for trouble in filter(None, (words_of(thumb), thumb.device.trouble())):
            self._add(f"second device: {trouble}")

    def _add(self, trouble: str) -> None:
        if trouble.rstrip(". ") not in self.fault:
            self.fault = f"{self.fault}: {trouble}" if self.fault else trouble

    @property
    def limits_in_words(self) -> str:
        """The limits that cut the force, and for how long: "the long-run limit for 1.2 s"; empty if none did."""
        acted = [(LIMIT_WORDS[name], ticks / self.rate_hz) for name, ticks in self.limited_by.items() if ticks]
        return ", ".join(f"the {words} for {seconds:.3g} s" for words, seconds in acted)
