"""What to know before a run: the friction that the device needs, and ticks that a buffer cannot hold."""

from __future__ import annotations

import math

from punctura import Plant
from punctura._core import ServoLoop, needed_damping
from punctura.device_words import room_note


def run_notes(loop: ServoLoop) -> list[str]:
    """The notes on a run, told before it and in its summary."""
    return [note for note in (damping_note(loop), room_note(loop)) if note]


def damping_note(loop: ServoLoop) -> str:
    """The friction that the device needs, because no device states its own; empty for a device that nobody holds."""
    if math.isinf(loop.device.longest_silence[1]):  # nobody holds it
        return ""
    needed, dry = loop.force_scale * needed_damping(loop.scene), Plant().friction
    return (
        f"the friction of {loop.device.info.model or 'the device'} is not known. With less than {needed:.2g} N s/m of "
        f"viscous friction it can buzz in a loose grip (the {dry:g} N of dry friction of an Omni do up to "
        f"{1e3 * dry / needed:.0f} mm/s). If it buzzes, hold it firmly, and lower the coupling's stiffness_N_per_mm or "
        "the force_scale (docs/passivity.md)"
    )
