"""What to tell about a run's devices: what they say themselves, and ticks that their listeners' buffers cannot hold."""

from punctura._core import Device, Fault, ServoLoop, ThumbLoop, describe

SHORT_S = 1.0  # a reader with a shorter delay must lose no tick


def room_note(loop: ServoLoop) -> str:
    """A warning if a run fills a listener's ring in less than SHORT_S; else empty."""
    rate, count = loop.device.info.rate, len(loop.scene.membranes)
    seconds = loop.room / rate
    if seconds >= SHORT_S:
        return ""
    return (
        f"{count} membrane{'s' if count != 1 else ''} at {rate:g} Hz produce a lot of data: the buffer holds "
        f"{seconds:.2g} s of ticks. Ticks that are not read in time are counted as lost in recordings and views; the "
        "force is not affected. Use fewer membranes or a lower rate to lose none"
    )


def statements_of(device: Device, thumb: ThumbLoop | None) -> list[str]:
    """What the devices say after a run."""
    second = [] if thumb is None else [f"second device: {text}" for text in thumb.device.statements()]
    return [*device.statements(), *second]


def words_of(thumb: ThumbLoop) -> str:
    """The latched fault of the second device; empty without one."""
    return "" if thumb.fault == Fault.none else describe(thumb.fault)
