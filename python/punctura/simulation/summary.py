"""What a simulation reports when it is done."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass
class MembraneSummary:
    """One membrane: how deep the needle went (m, along the needle) and its strongest force along the needle (N)."""

    name: str
    deepest_m: float = 0.0
    strongest_N: float = 0.0


@dataclass
class SimulationSummary:
    """What went in, what came out, and what the reader of the result should know (`notes`)."""

    scene: str
    motion: str
    out: str
    rows_in: int = 0
    rows_out: int = 0
    motion_rate_hz: float | None = None  # None for a motion of one sample
    servo_rate_hz: float = 0.0
    resampled: bool = False
    start_s: float = 0.0
    end_s: float = 0.0
    strongest_N: float = 0.0
    membranes: list[MembraneSummary] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    elapsed_s: float = 0.0

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)
