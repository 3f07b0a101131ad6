"""Measures how often the intervals of `punctura identify` hold the truth.

    python tools/try_intervals.py [--traces 1000] [--noise 0.01] [--correlation 0] [--drift 0] [--walk 0]
        [--rate 200] [--machine] [--early] [--inward] [--depth-noise 0] [--depth-step 0] [--force-step 0] [--growing 0]
        [--tremor 0] [--lag 0] [--delay 0] [--play 0] [--slide 0] [--presliding 0] [--cable 0] [--examined] [--air]
        [--depth-rate 0] [--bursts 0] [--bessel 0]
        [--tolerance 0] [--wrong 0] [--walls 1] [--apart 0.5] [--auto] [--workers 1] [--seed 1]

Each trace is a random membrane behind a random spring, felt by a simulated hand at a simulated device (plant and
tremor), with noise of the force sensor. --correlation: of the noise from sample to sample (AR(1)). --drift: the
standard deviation of a second, slow noise, N, whose correlation falls by a factor of e in one second. --rate: of the
samples, Hz; at 40 Hz the needle goes some 0.2 mm from sample to sample. --early: the trace ends half way to the pop,
so that it cannot tell some parameters. --machine: the needle moves at one speed, not by a hand at a device,
whose encoder has counts. --inward: the trace ends at its greatest depth. --walk: the standard deviation,
N, that a random walk of the sensor reaches in 10 s. --depth-noise: m. --depth-step, --force-step: the sensors give
multiples of these, m and N. --growing: noise beside --noise, as a share of the force. --lag, --delay: of the force
sensor, s. --play: of the drive of --machine, m. --tremor: of 8 to 10 Hz, on the way of --machine, m.
--slide: friction of the rig's slide, N, that a rest keeps, and that rises over --presliding, m, where it turns.
--cable: N/m. --depth-rate: Hz, of readings of the depth that are held between. --bursts: noise more in a fifth of the
samples, in stretches of 0.2 s, N. --bessel: the limit of a filter of the second order in the force, Hz. With one of the
last five, or --examined, the trace is examined as one from a file is, and "rig" says how often
the forces of the rig that it is said to have are those that it has.
--tolerance: the true diameter of the needle is within this share of
the stated one, in 95 of 100 traces, and identify is told so. --wrong: the stated diameter is off by this share, up or
down, and "warned" says how often the result doubts the needle.
"still": how often the result does not say that the tissue moves; "explained": how often the result is called so;
"frank": how often it is not called explained with a wrong number of walls; "law": how often there is a result at all.
--walls: with 2, the second surface
lies --apart tip lengths behind the first one, and the number of walls is not given to identify; "walls" says how often
it is right. --air: the needle touches nothing, and there should be no law. --auto: the number is not given for
one wall, too.

An interval of 95 % should hold the truth in 93 to 97 % of the cases. "hidden": even an ideal interval is too wide to
tell the parameter. First, the Fisher information at the truth says that it spans a factor of 100 or more. Second, the
likelihood of the trace without noise does not exclude a value ten times as large, or ten times as small, whatever the
other parameters are: the Fisher information at one point misses what a short rest between two samples tells. Both know
the correlation of the noise, but not the drift. A hidden parameter must be called not identifiable. The second test is
made only where a parameter is called identifiable. It takes about 0.3 s of a processor a trace.
"""

import argparse
import multiprocessing
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, fields
from functools import partial

import numpy as np
import punctura as pn
from numpy.typing import NDArray
from punctura.identify import Parameters, Rig, identify
from punctura.identify.fit import Fit, Misfit, fit
from punctura.identify.noise import Mixture
from punctura.identify.parameters import default_coupling, default_membrane
from punctura.identify.plan import information
from punctura.identify.start import other_grips
from punctura.scene import ServoSettings
from punctura.simulation import Experiment, Strokes
from punctura.trace import Trace, TraceError
from punctura.trace.findings import examine
from scipy.signal import bessel, lfilter
from scipy.stats import binomtest

DEVICE_HZ = 1600
FAR = 10.0  # times the true value, and the true value over it
CHI2_95 = 3.84  # 95 % of chi-squared with one degree of freedom
AIR = 2e-3  # m, in front of the first surface
THINNER = 4.0  # of several walls, so that they overlap in the tip and not in themselves
WALK = 10.0  # s, after which --walk is reached
SLOW = 1.0  # s, of the drift: its correlation falls by a factor of e
WHOLE = ("law", "rig", "still", "explained", "frank", "walls", "warned")  # rows that are of the whole result
HIDDEN = np.log(100) / (2 * 1.96)  # standard error of a logarithm

OTHERS = {
    "--walk": "N in 10 s", "--depth-noise": "m", "--depth-step": "m", "--force-step": "N", "--lag": "s", "--delay": "s",
    "--play": "m", "--tremor": "m", "--slide": "N", "--presliding": "m", "--cable": "N/m",
    "--depth-rate": "Hz", "--bursts": "N", "--bessel": "Hz", "--growing": "of the force",
    "--tolerance": "of the diameter", "--wrong": "of the diameter",
}  # fmt: skip


@dataclass(frozen=True)
class Conditions:
    """How a trace is recorded, and of what. SI units; the options of the command line say what they mean."""

    noise: float = 0.01
    correlation: float = 0.0
    drift: float = 0.0
    rate: int = 200
    machine: bool = False
    early: bool = False
    inward: bool = False
    walk: float = 0.0
    depth_noise: float = 0.0
    depth_step: float = 0.0
    force_step: float = 0.0
    growing: float = 0.0
    lag: float = 0.0
    delay: float = 0.0
    play: float = 0.0
    tremor: float = 0.0
    slide: float = 0.0
    presliding: float = 0.0
    cable: float = 0.0
    depth_rate: float = 0.0
    bursts: float = 0.0
    bessel: float = 0.0
    examined: bool = False
    air: bool = False
    tolerance: float = 0.0
    wrong: float = 0.0
    walls: int = 1
    apart: float = 0.5
    auto: bool = False


@dataclass(frozen=True)
class Row:
    """One parameter of one trace, or what the result says of all."""

    kind: str
    identifiable: bool  # says identify
    held: bool  # the interval holds the truth
    hidden: bool  # no method could tell it


def correlated(rng: np.random.Generator, count: int, correlation: float) -> NDArray[np.float64]:
    """AR(1) noise of variance 1."""
    white = rng.normal(size=count)
    for i in range(1, count):
        white[i] = correlation * white[i - 1] + np.sqrt(1 - correlation**2) * white[i]
    return white


def random_trace(seed: int, given: Conditions) -> tuple[Trace, pn.Needle, dict[str, float]]:
    """A trace, the needle, and the true values."""
    rng = np.random.default_rng(seed)
    needle = pn.Needle(rng.uniform(0.6e-3, 1.6e-3), rng.uniform(0.25, 0.6))
    tip = needle.diameter / np.tan(needle.tip_angle)
    walls: list[pn.PlacedMembrane] = []
    truth: dict[str, float] = {}
    thinner = 1.0 if given.walls == 1 else THINNER
    for i in range(given.walls):
        values = {
            "stiffness": rng.uniform(200, 900), "precompression": rng.uniform(0.05, 0.4),
            "friction": rng.uniform(0.1, 0.4), "thickness": rng.uniform(0.1, 0.5) * tip / thinner,
        }  # fmt: skip
        depth = i * given.apart * tip
        walls.append(pn.PlacedMembrane(f"wall {i}", pn.Membrane(*values.values()), (0, -depth, 0), (0, -1, 0)))
        truth |= {f"membrane[{i}].{kind}": value for kind, value in values.items()}
        truth[f"membrane[{i}].surface"] = AIR + depth
    truth["coupling_stiffness"] = rng.uniform(1500, 6000)
    deepest = max(1.6 * tip + wall.membrane.thickness - wall.point[1] for wall in walls) + 1e-3
    every = slice(None, None, DEVICE_HZ // given.rate)
    if given.machine:
        time, depth = machine_motion(AIR + deepest)
        shake = np.sin(2 * np.pi * (8 + 0.4 * (seed % 6)) * time + seed)
        depth = depth + given.tremor * shake * np.clip(depth / AIR, 0, 1)
        true = Parameters(needle, np.array([default_membrane()] * given.walls), default_coupling(0.0))
        force = Misfit(Trace(depth, depth, time), true).forces(true.with_values(truth | {"play": given.play}))
    else:
        scene = pn.Scene(
            "random", needle, pn.Coupling(truth["coupling_stiffness"], 0.01), walls, servo=ServoSettings(low_pass=0)
        )
        strokes = Strokes((0, AIR, 0), (0, -deepest, 0), count=1, duration=2.0, rest=0.4, variation=0)
        ticks = Experiment(scene, strokes, seed=seed).run(strokes.duration_for(seed))
        time, depth, force = ticks.time, AIR - np.asarray(ticks.position[:, 1]), np.asarray(ticks.force[:, 1])
    force = force * (not given.air) + given.slide * slid(depth, given.presliding) + given.cable * (depth - depth[0])
    force, time, depth = through_sensor(force, given)[every], time[every], depth[every]
    if given.inward:
        force, time, depth = (column[: int(np.argmax(depth)) + 1] for column in (force, time, depth))
    count = len(time)
    size = np.hypot(given.noise, given.growing * force)
    force = force + size * correlated(rng, count, given.correlation)
    if given.drift:
        force += given.drift * correlated(rng, count, float(np.exp(-1 / (SLOW * given.rate))))
    force += given.walk / np.sqrt(WALK * given.rate) * np.cumsum(rng.normal(size=count))
    depth = depth + given.depth_noise * rng.normal(size=count)
    if given.bursts:
        force += np.where((5 * time).astype(int) % 5 == 0, given.bursts, 0.0) * rng.normal(size=count)
    if given.bessel:
        parts = bessel(2, given.bessel, fs=given.rate, norm="mag")
        force = force[0] + lfilter(*parts, force - force[0])
    if given.depth_rate:
        each = round(given.rate / given.depth_rate)
        depth = np.repeat(depth[::each], each)[:count]
    return Trace(stepped(depth, given.depth_step), stepped(force, given.force_step), time), needle, truth


def machine_motion(deepest: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Time, s, and depth, m: in 2 s to the greatest depth at one speed, a rest of 0.4 s, and out."""
    time = np.arange(0, 5.0, 1 / DEVICE_HZ)
    return time, np.interp(time, [0.2, 2.2, 2.6, 4.6], [0, deepest, deepest, 0])


def slid(depth: NDArray[np.float64], over: float) -> NDArray[np.float64]:
    """Friction of 1 N of a slide (n,), which a rest keeps; it rises over so many m where the slide turns."""
    found = np.zeros(len(depth))
    for i, step in enumerate(np.diff(depth), 1):
        left = np.exp(-abs(step) / over) if over else float(step == 0)
        found[i] = np.sign(step) * (1 - left) + left * found[i - 1]
    return found


def through_sensor(force: NDArray[np.float64], given: Conditions) -> NDArray[np.float64]:
    """The force of every tick (n,), N, as a sensor that lags and a delay give it."""
    if given.lag:
        gain = -float(np.expm1(-1 / (given.lag * DEVICE_HZ)))
        force = lfilter([gain], [1, gain - 1], force)
    ticks = round(given.delay * DEVICE_HZ)
    return np.concatenate((np.full(ticks, force[0]), force[: len(force) - ticks]))


def stepped(values: NDArray[np.float64], step: float) -> NDArray[np.float64]:
    """The values as a sensor gives them that knows only multiples of `step`."""
    return np.round(values / step) * step if step else values


def until_half(trace: Trace, truth: dict[str, float], needle: pn.Needle) -> Trace:
    """The trace up to half of the way from contact to the pop."""
    way = needle.diameter / np.tan(needle.tip_angle)
    return trace[: max(int(np.argmax(trace.depth > truth["membrane[0].surface"] + 0.5 * way)), 20)]


def explained(true: Parameters, name: str, value: float, names: Sequence[str], trace: Trace, given: Conditions) -> bool:
    """Whether other values of the rest explain the trace without its noise with this value: 95 % of chi-squared."""
    quiet = Trace(trace.depth, Misfit(trace, true).forces(true), trace.time)
    misfit, rest = Misfit(quiet, true), [one for one in names if one != name]
    for start in (true, *other_grips(true)):
        try:
            end = fit(misfit, rest, start.with_values({name: value}))
        except TraceError:
            continue
        if _chi_squared(end, given) < CHI2_95:
            return True
    return False


def _chi_squared(end: Fit, given: Conditions) -> float:
    """What remains where the parameters follow the noise's covariance, by the linear model at the fit's end."""
    length = -1 / np.log(given.correlation) if given.correlation else 1.0
    columns = np.column_stack((end.jacobian, end.residuals))
    solved, _ = Mixture(1.0 if given.correlation else 0.0, length).solved(columns)
    gram = columns.T @ solved
    taken = np.linalg.lstsq(gram[:-1, :-1], gram[:-1, -1], rcond=1e-10)[0]
    return float(gram[-1, -1] - gram[:-1, -1] @ taken) / given.noise**2


def tried(seed: int, given: Conditions) -> list[Row]:
    """One row for each parameter of one trace."""
    trace, needle, truth = random_trace(seed, given)
    if given.early:
        trace = until_half(trace, truth, needle)
    of_rig = {"slide_friction": given.slide, "cable_stiffness": given.cable}
    of_rig = {name: size for name, size in of_rig.items() if size}
    examined = given.examined or bool(of_rig or given.depth_rate or given.bursts or given.bessel)
    trace = examine(trace) if examined else trace
    drawn = np.random.default_rng(10**6 + seed).normal()
    share = given.tolerance * drawn / 1.96 + given.wrong * np.sign(drawn)
    stated = pn.Needle(needle.diameter * (1 + share), needle.tip_angle)
    known = Rig(diameter_tolerance=given.tolerance * needle.diameter)
    chosen = given.auto or given.walls > 1
    try:
        found = identify(trace, stated, membranes="auto" if chosen else 1, rig=known)
    except TraceError:  # no contact that noise does not explain
        return [Row("law", True, False, False), Row("frank", True, True, False)]
    true = Parameters(needle, np.array([default_membrane()] * given.walls), default_coupling(0.0)).with_values(truth)
    names = [*truth, "offset"]
    assert trace.time is not None
    inflated = given.noise * np.sqrt((1 + given.correlation) / (1 - given.correlation))
    _, errors = information(true, names, trace.time, trace.depth, inflated)
    right = len(found.parameters.membranes) == given.walls
    rows = [
        Row("law", True, True, False),
        Row("frank", True, right or not found.doubts.whole, False),
        Row("still", True, "moving_tissue" not in [cause.kind for cause in found.doubts.causes], False),
        Row("explained", True, found.doubts.whole, False),
    ]
    if examined:
        kinds = {one.kind for one in trace.findings}
        told = {name for name in ("slide_friction", "cable_stiffness", "air_steps") if name in kinds}
        rows.append(Row("rig", True, told == of_rig.keys(), False))
    if chosen:
        rows.append(Row("walls", True, right, False))
    if given.wrong:
        rows.append(Row("warned", True, any("stated needle" in verdict for verdict in found.verdicts), False))
    for estimate in found.estimates:
        kind, value = estimate.name.rpartition(".")[2], (truth | of_rig).get(estimate.name)
        if value is not None:
            low = -np.inf if estimate.low is None else estimate.low
            high = np.inf if estimate.high is None else estimate.high
            error = errors.get(estimate.name, 0.0) / (value if kind == "precompression" else 1)
            hidden = kind != "surface" and bool(error > HIDDEN)
            if hidden and estimate.identifiable:
                most = 0.97 / np.tan(needle.tip_angle) if kind == "friction" else np.inf  # K06 (7)
                ends = (min(FAR * value, most), value / FAR)
                hidden = any(explained(true, estimate.name, end, names, trace, given) for end in ends)
            rows.append(Row(kind, estimate.identifiable, bool(low <= value <= high), hidden))
    return rows


def summary(rows: Sequence[Row]) -> list[str]:
    """A line for each parameter, and one for all; with the share's interval of 95 % (Clopper and Pearson)."""
    lines = []
    for kind in [*dict.fromkeys(row.kind for row in rows), "all"]:
        of = [row for row in rows if row.kind == kind or (kind == "all" and row.kind not in WHOLE)]
        shown = [row for row in of if row.identifiable]
        held, missed = sum(row.held for row in shown), sum(row.hidden for row in shown)
        low, high = binomtest(held, len(shown)).proportion_ci(method="exact") if shown else (0, 1)
        share = f"{100 * held / len(shown):5.1f} % [{100 * low:.1f}, {100 * high:.1f}]" if shown else "-"
        lines.append(
            f"{kind:20} {share} of {len(shown):5} intervals hold the truth; not identifiable: {len(of) - len(shown)}; "
            f"hidden: {sum(row.hidden for row in of)}, of these called identifiable: {missed}"
        )
    return lines


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--traces", type=int, default=1000)
    parser.add_argument("--noise", type=float, default=0.01, help="N")
    parser.add_argument("--correlation", type=float, default=0.0)
    parser.add_argument("--drift", type=float, default=0.0, help="N")
    parser.add_argument("--rate", type=int, default=200, help="Hz, a divisor of 1600")
    parser.add_argument("--early", action="store_true", help="end half way to the pop")
    parser.add_argument("--machine", action="store_true", help="moved at one speed")
    parser.add_argument("--inward", action="store_true", help="end at the greatest depth")
    parser.add_argument("--examined", action="store_true", help="as one from a file is")
    parser.add_argument("--air", action="store_true", help="the needle touches nothing")
    parser.add_argument("--walls", type=int, default=1)
    parser.add_argument("--auto", action="store_true", help="the number of walls is not given")
    parser.add_argument("--apart", type=float, default=0.5, help="tip lengths")
    for option, unit in OTHERS.items():
        parser.add_argument(option, type=float, default=0.0, help=unit)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    seeds = range(given.seed, given.seed + given.traces)
    with ProcessPoolExecutor(given.workers, multiprocessing.get_context("spawn")) as pool:
        conditions = Conditions(**{one.name: getattr(given, one.name) for one in fields(Conditions)})
        one = partial(tried, given=conditions)
        rows = [row for found in pool.map(one, seeds, chunksize=4) for row in found]
    print(*summary(rows), sep="\n")


if __name__ == "__main__":
    main()
