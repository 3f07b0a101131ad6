"""Notes a depth that no needle reaches: usually the positions are in millimetres."""

from __future__ import annotations

DEEPEST = 0.5  # m


def depth_note(membrane: str, depth: float) -> str:
    """The note on the largest depth (m) in a membrane; empty if a needle can be that long."""
    if depth <= DEEPEST:
        return ""
    return (
        f"the needle goes {depth:.3g} m deep into {membrane!r}, and no needle is that long. "
        "Positions must be in metres; if they are in millimetres, divide them by 1000"
    )
