"""When a syringe's plunger gives way under the thumb, and what follows: the loss of resistance of the second hand."""

import itertools
from dataclasses import replace

import numpy as np

from punctura.exercise.losses import needed_drop
from punctura.exercise.result import PlungerLoss, Yield
from punctura.exercise.ticks import Flags, JudgedTicks, Numbers, TargetSpace

ROUNDING_N = 0.01  # a device gives a force with an error of about this
DELAY_S = 5e-3  # a second device gives the force of an earlier tick; illustrative, for 400 Hz and more


class ThumbSoFar:
    """Takes all ticks of an attempt with a second device, in batches of any size."""

    def __init__(self, rate: float) -> None:
        """rate: of the ticks, Hz."""
        self._wanted = np.full(max(1, round(DELAY_S * rate)), np.inf)  # N, of the last ticks
        self._farthest, self._cut_to = np.nan, np.inf

    def mark(self, ticks: JudgedTicks, entering: Flags) -> JudgedTicks:
        """Returns the ticks with `farthest` and `cut_to` filled in. entering: the point comes out behind."""
        starts = np.flatnonzero(entering).tolist()
        farthest = _since(starts, ticks.thumb, self._farthest, np.fmax)
        cut_to = _since(starts, np.where(self._cut(ticks), ticks.push_felt, np.inf), self._cut_to, np.fmin)
        self._farthest, self._cut_to = float(farthest[-1]), float(cut_to[-1])
        return replace(ticks, farthest=farthest, cut_to=cut_to)

    def _cut(self, ticks: JudgedTicks) -> Flags:
        """Whether the device gives less than it was asked for in any of the last ticks: a limit cuts the force."""
        wanted = np.concatenate([self._wanted, ticks.force_scale * ticks.push])
        self._wanted = wanted[len(wanted) - len(self._wanted) :]
        least = np.lib.stride_tricks.sliding_window_view(wanted, len(self._wanted) + 1).min(axis=1)
        with np.errstate(invalid="ignore"):
            cut: Flags = ticks.push_felt < least - np.maximum(0.01 * np.abs(least), ROUNDING_N)
        return cut


def _since(starts: list[int], values: Numbers, before: float, best: np.ufunc) -> Numbers:
    """The best value since the last start, in each tick. before: of the ticks before these."""
    edges = [0, *starts, len(values)]
    parts = [best.accumulate(values[a:b]) for a, b in itertools.pairwise(edges)]
    parts[0] = best(parts[0], before)
    return np.concatenate(parts)


# Illustrative. 10 kPa press 0.005 mL/s into a ligament of the ready epidural, and some mL/s into its space.
FLOW = 0.1e-6  # m^3/s, from which the plunger gives way


class Yields:
    """Takes all ticks of an attempt, in batches of any size.

    The plunger gives way at the first tick with a flow of at least FLOW while the point is behind the membrane in front
    of the space. It counts only if the thumb pushed in the last tick before the point came there: a thumb that begins
    to push in the space feels no loss of resistance. Each time the point comes out behind the membrane counts anew.
    """

    def __init__(self, space: TargetSpace, push: float, rate: float, second_device: bool = False) -> None:
        """push: N, from which the thumb pushes. rate: of the ticks, Hz. second_device: whether the thumb is on one."""
        self._behind, self._least = space.behind, push
        self._open = self._gave = False  # at the last tick; since the point came out behind the membrane
        self._load = self._push = self._injected = self._own = np.nan
        self._load_felt = self._push_felt = np.nan
        self._thumb = ThumbSoFar(rate) if second_device else None

    def mark(self, ticks: JudgedTicks) -> JudgedTicks:
        """Returns the ticks with `load`, `load_felt`, `gave_way`, `farthest` and `cut_to` filled in."""
        rows = np.arange(len(ticks))
        behind = ticks.inside[:, self._behind] & ticks.point_behind[:, self._behind]
        entering = behind & ~np.concatenate([[self._open], behind[:-1]])
        entry = np.maximum.accumulate(np.where(entering, rows, -1))
        pushes = np.concatenate([[self._push], ticks.push[:-1]])
        load = np.where(behind, np.where(entry >= 0, pushes[entry], self._load), np.nan)
        felt = ticks.push_felt if self._thumb else np.full(len(ticks), np.nan)
        feels = np.concatenate([[self._push_felt], felt[:-1]])
        load_felt = np.where(behind, np.where(entry >= 0, feels[entry], self._load_felt), np.nan)

        volume = np.diff(ticks.injected, prepend=self._injected)
        seconds = np.diff(ticks.own, prepend=self._own)
        flows = behind & (load >= self._least) & (volume >= FLOW * seconds)
        last = np.maximum.accumulate(np.where(flows, rows, -2))
        before = np.concatenate([[-2], last[:-1]])  # the last flow before this tick
        gave = np.where(entry >= 0, before >= entry, self._gave | (before >= 0))

        self._open, self._gave = bool(behind[-1]), bool(gave[-1] | flows[-1])
        self._load, self._push = float(load[-1]), float(ticks.push[-1])
        self._load_felt = float(load_felt[-1])
        self._push_felt = float(felt[-1])
        self._injected, self._own = float(ticks.injected[-1]), float(ticks.own[-1])
        marked = replace(ticks, load=load, load_felt=load_felt, gave_way=flows & ~gave)
        return self._thumb.mark(marked, entering) if self._thumb else marked


THUMB_REACTION_S = 0.3  # a thumb reacts within it; illustrative


class YieldMeasures:
    """Takes all ticks of an attempt, with `gave_way` filled in."""

    def __init__(self, seconds: float, must: bool, stiffness: float = 0.0) -> None:
        """seconds: in which the injected volume is measured. must: whether the thumb must feel the loss of resistance.
        stiffness: of the coupling between thumb and plunger, N/m."""
        self._seconds, self._must, self._stiffness = seconds, must, stiffness
        self._volumes: list[float] = []  # m^3, that had left the syringe when it gave way
        self._farthest: list[float] = []  # m, how far in the thumb has been since the point came out
        self._least: list[float] = []  # N, of the felt force since it gave way, whatever the thumb did
        self._own: list[float] = []  # s, when it gave way, on the needle's own clock
        self._seen_to = -np.inf
        self.found: list[Yield] = []

    def begin(self, ticks: JudgedTicks) -> None:
        for row in np.flatnonzero(ticks.gave_way).tolist():
            self._volumes.append(float(ticks.injected[row]))
            self._farthest.append(float(ticks.farthest[row]))
            self._least.append(np.inf)
            self._own.append(float(ticks.own[row]))
            time, push = float(ticks.time[row]), float(ticks.load[row])
            loss = self._loss(ticks, row)
            self.found.append(Yield(time=time, push=push, loss=loss, injected=0.0, seconds=self._seconds))

    def _loss(self, ticks: JudgedTicks, row: int) -> PlungerLoss | None:
        before, model = float(ticks.load_felt[row]), float(ticks.load[row])
        if not np.isfinite(before):
            return None
        scale, needed = float(ticks.force_scale[row]), self._needed(before)
        return PlungerLoss(
            before=before, after=before, model_before=model, model_after=model, force_scale=scale, needed=needed
        )

    def _needed(self, before: float) -> float | None:
        return needed_drop(before) if self._must else None

    def settle(self, ticks: JudgedTicks) -> None:
        for k, one in enumerate(self.found):
            rows = (ticks.time >= one.time) & np.isfinite(ticks.injected)
            since = ticks.own - self._own[k]
            soon = rows & (since <= THUMB_REACTION_S) & np.isfinite(ticks.push) & np.isfinite(ticks.push_felt)
            self.found[k] = one = self._injected(k, one, ticks, rows & (since <= one.seconds))
            if one.loss is not None and soon.any():
                self.found[k] = one.model_copy(update={"loss": self._followed(k, one.loss, ticks, soon)})
        if len(ticks):
            self._seen_to = float(ticks.own[-1])

    def _injected(self, k: int, one: Yield, ticks: JudgedTicks, rows: Flags) -> Yield:
        if not rows.any():
            return one
        injected = float(ticks.injected[rows].max()) - self._volumes[k]
        late = ticks.push[rows & (ticks.own >= self._own[k] + THUMB_REACTION_S)]
        pushes = [*late[np.isfinite(late)].tolist(), *([] if one.push_after is None else [one.push_after])]
        update = {"injected": max(one.injected, injected), "push_after": max(pushes, default=None)}
        return one.model_copy(update=update)

    def _followed(self, k: int, loss: PlungerLoss, ticks: JudgedTicks, soon: Flags) -> PlungerLoss:
        """The loss with the least forces so far, for a thumb that had not been drawn back.

        A thumb that is drawn back feels less force, whether or not the plunger gives way: so each force counts as at
        least that of the coupling to a thumb at its farthest place so far. A limit that has cut the force is no loss of
        resistance: then the force before counts only as far.
        """
        push, felt = ticks.push[soon], ticks.push_felt[soon]
        farthest = np.fmax.accumulate(np.fmax(ticks.farthest[soon], self._farthest[k]))
        held = np.fmax(push, self._stiffness * (farthest - ticks.plunger[soon]))
        self._farthest[k], self._least[k] = float(farthest[-1]), min(self._least[k], float(felt.min()))
        kept = felt + loss.force_scale * (held - push)
        row = int(kept.argmin())
        before, after = loss.before, loss.after
        if kept[row] < after:
            before, after = max(0.0, min(before, float(ticks.cut_to[soon][row]))), float(kept[row])
        needed = self._needed(before)
        drawn_back = before - after < needed_drop(before) <= before - self._least[k]
        update = {"model_after": min(loss.model_after, float(held.min())), "drawn_back": drawn_back}
        return loss.model_copy(update={"before": before, "after": after, "needed": needed, **update})

    @property
    def ends(self) -> list[float]:
        """The time at which each measurement ends, on the needle's own clock, s."""
        return [
            own + max(one.seconds, THUMB_REACTION_S if one.loss else 0.0)
            for own, one in zip(self._own, self.found, strict=True)
        ]

    @property
    def complete(self) -> list[Yield]:
        """Those after which a thumb could have reacted."""
        return [one for own, one in zip(self._own, self.found, strict=True) if self._seen_to >= own + THUMB_REACTION_S]
