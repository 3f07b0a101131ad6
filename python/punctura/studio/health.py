"""The loop's health in numbers for the page."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from punctura.studio.wire.messages import LimitsPart, RecordingStatus, Spread, Status

if TYPE_CHECKING:
    from punctura.studio.run import Run
    from punctura.studio.session import Session


def status_of(session: Session) -> Status:
    """How the present run is doing; `viewers` and `dropped` are each page's own, and filled in for it."""
    report = session.run.loop.report()
    return Status(
        ticks=report["ticks"],
        late=report["late"],
        lost=max(session.pump.lost, session.run.lost),  # the ring knows of those after the last that was read
        period=spread(report["period"]),
        compute=spread(report["compute"]),
        viewers=0,
        dropped=0,
        armed=session.armed,
        hand=session.hand.mode,
        compare=session.compare,
        statements=session.run.loop.device.statements(),
    )


def limits_of(run: Run) -> LimitsPart:
    """The limits of the present run; the same in all of this studio's, whose device and settings stay."""
    force, gate = run.loop.limits, run.loop.gate
    return LimitsPart(
        max_force=force.max_force,
        continuous_force=force.continuous_force,
        continuous_time=force.continuous_time,
        ramp_time=force.ramp_time,
        warm_motor=force.warm_motor,
        max_speed=gate.max_speed,
        stale=gate.stale,
        deadline=gate.deadline,
        axis_tolerance=gate.axis_tolerance,
        dead_man_buttons=[bit + 1 for bit in range(32) if gate.dead_man >> bit & 1],
    )


def spread(times: dict[str, Any]) -> Spread:
    """Quantiles, and the bins between the first and the last that hold anything."""
    counts = np.asarray(times["counts"])
    filled = np.flatnonzero(counts)
    first, end = (int(filled[0]), int(filled[-1]) + 1) if len(filled) else (0, 0)
    return Spread(
        p50=times["p50"],
        p99=times["p99"],
        p99_9=times["p99_9"],
        largest=times["largest"],
        edges=[edge(i) for i in range(first, end + 1)],
        counts=[int(c) for c in counts[first:end]],
    )


@cache
def edge(bin: int) -> float:
    """The shortest time in a bin, s: one bin for each ns below 8, then eight to an octave (loop/histogram.hpp)."""
    return (bin if bin < 8 else (8 + (bin - 8) % 8) << ((bin - 8) // 8)) * 1e-9


def recording_status(name: str, run: Run) -> RecordingStatus:
    """How the recording of a run is doing."""
    assert run.recorder is not None
    status = run.recorder.status()
    return RecordingStatus(
        name=name,
        rows=status.rows,
        lost=status.lost,
        seconds=(status.last_tick + 1) / run.rate,
        trouble=status.trouble,
    )


def no_recording() -> RecordingStatus:
    return RecordingStatus(name="", rows=0, lost=0, seconds=0.0, trouble="")
