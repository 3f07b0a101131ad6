"""The summary of a finished simulation."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass
class MembraneSummary:
    """One membrane: largest depth (m) and largest force (N), both along the needle."""

    name: str
    deepest_m: float = 0.0
    peak_N: float = 0.0


@dataclass
class SimulationSummary:
    """The result of a simulation: files, times, the largest forces, and notes for the user."""

    scene: str
    motion: str
    out: str
    samples: int = 0  # of the motion
    ticks: int = 0
    motion_rate_hz: float | None = None  # None for a motion of one sample
    rate_hz: float = 0.0
    resampled: bool = False
    start_s: float = 0.0
    end_s: float = 0.0
    peak_N: float = 0.0
    membranes: list[MembraneSummary] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    elapsed_s: float = 0.0
