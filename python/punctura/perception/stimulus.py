"""What a hand feels of one stimulus, simulated or recorded, and the scene for a wanted number of newtons."""

import math
import re
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import BaseModel, Field
from scipy.optimize import brentq

from punctura import Scene
from punctura._core import (
    Experiment,
    Fault,
    ForceLimits,
    Hand,
    Limit,
    ServoState,
    Strokes,
    describe,
    force_scale,
    largest_force,
    lasting_force,
)  # fmt: skip
from punctura.compare.run import Run
from punctura.compare.statistics import FELT_S, Finite, statistics
from punctura.events import crossing
from punctura.live import stroke_ends
from punctura.live.force_words import CUTS, LIMIT_WORDS
from punctura.record import open_recording
from punctura.ticks import COMMAND_SCENE, Ticks

STROKE_S, REST_S = 1.0, 0.3  # of the simulated hand: one way inwards
SMOOTH_S = 0.02  # what changes more slowly than this is no roughness
MOST_MISS = 0.02  # of a wanted number of newtons
BEFORE_POP_S = 0.01  # that the roughness leaves out
READY_S = 0.25  # from a change of the scene, which fades in over 0.2 s, until the needle may touch
Newtons = Annotated[Finite, Field(ge=-1000, le=1000)]  # no device gives as much to a hand


class Felt(BaseModel, frozen=True, extra="forbid"):
    """The felt force of one interval, from its ticks. SI."""

    drop: Newtons  # N, at the pop of the judged membrane; 0 without a pop
    contrast: Finite  # that drop as a share of the force before it
    peak: Newtons  # N, the largest of the run
    roughness: Newtons  # N rms about the mean of SMOOTH_S, from the first touch to just before the first pop
    speed: Finite  # m/s along the needle, mean from the first touch to the deepest place
    scale: Finite  # how much of the model's force the device gives
    pops: int


QUANTITIES = {"drop_N": "drop", "peak_N": "peak"}  # variables in newtons, and what of Felt they are


def felt(run: Run, membrane: int, scale: float) -> Felt:
    """What a run felt like. membrane: the judged one. scale: the run's force scale."""
    found = statistics(run)
    pops = [pop for pop in found.pops if pop.membrane == membrane]
    touch, deepest = run.touch, int(np.nanargmax(run.depth))
    drop = contrast = 0.0
    if pops:
        drop, time = max((pop.felt_drop or 0.0, run.time[touch] + pop.time) for pop in pops)
        before = run.felt[(run.time >= time - FELT_S) & (run.time <= time)]
        contrast = drop / max(float(np.nanmax(before)), 1e-9)
    seconds = float(run.time[max(deepest, touch)] - run.time[touch])
    way = float(np.nansum(run.travel[touch + 1 : deepest + 1]))
    return Felt(
        drop=drop,
        contrast=contrast,
        peak=found.felt_peak or 0.0,
        roughness=_roughness(run, touch),
        speed=way / seconds if seconds > 0 else 0.0,
        scale=scale,
        pops=len(pops),
    )


def _roughness(run: Run, touch: int) -> float:
    first = next((event.time for event in run.events if event.what == "pop"), math.inf)
    end = int(np.searchsorted(run.time, first - BEFORE_POP_S))
    force = run.felt[touch:end]
    step = float(np.median(np.diff(run.time)))
    width = 2 * round(SMOOTH_S / step / 2) + 1
    if len(force) < 2 * width or not np.isfinite(force).all():
        return 0.0
    mean = np.convolve(force, np.ones(width) / width, "valid")
    return float(np.sqrt(np.mean((force[width // 2 : len(force) - width // 2] - mean) ** 2)))


def simulated(scene: Scene, membrane: int, seed: int | None = None) -> Felt:
    """One stroke inwards of a simulated hand, on the simulated device. seed: of its randomness; None: without any."""
    start, end = stroke_ends(scene)
    steady = seed is None
    motion = Strokes(start, end, count=1, duration=STROKE_S, rest=REST_S, variation=0.0 if steady else 0.05)
    trial = Experiment(scene, motion, hand=Hand(tremor_rms=0.0) if steady else Hand(), seed=seed or 0)
    ticks = trial.run(REST_S + STROKE_S + REST_S / 2)
    return felt(Run.of_ticks("", scene, ticks), membrane, force_scale(scene, ForceLimits()))


class Spoilt(Exception):
    """An interval was not felt as planned, and the trial must be repeated. The text tells the experimenter why."""

    def __init__(self, word: str, why: str) -> None:
        """word: the key of what the participant reads, in WordsTable."""
        super().__init__(why)
        self.word = word


def faulted(fault: Fault) -> Spoilt:
    """Of a run that the fault has ended."""
    return Spoilt("fault", re.sub(",? then reset.*", "", describe(fault)))  # "Go on" does it


def felt_of(recording: Path, intervals: Sequence[Scene], membrane: int) -> list[Felt]:
    """What a person felt of each interval of a trial. Raises Spoilt, RecordingError."""
    ticks = open_recording(recording).ticks()
    changes = np.flatnonzero(ticks.commands & COMMAND_SCENE).tolist()
    ends = [0, *changes, len(ticks)]
    if len(ends) != len(intervals) + 1:
        raise Spoilt("failed", f"the recording has {len(ends) - 1} of {len(intervals)} intervals")
    return [
        _felt(ticks[start:end], one, membrane, READY_S * (start > 0))
        for (start, end), one in zip(pairwise(ends), intervals, strict=True)
    ]


def _felt(ticks: Ticks, scene: Scene, membrane: int, ready: float) -> Felt:
    run = Run.of_ticks("", scene, ticks)
    stroke = slice(run.touch, None)
    limits = {Limit(int(one)).name for one in np.unique(ticks.limit[stroke])} - {"none"}
    if lost := int(ticks["lost"].sum()):
        raise Spoilt("failed", f"the computer was too busy ({lost} ticks were lost): close other programs")
    if (faults := ticks.fault[ticks.fault != 0]).size:
        raise faulted(Fault(int(faults[0])))
    if run.depth[0] > 0 or run.time[run.touch] - run.time[0] < ready:
        raise Spoilt("early", "the needle was in the tissue before the interval began")
    if cuts := limits & {*CUTS}:
        why = " and ".join(LIMIT_WORDS[name] for name in sorted(cuts))
        raise Spoilt("cut", f"the {why} cut the force: let the motors cool, or plan a study with less force")
    if limits or ticks.state[run.touch] != ServoState.active:
        raise Spoilt("weak", "the needle touched the tissue before the force was on")
    if ((ticks.state != ServoState.active) & (run.depth > 0))[stroke].any():
        raise Spoilt("off", "the force went off while the needle was in the tissue: hold the device's button")
    through = crossing(scene, membrane, 1.0).through
    if ticks.depth[:, membrane].max() < through:
        raise Spoilt("short", "the needle did not go through the tissue")
    return felt(run, membrane, float(ticks.force_scale[-1]))


def solved(scene: Scene, quantity: str, wanted: float, path: str, between: tuple[float, float], membrane: int) -> Scene:
    """The scene whose number `path` gives the wanted drop or peak, N, to a hand without tremor.

    It is the felt force of a simulated stroke and not the law's: coupling, filter and the hand's own jump change the
    drop. Raises ValueError if no number in `between` gives it.
    """
    feature = QUANTITIES[quantity]

    def excess(value: float) -> float:
        return float(getattr(simulated(scene.with_values({path: value}), membrane), feature)) - wanted

    low, high = between
    ends = excess(low), excess(high)
    if ends[0] * ends[1] > 0:
        least, most = sorted(end + wanted for end in ends)
        raise ValueError(
            f"no scene gives {wanted:g} N: {path} from {low:g} to {high:g} gives {least:.3g} N to {most:.3g} N; choose "
            "a level that lies there, or other numbers for between"
        )
    found = float(brentq(excess, low, high, xtol=1e-3 * (high - low)))
    if abs(excess(found)) > MOST_MISS * wanted:  # the felt force jumps with the number, such as where a pop ends
        raise ValueError(
            f"no scene gives {wanted:g} N: near {path} = {found:.4g} the felt force jumps over it; leave it out"
        )
    return scene.with_values({path: found})


def cut_by_limits(scene: Scene, limits: ForceLimits) -> str:
    """Why a device with these limits cannot show a stimulus; empty if it can. docs/felt-force.md"""
    needed, lasting = force_scale(scene, limits) * largest_force(scene), lasting_force(limits)
    if needed <= lasting:
        return ""
    scale = math.floor(90 * force_scale(scene, limits) * lasting / needed) / 100
    return (
        f"needs {needed:.2f} N, and this device gives {lasting:.2f} N for any time: give [values] "
        f'"display.force_scale" = {scale:g} or less, leave the level out, or use a stronger device'
    )
