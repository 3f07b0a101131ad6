"""What happened at a fault, and what to do, in the words of the page."""

from __future__ import annotations

from punctura._core import Fault

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
        "The model gave a force that is not a number.",
        "This is a defect: please report it, with the scene and the saved ticks.",
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
