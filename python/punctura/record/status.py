"""How a recording is doing."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class RecorderStatus:
    """A moment's account. `trouble` is what is wrong now, in words; empty if nothing is."""

    file: Path | None  # where the recording is now; None if it was moved, and the system does not tell where to
    finished: bool = False
    rows: int = 0  # ticks on the disk
    last_tick: int = -1  # the last of them
    bytes: int = 0
    lost: int = 0  # ticks that will never be in the file
    lost_in_ring: int = 0  # of these: the reader of the ring came too late
    lost_in_backlog: int = 0  # of these: could not be written, because the disk was too slow, full or gone
    lost_otherwise: int = 0  # of these: a defect, no memory, or a file that others have changed; known at the end
    unwritten: dict[str, int] = field(default_factory=dict)  # lost_in_backlog by its causes, in words
    waiting_bytes: int = 0
    slowest_write_s: float = 0.0
    trouble: str = ""
    notes: list[str] = field(default_factory=list)

    @property
    def words(self) -> str:
        """What a user must know at once: trouble, or what is lost; empty if nothing."""
        return self.trouble or (f"{self.lost} ticks are lost" if self.lost else "")

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self) | {"file": str(self.file) if self.file else None}
