"""Measures an attempt. Goals, sentences, tables and plots use the same numbers (docs/exercises.md)."""

import itertools
import math
from collections.abc import Collection, Mapping

import numpy as np

from punctura import Scene
from punctura._core import Limit
from punctura.events import Event
from punctura.exercise.losses import Losses
from punctura.exercise.motion import Path, PathSoFar
from punctura.exercise.result import Loss, Metrics, Overshoot, PlungerLoss, Yield, unfelt
from punctura.exercise.ticks import LATE_S, Geometry, JudgedTicks, Moment, TargetSpace, contacts, own_time
from punctura.exercise.yields import YieldMeasures
from punctura.live.force_words import CUTS, LIMIT_WORDS

OVERSHOOT_S = 0.3  # window after a pop, unless a goal sets it: a hand reacts later than this


class Measures:
    """Takes all ticks up to the decision, and their events."""

    def __init__(
        self,
        scene: Scene,
        geometry: Geometry,
        space: TargetSpace,
        windows: Mapping[int, float] | None = None,
        must: Collection[int] = (),
        after_yield: float = 1.0,
        thumb_must: bool = False,
    ) -> None:
        """windows: by membrane, the time after a pop in which the overshoot is measured, s; default OVERSHOOT_S.

        must: the membranes whose loss of resistance must be felt.
        after_yield: the time after the plunger gives way in which the injected volume is measured, s.
        thumb_must: whether a second device must show the plunger's loss of resistance.
        """
        self._windows = dict(windows or {})
        self._names = [placed.name for placed in scene.membranes]
        self._space = space
        self.entries = 0
        self.peak_force = 0.0
        self.peak_felt_force = 0.0
        self._force_scale = 1.0
        self._losses = Losses(scene, must)
        stiffness = scene.syringe.thumb.stiffness if scene.syringe else 0.0
        self._yields = YieldMeasures(after_yield, thumb_must, stiffness)
        self.first_touch: float | None = None
        self.arrival: float | None = None
        self.longest_stay = 0.0
        self.dwell = 0.0
        self._overshoots: list[Overshoot] = []
        self._own_ends: list[float] = []  # s, of their windows, on the needle's own clock
        self._aside = 0.0  # m, since the last entry
        self._touch_late = self._late_now = 0.0  # s that the computer had lost at the first contact, and by now
        self._path: Path | None = None
        self._way: PathSoFar | None = None  # the path to the space, once it was reached
        self._entry_angle: float | None = None
        self._next_tick: int | None = None
        self._lost = 0
        self._cut = dict.fromkeys(CUTS, 0)  # ticks
        self._late = 0  # ticks without a word of the page, since the first contact
        self._off = 0  # ticks in the tissue without force, since the last entry
        self._rate = scene.servo.rate
        self._last_time = self._seen_to = 0.0

    def add(self, ticks: JudgedTicks, events: list[Event]) -> None:
        if len(ticks) == 0:
            return
        self._count(ticks)
        touches = contacts(events)
        self.entries += len(touches)
        if touches and self.first_touch is None:
            self.first_touch = touches[0].time
            self._touch_late = touches[0].time - own_time(ticks, touches[0])
        self._late_now = float(ticks.time[-1] - ticks.own[-1])
        off = (ticks.ceiling <= 0) & ticks.in_tissue
        aside = np.where(ticks.in_tissue, ticks.aside, 0.0)
        if touches:
            since = ticks.tick >= touches[-1].tick
            self._off, off = 0, off[since]
            self._aside, aside = 0.0, aside[since]
        self._off += int(off.sum())
        self._aside = float(np.maximum(self._aside, aside.max()))
        if self.first_touch is not None:
            self._late += int(((ticks.age > LATE_S) & (ticks.time >= self.first_touch)).sum())
        for name in CUTS:
            self._cut[name] += int((ticks.limit == getattr(Limit, name).value).sum())
        self.peak_force = float(np.fmax(self.peak_force, np.fmax.reduce(ticks.force)))
        self.peak_felt_force = float(np.fmax(self.peak_felt_force, np.fmax.reduce(ticks.felt_size)))
        self._force_scale = float(ticks.force_scale[-1])
        self._losses.add(ticks, events)
        self._yields.begin(ticks)
        for event in events:
            if event.what == "pop":
                one = self._overshoot(event)
                self._overshoots.append(one)
                self._own_ends.append(own_time(ticks, event) + one.seconds)
        self.settle(ticks)
        arrived = self._space.arrived(ticks)
        self._follow(ticks, touches, int(arrived.argmax()) if arrived.any() else None)
        kind = int(self._space.stay_whole)
        self.longest_stay = max(self.longest_stay, float(ticks.stay[:, kind].max()))
        self.dwell = float(ticks.dwell[-1, kind])

    def settle(self, ticks: JudgedTicks) -> None:
        """Measures overshoots and injected volumes to the end of their windows, also after the decision."""
        self._yields.settle(ticks)
        for k, one in enumerate(self._overshoots):
            rows = (ticks.time >= one.time) & (ticks.own <= self._own_ends[k])
            if rows.any():
                farthest = float(ticks.run_on[rows, one.membrane].max())
                self._overshoots[k] = one.model_copy(update={"distance": max(one.distance, farthest)})
        if len(ticks):
            self._seen_to = float(ticks.own[-1])

    @property
    def settled(self) -> bool:
        """Whether all windows have ended."""
        return all(self._seen_to > end for end in (*self._own_ends, *self._yields.ends))

    def _count(self, ticks: JudgedTicks) -> None:
        first, last = int(ticks.tick[0]), int(ticks.tick[-1])
        self._lost += last + 1 - (first if self._next_tick is None else self._next_tick) - len(ticks)
        self._next_tick = last + 1
        self._last_time = float(ticks.time[-1])

    def _overshoot(self, pop: Event) -> Overshoot:
        seconds = self._windows.get(pop.membrane, OVERSHOOT_S)
        return Overshoot(membrane=pop.membrane, name=pop.name, time=pop.time, distance=0.0, seconds=seconds)

    def _follow(self, ticks: JudgedTicks, touches: list[Moment], arrived: int | None) -> None:
        """Follows the path from the last entry to the first arrival in the space."""
        if self._way is not None:
            return
        end = len(ticks) if arrived is None else arrived + 1
        cuts = [int(row) for row in np.searchsorted(ticks.tick, [touch.tick for touch in touches])]
        edges = [0, *[min(cut, end) for cut in cuts], end]
        for k, (start, stop) in enumerate(itertools.pairwise(edges)):
            if k and cuts[k - 1] < end:
                self._enter(ticks, cuts[k - 1])
            if self._path is not None:
                self._path.add(ticks.tip[start:stop])
        if arrived is not None:
            self.arrival = float(ticks.time[arrived])
            if self._path is not None:
                self._way = self._path.at(ticks.tip[arrived])

    def _enter(self, ticks: JudgedTicks, row: int) -> None:
        self._path = Path(ticks.tip[row], ticks.held[row])
        angle = float(ticks.angle[row])
        self._entry_angle = angle if math.isfinite(angle) else None

    @property
    def force_cut(self) -> dict[str, float]:
        """Time in which each limit cut the device's force, s."""
        return {LIMIT_WORDS[name]: ticks / self._rate for name, ticks in self._cut.items() if ticks}

    @property
    def force_off(self) -> float:
        """Time since the last entry in which the force was off in the tissue, s."""
        return self._off / self._rate

    @property
    def page_late(self) -> float:
        """Time since the first contact in which the page that moves the hand was late, s."""
        return self._late / self._rate

    @property
    def computer_late(self) -> float:
        """Time since the first contact that a late computer took from a simulated needle, s."""
        return 0.0 if self.first_touch is None else max(0.0, self._late_now - self._touch_late)

    @property
    def elapsed(self) -> float:
        """Time from the first contact to the last tick before the decision, s."""
        return self._last_time - self.first_touch if self.first_touch is not None else 0.0

    @property
    def yields(self) -> list[Yield]:
        """Each time that the plunger gave way so far."""
        return self._yields.found

    @property
    def losses(self) -> list[Loss]:
        """The losses of resistance so far."""
        return self._losses.found

    def unfelt(self, ended: bool) -> list[Loss | PlungerLoss]:
        """The losses that must be felt and could not be. ended: no more ticks come. Else a loss at the plunger counts
        only when the thumb could have reacted."""
        return unfelt(self.losses, self.yields if ended else self._yields.complete)

    def metrics(self) -> Metrics:
        way = self._way or (self._path.deepest if self._path else None)
        touched = self.first_touch
        return Metrics(
            entries=self.entries,
            peak_force=self.peak_force,
            peak_felt_force=self.peak_felt_force,
            force_scale=self._force_scale,
            losses=self.losses,
            yields=self._yields.found,
            overshoot=self._overshoots,
            dwell=self.dwell,
            longest_stay=self.longest_stay,
            path_length=way.length if way else None,
            net_distance=way.net if way else None,
            straightness=way.length / way.net if way and way.net > 0 else None,
            lateral_deviation=self._aside if way and math.isfinite(self._aside) else None,
            entry_angle=self._entry_angle,
            time_to_target=self.arrival - touched if self.arrival is not None and touched is not None else None,
            total_time=self.elapsed,
            lost_ticks=self._lost,
            force_cut=self.force_cut,
            force_off=self.force_off,
            page_late=self.page_late,
            computer_late=self.computer_late,
        )
