"""The depth of a force sensor on a robot: from stated speeds, or from a file of its own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from punctura.trace.columns import choose_columns
from punctura.trace.reading import Reading
from punctura.trace.tables import read_table
from punctura.trace.trace import Finding, TraceError

Array = NDArray[np.float64]
Speeds = Sequence[tuple[float, float]]  # from which time on (s since the first sample), how fast (m/s, inwards)


def depth_from(speeds: Speeds, time: Array) -> Array:
    """The depth (n,), m from the first sample, at the times (n,), s."""
    since = time - time[0]
    starts = np.array([start for start, _ in speeds])
    passed = np.maximum(0.0, np.minimum(since[:, None], np.append(starts[1:], np.inf)) - starts)
    depth: Array = passed @ np.array([speed for _, speed in speeds])
    return depth


def about_speed(speeds: Speeds, force: Array) -> Finding:
    """Says that the depth was not measured, and whether the force (n,), N, looks as if the needle had turned."""
    text = "the depth follows from the stated speed; it was not measured"
    level = force - np.median(force[: max(1, len(force) // 50)])
    peak = level[np.argmax(np.abs(level))]
    if len(speeds) == 1 and float(np.mean(level * np.sign(peak) < -0.1 * abs(peak))) > 0.05:
        text += ". The force changes its sign, as if the needle turned: state when it stopped and turned "
        text += "(--speed-mm-per-s 4,0@4,-4@5: 4 mm/s, from 4 s on 0, from 5 s on -4 mm/s)"
    return Finding("depth_from_speed", text)


def with_depth_between(held: dict[str, Array], found: list[Finding]) -> dict[str, Array]:
    """Columns (n,) whose depth and force stand in different rows, as recorders of several sensors write them.

    The depth is interpolated at the times of the force. Other columns stay as they are.
    """
    if not {"depth", "force", "time"} <= held.keys():
        return held
    timed = np.isfinite(held["time"])
    depth, force = (timed & np.isfinite(held[role]) for role in ("depth", "force"))
    if min(depth.sum(), force.sum()) < 5 or 2 * (depth & force).sum() >= min(depth.sum(), force.sum()):
        return held
    order = np.argsort(held["time"][depth], kind="stable")
    times, depths = held["time"][depth][order], held["depth"][depth][order]
    at = held["time"][force]
    within = (at >= times[0]) & (at <= times[-1])
    text = "depth and force stand in different rows; the depth is interpolated at the times of the force"
    found.append(Finding("interpolated", text, True))
    return {"depth": np.interp(at[within], times, depths), "force": held["force"][force][within], "time": at[within]}


def with_depth_of(
    path: Path, held: Mapping[str, Array], reading: Reading, source: str
) -> tuple[dict[str, Array], list[Finding]]:
    """Force and time with the depth of another file, interpolated at the times that both have. Raises TraceError."""
    other = replace(reading, depth_file=None, speeds=())
    named = {role: name for role, name in reading.columns.items() if role != "force"}
    motion, found = choose_columns(read_table(path, other), named, reading.units, str(path), ("depth", "time"))
    good = np.isfinite(motion["depth"]) & np.isfinite(motion["time"])
    order = np.argsort(motion["time"][good], kind="stable")
    time, depth = motion["time"][good][order], motion["depth"][good][order]
    both = (held["time"] >= time[0]) & (held["time"] <= time[-1]) if len(time) else np.zeros(len(held["time"]), bool)
    if both.sum() < 5:
        spans = [f"{each[0]:.6g} to {each[-1]:.6g} s" for each in (held["time"], time) if len(each)]
        raise TraceError(f"{source}: has no time in common with {path}: {' and '.join(spans)}. Use one clock for both")
    if not both.all():
        text = f"{int((~both).sum())} of {len(both)} samples are outside the times of {path}; they are left out"
        found.append(Finding("no_depth", text, True, 10 * int((~both).sum()) > len(both)))
    return {"depth": np.interp(held["time"][both], time, depth), "force": held["force"][both],
            "time": held["time"][both]}, found  # fmt: skip
