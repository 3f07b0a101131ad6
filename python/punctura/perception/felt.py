"""What a person felt of each interval of a trial, from the recording of its ticks."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np

from punctura._core import Fault, Limit, ServoState, describe
from punctura.compare.run import Run
from punctura.events import crossing
from punctura.live.force_words import LIMIT_WORDS
from punctura.perception.protocol import Stimulus
from punctura.perception.stimulus import Felt, felt
from punctura.record import open_recording
from punctura.ticks import COMMAND_SCENE, Ticks

READY_S = 0.25  # from a change of the scene, which fades in over 0.2 s, until the needle may touch


class Spoilt(Exception):
    """An interval was not felt as planned: the text says why. The trial must be repeated."""


def felt_of(recording: Path, intervals: Sequence[Stimulus], membrane: int) -> list[Felt]:
    """Raises Spoilt, RecordingError."""
    ticks = open_recording(recording).ticks()
    changes = np.flatnonzero(ticks.commands & COMMAND_SCENE).tolist()
    ends = [0, *changes, len(ticks)]
    if len(ends) != len(intervals) + 1:
        raise Spoilt(f"its recording has {len(ends) - 1} of {len(intervals)} intervals")
    return [
        _felt(ticks[start:end], one, membrane, READY_S * (start > 0))
        for (start, end), one in zip(pairwise(ends), intervals, strict=True)
    ]


def _felt(ticks: Ticks, stimulus: Stimulus, membrane: int, ready: float) -> Felt:
    run = Run.of_ticks("", stimulus.scene, ticks)
    stroke = slice(run.touch, None)
    limits = {Limit(int(one)).name for one in np.unique(ticks.limit[stroke])} - {"none"}
    if lost := int(ticks["lost"].sum()):
        raise Spoilt(f"{lost} ticks were lost")
    if (faults := ticks.fault[ticks.fault != 0]).size:
        raise Spoilt(describe(Fault(int(faults[0]))))
    if run.depth[0] > 0 or run.time[run.touch] - run.time[0] < ready:
        raise Spoilt("the needle was in the tissue before the interval began")
    if limits - {"ramp"}:
        raise Spoilt(f"the force was cut: {', '.join(LIMIT_WORDS[name] for name in sorted(limits))}")
    if limits or (ticks.state[stroke] != ServoState.active).any():
        raise Spoilt("the force was not on yet: wait a moment in front of the tissue")
    through = crossing(stimulus.scene, membrane, 1.0).through
    if ticks.depth[:, membrane].max() < through:
        raise Spoilt(f"the needle did not go through the {stimulus.scene.membranes[membrane].name}")
    return felt(run, membrane, float(ticks.force_scale[-1]))
