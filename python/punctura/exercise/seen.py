"""All that the coach's sentences about one attempt rest on: its course, and how still the hand held and paused."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from punctura.events import Event
from punctura.exercise.motion import TICK_S, Gaps
from punctura.exercise.quantities import degrees
from punctura.exercise.result import Metrics, Overshoot, Remark
from punctura.exercise.ticks import GONE_S, JudgedTicks, Moment, Numbers, TargetSpace

MOST_REMARKS = 3  # of each sort that a result keeps; the page and the command show the first
STEADILY = "push slowly but without a pause"

REACTION_S = 0.2  # time in which a hand goes on before it can react to a pop
BEFORE_S = 0.1  # length of the window before a pop, or before the decision, in which speed and force are measured

FIRM_STOP = 0.5  # share of the allowed overshoot: up to here the stop went well
NEAR_STOP = 0.8  # share of the allowed overshoot: from here it was close

ANGLE_GOOD_DEG, ANGLE_OFF_DEG = 2.0, 5.0  # difference to the angle of the start
ASIDE_GOOD_M, ASIDE_OFF_M = 0.5e-3, 1.0e-3  # distance from the line of entry
CROOKED = 1.1  # path length through straight distance

PAUSE_S = 1.0  # a shorter stop is not a pause
PAUSES_S = 2.0  # all pauses together, from which the coach speaks

SHORT_STAY_S = 0.1  # whoever was in the space for less did not leave it
HOLD_S = 1.0  # a shorter stay says nothing about holding still
HOLD_SETTLE_S = 0.3  # the beginning of a stay, in which the needle still arrives
SMOOTH_S = 0.25  # what is slower is drift, what is faster is tremor (8 to 12 Hz in a healthy hand)
TREMOR_GOOD_M, TREMOR_OFF_M = 0.08e-3, 0.15e-3  # rms, of all directions
DRIFT_GOOD_M, DRIFT_OFF_M = 0.5e-3, 1.5e-3
RESTING_N = 0.5  # a thumb with less rests on the plunger
PRESSED_S = 0.5  # time behind the end of the space

SAMPLES_HZ = 100.0  # enough for a tremor of 12 Hz


class Push(NamedTuple):
    """The needle in the BEFORE_S before a moment."""

    time: float  # s
    membrane: int  # that gave way then; -1: none
    force: float  # N, the largest total force of the model
    speed: float  # m/s along the needle; positive goes in


class _Recent(NamedTuple):
    """The last BEFORE_S at the full rate."""

    time: Numbers
    tip: Numbers
    held: Numbers
    force: Numbers


class Samples(NamedTuple):
    """The attempt at SAMPLES_HZ, or at the rate of the device if that is lower."""

    time: Numbers  # s, on the needle's own clock
    tip: Numbers  # (n, 3), m
    stay: Numbers  # s, of the point in the space, or of the whole tip if the exercise asks for it


class Trajectory:
    """Takes the ticks of an attempt up to its decision, in batches of any size, and their events."""

    def __init__(self, space: TargetSpace, rate: float) -> None:
        """rate: of the device, Hz."""
        self._space, self._rate = space, rate
        self._step = max(1, round(rate / SAMPLES_HZ))
        self._recent = _Recent(np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0))
        self._way, self._tissue = Gaps(), Gaps()
        self._arrived = False
        self.way_read = self.tissue_read = True  # no readings were missing before the arrival; anywhere in the tissue
        self._standstills: list[tuple[float, bool]] = []  # that have ended
        self._standstill = (0.0, True)  # at the last tick
        self.left = 0  # how often the needle left the space and came back
        self._stayed, self._out = np.nan, False  # s, at the last tick, NaN outside; it has left since
        self._parts: list[Samples] = []
        self.pushes: list[Push] = []  # one a pop
        self.nearest = -np.inf  # m, the largest distance of the point behind the membrane before the space
        self.nearest_at: float | None = None  # s
        self.tip_nearest = -np.inf  # m, the same of the end of the slanted face
        self.pressed_s = 0.0  # time of the point behind the end of the space
        self.pressed_m = 0.0  # how far it was behind it
        self.pressed_at: float | None = None  # s, when it was farthest

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        if len(ticks) == 0:
            return
        new = _Recent(ticks.time, ticks.tip, ticks.held, ticks.force)
        self._recent = _Recent(*(np.concatenate(pair) for pair in zip(self._recent, new, strict=True)))
        self.pushes += [self._push(event.time, event.membrane) for event in events if event.what == "pop"]
        late = self._recent.time > self._recent.time[-1] - BEFORE_S - TICK_S
        self._recent = _Recent(*(column[late] for column in self._recent))
        rows = ticks.tick % self._step == 0
        kind = int(self._space.stay_whole)
        stay = np.where(ticks.in_space[:, kind], ticks.stay[:, kind], np.nan)
        self._parts.append(Samples(ticks.own[rows], ticks.tip[rows], stay[rows]))
        self._read(ticks)
        self._pause(ticks)
        self._leave(ticks, stay)
        self._depths(ticks)

    def _read(self, ticks: JudgedTicks) -> None:
        inside, seen = ticks.in_tissue, ticks.placed
        arrived = self._arrived | np.logical_or.accumulate(self._space.arrived(ticks))
        self._arrived = bool(arrived[-1])
        self.way_read &= not self._way.add(ticks, seen, inside & ~arrived).any()
        self.tissue_read &= not self._tissue.add(ticks, seen, inside).any()

    def _pause(self, ticks: JudgedTicks) -> None:
        ends = np.flatnonzero(np.concatenate([[self._standstill[0]], ticks.still[:-1]]) * (ticks.still == 0)).tolist()
        for row in ends:
            self._standstills.append(self._standstill if row == 0 else self._standing(ticks, row - 1))
        self._standstill = self._standing(ticks, len(ticks) - 1)

    @staticmethod
    def _standing(ticks: JudgedTicks, row: int) -> tuple[float, bool]:
        return float(ticks.still[row]), not (ticks.silent[row] or ticks.slowed[row])

    @property
    def standstills(self) -> list[tuple[float, bool]]:
        """Each time that the needle stood still on the way: how long, s, and whether it was certainly the student's."""
        return [one for one in (*self._standstills, self._standstill) if one[0] > 0]

    def _leave(self, ticks: JudgedTicks, stay: Numbers) -> None:
        here = np.isfinite(stay)
        before = np.concatenate([[np.isfinite(self._stayed)], here[:-1]])
        for row in np.flatnonzero(before != here).tolist():
            if here[row]:
                self.left, self._out = self.left + self._out, False
            else:
                stayed = self._stayed if row == 0 else float(stay[row - 1])
                self._out |= stayed >= SHORT_STAY_S and bool(ticks.age[row] <= GONE_S)  # the page has not lost it
        self._stayed = float(stay[-1])

    def _push(self, until: float, membrane: int) -> Push:
        time, tip, held, force = self._recent
        rows = (time >= until - BEFORE_S - TICK_S) & (time <= until + TICK_S) & np.isfinite(tip).all(axis=1)
        time, tip, held, force = time[rows], tip[rows], held[rows], force[rows]
        if len(time) < 2:
            return Push(until, membrane, 0.0, 0.0)
        strongest = float(np.fmax.reduce(force))
        speed = float((tip[-1] - tip[0]) @ held[-1] / (time[-1] - time[0]))
        return Push(until, membrane, strongest if np.isfinite(strongest) else 0.0, speed)

    def _depths(self, ticks: JudgedTicks) -> None:
        space = self._space
        held = ticks.inside[:, space.behind]
        past = np.nan_to_num(ticks.past[:, space.behind], nan=-np.inf)
        if past.max() > self.nearest:
            self.nearest, self.nearest_at = float(past.max()), float(ticks.time[past.argmax()])
        self.tip_nearest = float(np.fmax(self.tip_nearest, np.fmax.reduce(ticks.tip_past[:, space.behind])))
        if not held.any():
            return
        beyond = np.full(len(ticks), -np.inf)
        if space.in_front_of is not None:
            beyond = np.fmax(beyond, ticks.below[:, space.in_front_of] - space.press)
        if np.isfinite(space.ends):
            beyond = np.fmax(beyond, ticks.past[:, space.behind] - space.ends)
        beyond = np.where(held, beyond, -np.inf)
        self.pressed_s += float((beyond > 0).sum()) / self._rate
        if beyond.max() > self.pressed_m:
            self.pressed_m, self.pressed_at = float(beyond.max()), float(ticks.time[beyond.argmax()])

    @property
    def last(self) -> Push:
        """The needle before the last tick, that is before the decision."""
        time = self._recent.time
        return self._push(float(time[-1]), -1) if len(time) else Push(0.0, -1, 0.0, 0.0)

    @property
    def samples(self) -> Samples:
        if not self._parts:
            return Samples(np.zeros(0), np.zeros((0, 3)), np.zeros(0))
        whole = Samples(*(np.concatenate(columns) for columns in zip(*self._parts, strict=True)))
        self._parts = [whole]
        return whole


class Hold(NamedTuple):
    seconds: float  # length of the stay
    tremor: float  # m rms, of the motion that is faster than SMOOTH_S, all directions together
    drift: float  # m, the largest distance of the smoothed tip from its place at the beginning


class Pauses(NamedTuple):
    number: int
    seconds: float  # together


def hold_of(samples: Samples, longest: float) -> Hold | None:
    """The longest stay in the space, after the needle has settled; None if it is shorter than HOLD_S. longest: its
    length, s."""
    ends = np.flatnonzero(np.isfinite(samples.stay) & np.isfinite(samples.tip).all(axis=1))
    if longest < HOLD_S or len(ends) == 0:
        return None
    end = int(ends[samples.stay[ends].argmax()])
    since = samples.time - samples.stay  # the same in all of a stay
    rows = (np.abs(since - since[end]) < TICK_S) & np.isfinite(samples.tip).all(axis=1)
    rows &= samples.stay >= HOLD_SETTLE_S
    time, tip = samples.time[rows], samples.tip[rows]
    if len(time) < 3:
        return None
    smooth, rest = _smooth(time, tip)
    away = np.linalg.norm(smooth - smooth[0], axis=1)
    return Hold(longest, float(np.sqrt((rest**2).sum(axis=1).mean())), float(away.max()))


def off_angle(angle: float, seen: Seen) -> Iterator[Remark]:
    """What to change at the next entry, after one at this angle, rad."""
    way = "flatter" if angle > seen.angle else "steeper"
    text = (
        f"You entered at {degrees(angle)}; {degrees(seen.angle)} are asked: hold the needle "
        f"{degrees(abs(angle - seen.angle))} {way}."
    )
    yield Remark(about="angle", text=text, numbers={"angle_rad": angle, "asked_rad": seen.angle}, time=seen.first_touch)


def _smooth(time: Numbers, tip: Numbers) -> tuple[Numbers, Numbers]:
    """The moving mean over SMOOTH_S, and the rest, without the ends where the mean has too few samples."""
    step = float(np.median(np.diff(time)))
    half = max(1, int(SMOOTH_S / step / 2))
    width = 2 * half + 1
    padded = np.pad(tip, ((half, half), (0, 0)), mode="edge")
    sums = np.cumsum(np.concatenate([np.zeros((1, 3)), padded]), axis=0)
    smooth = (sums[width:] - sums[:-width]) / width
    inner = slice(half, len(tip) - half) if len(tip) > width else slice(None)
    return smooth, (tip - smooth)[inner]


@dataclass(frozen=True)
class Seen:
    passed: bool
    decision: Moment | None
    hold_s: float | None  # the longest stay that is asked for
    timed_out: bool  # a limit of time decided the attempt
    space: TargetSpace
    before: str  # name of the membrane before the space
    after: str  # name of the membrane behind it; empty if there is none
    first: str  # name of the first membrane
    angle: float  # that is asked between the needle and the first surface, rad
    metrics: Metrics
    first_touch: float | None  # s
    trajectory: Trajectory

    @cached_property
    def hold(self) -> Hold | None:
        """How still the needle was; None without a goal to stay, or without a stay."""
        longest = self.metrics.longest_stay
        return hold_of(self.trajectory.samples, longest) if self.hold_s is not None else None

    @cached_property
    def pauses(self) -> Pauses:
        """Those that are certainly the student's."""
        lengths = [length for length, own in self.trajectory.standstills if own and length >= PAUSE_S]
        return Pauses(len(lengths), sum(lengths))

    @property
    def steady(self) -> bool:
        """Whether the needle certainly never stood still on the way."""
        standstills = self.trajectory.standstills
        return self.trajectory.way_read and all(own and length < PAUSE_S for length, own in standstills)

    def newtons(self, force: float) -> str:
        """A force of the model; "model force" stands beside it if the hand did not get all of it."""
        cut = self.metrics.force_scale < 1 or any(seconds > 0 for seconds in self.metrics.force_cut.values())
        return f"{force:.2f} N (model force)" if cut else f"{force:.2f} N"

    @property
    def arrival(self) -> float | None:
        """Time of the first arrival, s."""
        waited = self.metrics.time_to_target
        return None if waited is None or self.first_touch is None else self.first_touch + waited

    def stops(self, membrane: int) -> Iterator[tuple[Push, Overshoot]]:
        """Each pop of a membrane: the needle before it, and how far it went on."""
        pushes = {round(one.time, 9): one for one in self.trajectory.pushes if one.membrane == membrane}
        for one in self.metrics.overshoot:
            push = pushes.get(round(one.time, 9))
            if one.membrane == membrane and push is not None:
                yield push, one
