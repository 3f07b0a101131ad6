"""The status of a recording."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True)
class RecorderStatus:
    """The status at one moment. `trouble` describes the present problem; empty if none."""

    file: Path | None  # present path of the recording; None if it was moved and the system does not report where
    finished: bool = False
    rows: int = 0  # ticks on the disk
    last_tick: int = -1  # number of the last tick on the disk
    bytes: int = 0
    lost: int = 0  # ticks that will never be in the file
    lost_in_ring: int = 0  # of `lost`: the ring was full
    lost_in_backlog: int = 0  # of `lost`: not written, because the disk was too slow, full or gone
    lost_otherwise: int = 0  # of `lost`: a defect, no memory, or a file changed by others; set at the end
    unwritten: dict[str, int] = field(default_factory=dict)  # lost_in_backlog by cause
    waiting_bytes: int = 0
    slowest_write_s: float = 0.0
    trouble: str = ""
    notes: list[str] = field(default_factory=list)

    @property
    def words(self) -> str:
        """The message for the user: the trouble or the number of lost ticks; empty if neither."""
        return self.trouble or (f"{self.lost} ticks are lost" if self.lost else "")
