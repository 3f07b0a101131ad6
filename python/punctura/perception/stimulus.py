"""What a hand feels of one stimulus, and the scene for a wanted number of newtons."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from punctura import Scene
from punctura._core import Experiment, ForceLimits, Hand, Strokes, force_scale, largest_force, lasting_force
from punctura.compare.run import Run
from punctura.compare.statistics import FELT_S, statistics
from punctura.errors import ConfigurationError
from punctura.live import stroke_ends

STROKE_S, REST_S = 1.0, 0.3  # of the simulated hand: one way inwards
SMOOTH_S = 0.02  # what changes more slowly than this is no roughness
MOST_MISS = 0.02  # of a wanted number of newtons
BEFORE_POP_S = 0.01  # that the roughness leaves out


@dataclass(frozen=True)
class Felt:
    """The felt force of one interval, from its ticks. SI."""

    drop: float  # N, at the pop of the judged membrane; 0 without a pop
    contrast: float  # that drop as a share of the force before it
    peak: float  # N, the largest of the run
    roughness: float  # N rms about the mean of SMOOTH_S, from the first touch to just before the first pop
    speed: float  # m/s along the needle, mean from the first touch to the deepest place
    scale: float  # how much of the model's force the device gives
    pops: int


QUANTITIES = {"drop_N": "drop", "peak_N": "peak"}  # variables in newtons, and what of Felt they are


def felt(run: Run, membrane: int, scale: float) -> Felt:
    """What a run felt like. membrane: the judged one. scale: the run's force scale."""
    found = statistics(run)
    pops = [pop for pop in found.pops if pop.membrane == membrane]
    largest = max(pops, key=lambda pop: pop.felt_drop or 0.0, default=None)
    drop = 0.0 if largest is None else largest.felt_drop or 0.0
    touch, deepest = run.touch, int(np.nanargmax(run.depth))
    seconds = float(run.time[max(deepest, touch)] - run.time[touch])
    way = float(np.nansum(run.travel[touch + 1 : deepest + 1]))
    return Felt(
        drop=drop,
        contrast=0.0 if largest is None else drop / max(_before(run, run.time[touch] + largest.time), 1e-9),
        peak=found.felt_peak or 0.0,
        roughness=_roughness(run, touch),
        speed=way / seconds if seconds > 0 else 0.0,
        scale=scale,
        pops=len(pops),
    )


def _before(run: Run, time: float) -> float:
    """The largest felt force just before a pop, N."""
    around = (run.time >= time - FELT_S) & (run.time <= time)
    return float(np.nanmax(run.felt[around]))


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
            f"no scene gives {wanted:g} N: {path} from {low:g} to {high:g} gives {least:.3g} N to {most:.3g} N"
        )
    found = float(brentq(excess, low, high, xtol=1e-3 * (high - low)))
    if abs(excess(found)) > MOST_MISS * wanted:  # the felt force jumps with the number, such as where a pop ends
        raise ValueError(f"no scene gives {wanted:g} N: near {path} = {found:.4g} the felt force jumps over it")
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


def built(make: Callable[[], Scene]) -> tuple[Scene | None, str]:
    """The scene, or the reason why there is none."""
    try:
        return make(), ""
    except ConfigurationError as bad:
        return None, "; ".join(problem.reason for problem in bad.problems)
    except ValueError as bad:
        return None, str(bad)
