"""Draws the pictures of docs/your-trace.md, from traces that the model makes and that are then changed.

    python tools/your_trace_pictures.py [--out docs/images]

Prints what `identify` would say of each fit. Takes some seconds.
"""

import argparse
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

import matplotlib as mpl
import numpy as np
import punctura as pn
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray
from punctura._core import TraceModel
from punctura.identify.doubts import doubts
from punctura.identify.fit import Fit, Misfit, fit
from punctura.identify.intervals import estimates
from punctura.identify.model import Model, extensions
from punctura.identify.moving_tissue import moving_tissue
from punctura.identify.needle_tolerance import doubt_of_needle
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.identify.rig import UNKNOWN
from punctura.rivals.hold_out import REPEAT, second_insertion
from punctura.trace import Trace, segment
from punctura.trace.findings import examine
from punctura.trace.numbers import numbers_of
from validation_pictures import COLOURS, save

Array = NDArray[np.float64]
NEEDLE = pn.Needle(diameter=1.2e-3, tip_angle=0.4)
WALL = {"surface": 5e-3, "stiffness": 600, "precompression": 0.3, "friction": 0.2, "thickness": 0.5e-3}
PLAIN = Model(1)
RATE, NOISE = 100.0, 8e-3  # Hz, N


def truth() -> Parameters:
    row = default_membrane()
    row[:5] = list(WALL.values())
    return Parameters(NEEDLE, np.array([row]), default_coupling(4000.0))


def motion(speeds: tuple[float, ...] = (5e-3,), hold: float = 1.0) -> tuple[Array, Array]:
    """Time (s) and depth (m): to 15 mm and back, once at each speed."""
    ways = [np.arange(0, 15e-3, speed / RATE) for speed in speeds]
    rest = np.full(int(hold * RATE), 15e-3)
    depth = np.concatenate([part for way in ways for part in (way, rest, way[::-1])])
    return np.arange(len(depth)) / RATE, depth


def law(time: Array, depth: Array, more: dict[str, float] | None = None) -> Array:
    """The force of one wall of K06 (n,), N. more: other parameters."""
    p = truth().with_values(more or {})
    return np.asarray(TraceModel(NEEDLE, depth, time).forces(p.membranes, p.coupling, False)[0])


def noisy(time: Array, depth: Array, force: Array) -> Trace:
    return Trace(depth, force + NOISE * np.random.default_rng(1).normal(size=len(depth)), time)


def fitted(trace: Trace, model: Model = PLAIN, needle: pn.Needle = NEEDLE) -> Fit:
    """K06 with one wall, without extensions unless the model has some."""
    start = model.start(replace(truth(), needle=needle))
    return fit(Misfit(trace, start), model.names, start)


def draw_two(axes: Axes, below: Axes, trace: Trace, over: str, fits: dict[str, Fit]) -> None:
    """The trace over depth or time, two fits and what each of them leaves."""
    assert trace.time is not None
    where = 1e3 * trace.depth if over == "depth, mm" else trace.time
    axes.plot(where, trace.force, color=COLOURS["pale"], lw=0.8, label="trace")
    for (label, found), colour in zip(fits.items(), (COLOURS["bad"], COLOURS["good"]), strict=True):
        axes.plot(where, trace.force + found.residuals, color=colour, lw=1.1, label=label)
        below.plot(where, -1e3 * found.residuals, color=colour, lw=0.6)
        print(f"{label}: {1e3 * found.rmse:.1f} mN")
    axes.set(ylabel="force, N")
    axes.legend(fontsize=8, frameon=False)
    below.axhline(0, color="black", lw=0.5)
    below.set(xlabel=over, ylabel="left, mN")


def extended(name: str) -> Model:
    return PLAIN.extended(next(one for one in extensions(NEEDLE) if one.name == name))


def drift(axes: Axes, below: Axes) -> None:
    time, depth = motion()
    trace = noisy(time, depth, law(time, depth) + 0.1 * time / time[-1])
    print(*(finding.text for finding in examine(trace).findings), sep="\n")
    fits = {"K06, one wall": fitted(trace), "with a drift of the sensor": fitted(trace, Model(1, rig=("drift",)))}
    draw_two(axes, below, trace, "time, s", fits)


def relaxation(axes: Axes, below: Axes) -> None:
    """The needle rests within the rise. Behind the pop it slides, and the spring keeps its length."""
    time = np.arange(0, 9.0, 1 / RATE)
    depth = np.interp(time, [0, 1.4, 4.4, 6.0, 9.0], [0, 7e-3, 7e-3, 15e-3, 0])
    trace = noisy(time, depth, law(time, depth, {"relaxation_1_stiffness": 1500.0, "relaxation_1_time": 0.8}))
    print(*(finding.text for finding in examine(trace).findings), sep="\n")
    fits = {"K06, one wall": fitted(trace), "with a relaxation": fitted(trace, extended("relaxation"))}
    draw_two(axes, below, trace, "time, s", fits)


def wrong_needle(axes: Axes, below: Axes) -> None:
    trace, stated = plain(), pn.Needle(1.25 * NEEDLE.diameter, NEEDLE.tip_angle)
    free = fitted(trace, extended("tip length"), stated)
    print(*doubt_of_needle(estimates(free), stated, UNKNOWN), sep="\n")
    fits = {"K06, one wall": fitted(trace, PLAIN, stated), "with a tip length of its own": free}
    draw_two(axes, below, trace, "depth, mm", fits)


def breathing(axes: Axes, below: Axes) -> None:
    """The tissue swings by 0.1 mm, so the needle is that much deeper or less deep in it."""
    time, depth = motion(hold=4.0)
    swung = depth + 1e-4 * np.sin(2 * np.pi * 0.5 * time)
    trace = noisy(time, depth, law(time, swung))
    fits = {"K06, one wall": fitted(trace), "along the depth in the tissue": fitted(replace(trace, depth=swung))}
    still = fits["K06, one wall"]
    print(moving_tissue(trace, still, still, doubts(trace, segment(trace), still, ()).explained))
    draw_two(axes, below, trace, "time, s", fits)


def draw_fit(axes: Axes, below: Axes, make: Callable[[], Trace]) -> None:
    """A trace, its fit and what is left, with the places that are not explained."""
    trace = make()
    found = fitted(trace)
    doubtful = doubts(trace, segment(trace), found, ())
    model = trace.force + found.residuals
    axes.plot(1e3 * trace.depth, trace.force, color=COLOURS["pale"], lw=0.8, label="trace")
    axes.plot(1e3 * trace.depth, model, color=COLOURS["good"], lw=1.1, label="K06, one wall")
    below.plot(1e3 * trace.depth, 1e3 * (trace.force - model), color=COLOURS["bad"], lw=0.6)
    for place in doubtful.explained.places:
        for each in (axes, below):
            each.axvspan(1e3 * place.shallow, 1e3 * place.deep, color="#f3d9a4", lw=0, zorder=0)
    axes.set(ylabel="force, N")
    axes.tick_params(labelbottom=False)
    axes.legend(fontsize=8, frameon=False)
    below.axhline(0, color="black", lw=0.5)
    below.set(xlabel="depth, mm", ylabel="left, mN")
    print(*(doubtful.sentences or ("The trace is explained.",)), sep="\n")


def pulled(ratio: float) -> Trace:
    time, depth = motion()
    force = law(time, depth)
    return noisy(time, depth, np.where(force < 0, ratio * force, force))


def rate() -> Trace:
    time, depth = motion((2e-3, 16e-3), hold=0.0)
    speed = np.abs(np.gradient(depth, time))
    return noisy(time, depth, law(time, depth) * (speed / 5e-3 + 1e-3) ** 0.15)


def ripple() -> Trace:
    time, depth = motion()
    return noisy(time, depth, law(time, depth) * (1 + 0.12 * np.sin(2 * np.pi * depth / 1.5e-3)))


def wall() -> Trace:
    time, depth = motion()
    going_in = np.gradient(depth) >= 0
    return noisy(time, depth, law(time, depth) + 0.15 * going_in * np.clip((depth - 9e-3) / 2e-3, 0, 1))


def crosstalk() -> Trace:
    time, depth = motion()
    return noisy(time, depth, law(time, depth) + 15 * np.clip(depth - WALL["surface"], 0, None))


def smoothed() -> Trace:
    """A moving average over 25 samples."""
    time, depth = motion()
    rough = law(time, depth) + 5 * NOISE * np.random.default_rng(1).normal(size=len(depth))
    trace = Trace(depth, np.convolve(np.pad(rough, 12, "edge"), np.ones(25) / 25, "valid"), time)
    print(*(finding.text for finding in examine(trace).findings), sep="\n")
    return trace


def shaken() -> Trace:
    time, depth = motion()
    measured = depth + 10e-6 * np.random.default_rng(2).normal(size=len(depth))
    return noisy(time, measured, law(time, depth))


def plain() -> Trace:
    time, depth = motion()
    return noisy(time, depth, law(time, depth))


FITS: dict[str, Callable[[], Trace]] = {
    "explained": plain, "barbs": lambda: pulled(2.2), "weak": lambda: pulled(0.5), "rate": rate, "ripple": ripple,
    "wall": wall, "depth-noise": shaken, "crosstalk": crosstalk, "smoothed": smoothed,
}  # fmt: skip


def numbers(axes: Axes) -> None:
    """The numbers of `punctura measure` on a trace."""
    trace = plain()
    (found,) = numbers_of(trace)
    pop = found.pops[0]
    assert found.contact_m is not None and found.gradient_N_per_m is not None and found.withdrawal_N is not None
    depth, force = 1e3 * trace.depth, trace.force - found.zero_N
    end = int(np.argmax(trace.depth))
    inside = slice(int(np.argmax(trace.depth >= found.contact_m)), end)
    axes.fill_between(depth[inside], 0, force[inside], color="#e4ecf5", lw=0)
    axes.plot(depth, force, color=COLOURS["pale"], lw=0.9)
    middle = (0.5 * (1e3 * found.contact_m + 1e3 * found.peak_depth_m), 0.5 * found.peak_N)
    run = np.array([-1.0, 1.0])
    axes.plot(middle[0] + run, middle[1] + run * found.gradient_N_per_m * 1e-3, color=COLOURS["good"], lw=2)
    axes.plot(1e3 * found.peak_depth_m, found.peak_N, "o", color=COLOURS["bad"], ms=4)
    fall = 1e3 * (pop.depth_m + pop.width_m) + 0.25
    axes.annotate("", (fall, pop.peak_N - pop.drop_N), (fall, pop.peak_N), arrowprops={"arrowstyle": "<->", "lw": 0.8})
    for text, place in (
        (f"contact {1e3 * found.contact_m:.2f} mm", (2.4, 0.06)),
        (f"gradient {1e-3 * found.gradient_N_per_m:.2f} N/mm", (2.1, 0.55)),
        (f"peak {found.peak_N:.2f} N at {1e3 * found.peak_depth_m:.2f} mm", (4.2, 0.9)),
        (f"drop {pop.drop_N:.2f} N", (fall + 0.2, 0.62)),
        (f"work {1e3 * found.work_J:.2f} mJ", (10, 0.18)),
        (f"final {found.final_N:.2f} N", (13, 0.48)),
        (f"withdrawal {found.withdrawal_N:.2f} N", (8.8, -0.34)),
    ):
        axes.text(*place, text, fontsize=8)
    axes.axhline(0, color="black", lw=0.5)
    axes.set(xlabel="depth, mm", ylabel="force, N", ylim=(-0.5, 1.0))


def prediction(axes: Axes) -> None:
    """A second insertion that resists less than the first one, and what was predicted for it."""
    time, depth = motion((5e-3, 5e-3), hold=0.2)
    force = law(time, depth)
    later = np.arange(len(depth)) >= len(depth) // 2
    trace = noisy(time, depth, np.where(later, 0.75 * force, force))
    predictions = {one.name: one for one in second_insertion(trace, NEEDLE, 1)}
    second = trace.strokes == 1
    where = 1e3 * trace.depth[second]
    axes.plot(1e3 * trace.depth[~second], trace.force[~second], color="#d8d8d8", lw=0.8, label="first insertion")
    axes.plot(where, trace.force[second], color=COLOURS["pale"], lw=0.8, label="second insertion, not seen by the fit")
    best_rival = min((one for one in predictions.values() if one.name not in ("k06", REPEAT)), key=lambda one: one.rmse)
    for one, colour in ((predictions["k06"], COLOURS["good"]), (best_rival, COLOURS["bad"])):
        label = f"{one.title}: error {1e3 * one.rmse:.0f} mN"
        axes.plot(where, one.force, color=colour, lw=1.1, label=label)
    axes.set(xlabel="depth, mm", ylabel="force, N", ylim=(-0.6, 1.7))
    axes.legend(fontsize=7, frameon=False, loc="upper left")
    for one in predictions.values():
        print(f"{one.title}: {one.rmse:.4f} N, {100 * one.rmse_share:.1f} %")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("docs/images"))
    out = parser.parse_args().out
    mpl.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "punctura", "font.size": 9, "axes.spines.top": False,
                         "axes.spines.right": False})  # fmt: skip
    grid = {"left": 0.1, "right": 0.98, "top": 0.98}
    for name, draw in (("numbers", numbers), ("prediction", prediction)):
        figure = Figure(figsize=(6.8, 2.8))
        draw(figure.subplots(gridspec_kw=grid | {"bottom": 0.17}))
        save(figure, out / f"your-trace-{name}.svg")
    two = {"height_ratios": [2, 1], "bottom": 0.15, "hspace": 0.12}
    drawn = {name: partial(draw_fit, make=make) for name, make in FITS.items()}
    for name, draw_on in (
        drawn | {"drift": drift, "relaxation": relaxation, "needle": wrong_needle, "breathing": breathing}
    ).items():
        figure = Figure(figsize=(6.8, 3.0))
        print(f"\n{name}")
        draw_on(*figure.subplots(2, 1, sharex=True, gridspec_kw=grid | two))
        save(figure, out / f"your-trace-{name}.svg")


if __name__ == "__main__":
    main()
