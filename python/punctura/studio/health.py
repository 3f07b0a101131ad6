"""The loop's health in numbers for the page, and what happened at a fault in words."""

from functools import cache

import numpy as np

from punctura._core import Fault, ThumbLoop
from punctura.device_words import statements_of
from punctura.results import Quantiles
from punctura.studio.hand import Mode
from punctura.studio.run import Run
from punctura.studio.wire.messages import FaultMessage, LimitsPart, RecordingStatus, SecondStatus, Spread, Status

_WORDS: dict[Fault, tuple[str, str]] = {
    Fault.non_finite_input: (
        "The device reported a number that is not finite (position, direction, time or motor temperature), "
        "or a position beyond 1000 km.",
        "Check the device's cable, its calibration and the unit of its positions, m.",
    ),
    Fault.bad_axis: (
        "The device reported a direction of the needle whose length is not 1.",
        'Check the device\'s orientation sensors, or set direction = "motion" in the scene.',
    ),
    Fault.position_jump: (
        "The position of the device changed faster than a hand can move.",
        "Check the device's cable and its calibration.",
    ),
    Fault.stale_sample: (
        "The device sent the same reading for too long.",
        "Check the connection of the device.",
    ),
    Fault.missed_deadline: (
        "A tick came too late: the computer was too slow, or asleep.",
        "Close programs that keep the processor busy, and keep the computer awake.",
    ),
    Fault.clock: (
        "The clock of the device went back.",
        "Its driver must use a clock that never goes back.",
    ),
    Fault.non_finite_force: (
        "The model gave a force or a band that is not a number, or a band that no law can have.",
        "Correct the law if it is your own. Otherwise please report the scene and the saved ticks.",
    ),
    Fault.device: ("The device reported a fault.", "Check the device."),
    Fault.thumb: (
        "The device under the thumb has a fault or sends nothing.",
        "Check the connection of the device under the thumb.",
    ),
}
NO_TICKS = "The device has stopped."
STILL_OFF = "The force is still off. Press the button Turn force on when you are ready."  # at the start of a run


def fault_words(fault: Fault) -> tuple[str, str]:
    """What happened, and what to do, as sentences. Raises KeyError for `none`."""
    return _WORDS[fault]


def status_of(run: Run, lost: int, armed: bool, hand: Mode, compare: bool) -> Status:
    """The state of this run. lost: ticks that the page's reader missed. `viewers` and `dropped` are 0: the hub fills
    them in for each page."""
    report = run.loop.report()
    return Status(
        ticks=report["ticks"],
        late=report["late"],
        lost=max(lost, run.lost),  # the ring also counts ticks lost after the last read
        period=spread(report["period"]),
        compute=spread(report["compute"]),
        viewers=0,
        dropped=0,
        armed=armed,
        hand=hand,
        compare=compare,
        statements=[*statements_of(run.loop.device, run.thumb), *run.notes],
        second=second_of(run.thumb),
    )


def second_of(thumb: ThumbLoop | None) -> SecondStatus | None:
    if thumb is None:
        return None
    limits = thumb.limits
    return SecondStatus(
        ticks=thumb.ticks,
        rate=thumb.device.info.rate,
        max_force=limits.max_force,
        continuous_force=limits.continuous_force,
        continuous_time=limits.continuous_time,
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


def spread(times: Quantiles) -> Spread:
    """Quantiles, and the bins from the first to the last that is not empty."""
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


def no_ticks(words: str) -> FaultMessage:
    """The device's ticks have ceased; words: why."""
    remedy = fault_words(Fault.device)[1]
    return FaultMessage(fault="device", reason=NO_TICKS, remedy=remedy, trouble=words, tick=None, kept=0)
