"""How long the ticks of a run may wait for a late reader, and a note where that is not long."""

from __future__ import annotations

from punctura._core import ServoLoop

SHORT_S = 1.0  # a reader that is late by less must not lose a tick


def room_note(loop: ServoLoop) -> str:
    """What a user should know of a run whose ticks fill the memory of a listener in less than a second; else empty."""
    rate, count = loop.device.info.rate, len(loop.scene.membranes)
    seconds = loop.room / rate
    if seconds >= SHORT_S:
        return ""
    return (
        f"{count} membrane{'s' if count != 1 else ''} at {rate:g} Hz are a lot of data: memory is kept for "
        f"{seconds:.2g} s of ticks. Ticks that cannot be taken in time are missing in recordings and views, and are "
        "counted; the force is not touched. Fewer membranes or a lower rate lose none"
    )
