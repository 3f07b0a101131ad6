"""What a simulation says of itself: its summary, and a note on an impossible depth."""

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
    """How deep the needle went behind one membrane (m), and the largest force there (N)."""

    name: str  # of the membrane
    deepest_m: float = 0.0  # along the needle
    peak_N: float = 0.0  # largest force along the needle


@dataclass
class SimulationSummary:
    """The result of a simulation: files, times, the largest forces, and notes for the user."""

    scene: str  # its name
    motion: str  # the file that was read
    out: str  # the file written
    samples: int = 0  # of the motion
    ticks: int = 0  # made
    motion_rate_hz: float | None = None  # None for a motion of one sample
    rate_hz: float = 0.0  # ticks a second
    resampled: bool = False  # the motion had another rate
    start_s: float = 0.0  # of the motion
    end_s: float = 0.0  # of the motion
    peak_N: float = 0.0  # largest force
    membranes: list[MembraneSummary] = field(default_factory=list)  # by the order of the scene
    notes: list[str] = field(default_factory=list)
    elapsed_s: float = 0.0  # that the computation took
