"""Finds when the plunger of a syringe gives way under the thumb: the loss of resistance that the second hand feels."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from punctura.exercise.space import TargetSpace
from punctura.exercise.thumb_so_far import ThumbSoFar
from punctura.exercise.ticks import JudgedTicks

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
        self._load = self._push = self._injected = self._time = np.nan
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
        seconds = np.diff(ticks.time, prepend=self._time)
        flows = behind & (load >= self._least) & (volume >= FLOW * seconds)
        last = np.maximum.accumulate(np.where(flows, rows, -2))
        before = np.concatenate([[-2], last[:-1]])  # the last flow before this tick
        gave = np.where(entry >= 0, before >= entry, self._gave | (before >= 0))

        self._open, self._gave = bool(behind[-1]), bool(gave[-1] | flows[-1])
        self._load, self._push = float(load[-1]), float(ticks.push[-1])
        self._load_felt = float(load_felt[-1])
        self._push_felt = float(felt[-1])
        self._injected, self._time = float(ticks.injected[-1]), float(ticks.time[-1])
        marked = replace(ticks, load=load, load_felt=load_felt, gave_way=flows & ~gave)
        return self._thumb.mark(marked, entering) if self._thumb else marked
