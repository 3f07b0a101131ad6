"""How long a study will take and how much disk: shown after its first chunk."""

from __future__ import annotations

import shutil
from dataclasses import dataclass

from punctura.study.folder import Folder

WORTH_S = 60.0  # a shorter study needs no forecast


@dataclass(frozen=True)
class Forecast:
    """What is left of a study. seconds: None where a cluster computes; bytes: of disk, for the chunks and the table."""

    trials: int
    seconds: float | None
    bytes: int
    free: int  # bytes of the disk

    @property
    def is_worth_showing(self) -> bool:
        """Whether it takes long, or the disk may be too small."""
        return (self.seconds or 0.0) > WORTH_S or self.bytes > 0.9 * self.free

    def __str__(self) -> str:
        lasts = "" if self.seconds is None else f" about {_span(self.seconds)} and"
        text = f"{self.trials} trials are left: they need{lasts} {_size(self.bytes)} of disk"
        if self.bytes <= 0.9 * self.free:
            return text
        return f"{text}, and {_size(self.free)} are free: name fewer results in the plan, or give --out on another disk"


def forecast(folder: Folder, first: int, seconds: float | None, chunks_left: int, chunks: int, trials: int) -> Forecast:
    """From chunk `first`, which took `seconds`. chunks_left: without it; chunks: all; trials: that are left."""
    size = folder.chunk(first).stat().st_size
    lasts = None if seconds is None else seconds * chunks_left
    return Forecast(trials, lasts, size * (chunks_left + chunks), shutil.disk_usage(folder.path).free)


def _span(seconds: float) -> str:
    for unit, name in ((86400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 1.5 * unit:
            return f"{seconds / unit:.2g} {name}"
    return f"{seconds:.0f} s"


def _size(count: int) -> str:
    return f"{count / 1e9:.2g} GB" if count >= 1e8 else f"{count / 1e6:.2g} MB"
