"""What to know before a run: the friction that the device needs, and ticks that a buffer cannot hold."""

import math

from punctura._core import Plant, ServoLoop, needed_damping
from punctura.device_words import room_note


def run_notes(loop: ServoLoop) -> list[str]:
    """What the user of a run should know, a sentence each: shown before the run, and kept in its summary."""
    return [note for note in (rival_note(loop), damping_note(loop), room_note(loop)) if note]


def rival_note(loop: ServoLoop) -> str:
    """A sentence that names the rivals whose force the run has; empty for the scene's own law."""
    if not loop.rivals:
        return ""
    names = " and ".join(dict.fromkeys(rival.name for rival in loop.rivals))
    note = f"the force is that of {names} (docs/rivals.md), not of the scene's law"
    if math.isinf(loop.device.longest_silence[1]):  # nobody holds it
        return note
    return (
        f"{note}. How much friction a device needs for it is not known: it can buzz or kick, also at rest in tissue. "
        "Begin with --max-force-N 0.5"
    )


def damping_note(loop: ServoLoop) -> str:
    """A sentence with the viscous friction, N s/m, below which the device can buzz: no device states its own.

    Empty for a device that nobody holds, and for rivals: the number follows from the coupling, which they lack.
    """
    if loop.rivals or math.isinf(loop.device.longest_silence[1]):
        return ""
    needed, dry = loop.force_scale * needed_damping(loop.scene), Plant().friction
    return (
        f"the friction of {loop.device.info.model or 'the device'} is not known. With less than {needed:.2g} N s/m of "
        f"viscous friction it can buzz in a loose grip. Dry friction helps, too: {dry:g} N, as an Omni has, are enough "
        f"up to {1e3 * dry / needed:.0f} mm/s. If it buzzes, hold it firmly, and lower the coupling's "
        "stiffness_N_per_mm or the force_scale (docs/passivity.md)"
    )
