"""What a simulation says of itself: its summary, and a note on an impossible depth."""

from __future__ import annotations

from dataclasses import dataclass, field

DEEPEST = 0.5  # m


def depth_note(membrane: str, depth: float) -> str:
    """The note on the largest depth (m) in a membrane; empty if a needle can be that long."""
    if depth <= DEEPEST:
        return ""
    return (
        f"the needle goes {depth:.3g} m deep into {membrane!r}, and no needle is that long. "
        "Positions must be in metres; if they are in millimetres, divide them by 1000"
    )


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
