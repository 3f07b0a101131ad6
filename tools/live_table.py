"""Measures the live estimate on synthetic traces: delay, missed punctures, false alarms, and intervals of the slope.

Prints the table of docs/live-estimate.md. Takes about a minute. `--runs` sets the number of membranes for each row.
"""

import argparse
from dataclasses import dataclass, field

import numpy as np
import punctura as pn
from numpy.typing import NDArray
from punctura.live import LiveEstimate
from punctura.scene import ServoSettings
from punctura.simulation import Experiment, Strokes

RATE = 1600.0
PERIOD = 1 / RATE
DOWN = (0.0, -1.0, 0.0)
LEAST_DROP, LEAST_SHARE = 0.06, 0.08  # the detector's own settings

Array = NDArray[np.float64]


@dataclass
class Tally:
    """The counts of one row."""

    punctures: int = 0
    missed: int = 0
    false_alarms: int = 0
    second: int = 0  # alarms after the first one on the way through the wall
    seconds: float = 0.0
    delays: list[float] = field(default_factory=list)  # s, from the greatest force
    waits: list[float] = field(default_factory=list)  # s, from the moment when the force has fallen by the least drop
    inside: int = 0  # slopes whose 95 % interval holds the true mean slope of the last stretch
    slopes: int = 0


def scene_with(rng: np.random.Generator) -> pn.Scene:
    """A random membrane with its surface at y = 0."""
    needle = pn.Needle(rng.uniform(0.5e-3, 1.8e-3), rng.uniform(0.18, 0.5))
    membrane = pn.Membrane(
        stiffness=10 ** rng.uniform(2.0, 3.3),
        precompression=rng.uniform(0.02, 0.5),
        friction=rng.uniform(0.05, 0.5),
        thickness=10 ** rng.uniform(-4.0, -2.7),
    )
    placed = pn.PlacedMembrane("wall", membrane, (0, 0, 0), DOWN)
    servo = ServoSettings(rate=RATE, conditioning="line_fit")
    return pn.Scene("one", needle, pn.Coupling(400.0, 1.0), [placed], servo)


def robot(scene: pn.Scene, rng: np.random.Generator, speed: float) -> tuple[Array, Array]:
    """In at a steady speed, a hold of 1 s, out again: depth and force against the insertion."""
    reach = pn.ThickLaw(scene.needle, scene.membranes[0].membrane).X + scene.membranes[0].membrane.thickness + 4e-3
    inwards = np.arange(-3e-3, reach, speed * PERIOD)
    depth = np.concatenate([inwards, np.full(int(RATE), inwards[-1]), inwards[::-1]])
    force = pn.Insertion(scene).run(np.outer(depth, DOWN), DOWN).force
    return depth, -force @ np.array(DOWN)


def hand(scene: pn.Scene, rng: np.random.Generator, speed: float) -> tuple[Array, Array]:
    """Two strokes of a simulated hand with tremor at a simulated Omni."""
    reach = pn.ThickLaw(scene.needle, scene.membranes[0].membrane).X + scene.membranes[0].membrane.thickness + 4e-3
    strokes = Strokes((0, 3e-3, 0), (0, -reach, 0), 2, (reach + 3e-3) / speed, 0.6, 0.1)
    seed = int(rng.integers(1 << 30))
    ticks = Experiment(scene, strokes, seed=seed).run(strokes.duration_for(seed))
    return -ticks.tip[:, 1], ticks.model_force[:, 1]


def falls(force: Array, depth: Array, noise: float, share: float = 1.0) -> list[tuple[int, int, int]]:
    """True punctures of a force without noise: (greatest, fallen by the least drop, end) of each fall going inwards."""
    found, top = [], 0
    moving = np.gradient(np.convolve(np.pad(depth, 32, "edge"), np.full(65, 1 / 65), "valid")) > 1e-7  # no tremor
    k = 0
    while k < len(force):
        if not moving[k] or force[k] >= force[top]:
            top = k
        elif (
            force[top] - force[k] >= share * max(LEAST_DROP, LEAST_SHARE * force[top], 8 * noise) and force[top] > 0.03
        ):
            end = k
            while end + 1 < len(force) and moving[end + 1] and force[end + 1] <= force[end]:
                end += 1
            found.append((top, k, end))
            k = top = end
        k += 1
    return found


def measure(tally: Tally, depth: Array, force: Array, noise: float, rng: np.random.Generator) -> None:
    live = LiveEstimate(noise=noise)
    estimates = live.run(depth, force + noise * rng.standard_normal(len(force)), PERIOD)
    alarms = np.flatnonzero(estimates["punctured"]).tolist()
    entries = np.cumsum(np.diff(depth < 0, prepend=True))  # there is one wall, so one puncture between two of them
    tally.second += len(alarms) - len(set(entries[alarms]))
    for top, fallen, end in falls(force, depth, noise):
        tally.punctures += 1
        mine = [a for a in alarms if top <= a <= end + int(0.05 * RATE)]
        if not mine:
            tally.missed += 1
            continue
        tally.delays.append((mine[0] - top) * PERIOD)
        tally.waits.append((mine[0] - fallen) * PERIOD)
        alarms.remove(mine[0])
        count_slope(tally, estimates, depth, force, top)
    for top, _, end in falls(force, depth, noise, 0.4):  # a smaller fall than the least drop, but a fall
        alarms = [a for a in alarms if not top <= a <= end + int(0.05 * RATE)]
    tally.false_alarms += len(alarms)
    tally.seconds += len(force) * PERIOD


RISE = 1  # the phase in which a membrane resists


def count_slope(tally: Tally, estimates: dict[str, Array], depth: Array, force: Array, top: int) -> None:
    """At 60 % of the way to the greatest force: is the true slope, weighted as the estimate weighs, in its interval?"""
    contact = int(np.argmax(force > 0.03))
    at = contact + int(0.6 * (top - contact))
    if not np.isfinite(estimates["slope_error"][at]):
        return
    start = at - int(np.argmax(estimates["phase"][at::-1] != RISE)) + 1  # where the estimate begins its line
    rows = slice(start, at + 1)
    weight = np.sqrt(np.exp((depth[rows] - depth[at]) / 1e-3))
    shape = np.column_stack([np.ones(at + 1 - start), depth[rows]])
    true = np.linalg.lstsq(shape * weight[:, None], force[rows] * weight, rcond=None)[0][1]
    tally.slopes += 1
    tally.inside += bool(abs(estimates["slope"][at] - true) <= 1.96 * estimates["slope_error"][at])


def row(name: str, make: object, speed: float, noise: float, runs: int) -> str:
    rng, tally = np.random.default_rng(20), Tally()
    for _ in range(runs):
        depth, force = make(scene_with(rng), rng, speed)  # type: ignore[operator]
        measure(tally, depth, force, noise, rng)
    delay, wait = np.array(tally.delays) * 1e3, np.array(tally.waits) * 1e3
    cells = [
        f"{name}, {speed * 1e3:g} mm/s", f"{noise * 1e3:g}", str(tally.punctures), str(tally.missed),
        f"{tally.false_alarms} in {tally.seconds / 60:.0f} min", str(tally.second),
        f"{np.median(wait):.1f}, {np.quantile(wait, 0.95):.1f}",
        f"{np.median(delay):.0f}, {np.quantile(delay, 0.95):.0f}", f"{100 * tally.inside / max(tally.slopes, 1):.0f} %",
    ]  # fmt: skip
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=100)
    runs = parser.parse_args().runs
    heads = ("motion", "noise mN", "punctures", "missed", "false alarms", "second alarms")
    print(
        "| "
        + " | ".join((*heads, "after the least drop, ms: median, 95 %", "after the peak, ms", "slope in its 95 %"))
        + " |"
    )
    print("|---|---|---|---|---|---|---|---|---|")
    for noise in (4e-3, 15e-3):
        for speed in (2e-3, 5e-3, 20e-3):
            print(row("robot", robot, speed, noise, runs), flush=True)
        print(row("hand", hand, 10e-3, noise, max(1, runs // 2)), flush=True)


if __name__ == "__main__":
    main()
