"""What the user states about a trace file, where the file does not state it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from punctura.trace.columns import REQUIRED
from punctura.trace.decimals import Decimal

Order = Literal["recorded", "depth"]


@dataclass(frozen=True)
class Reading:
    """How to read a trace file. Each field is as in read_trace()."""

    columns: Mapping[str, str | int] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    order: Order = "recorded"
    decimal: Decimal | None = None
    encoding: str | None = None
    sheet: str | None = None
    speeds: tuple[tuple[float, float], ...] = ()
    depth_file: str | None = None

    @property
    def needed(self) -> tuple[str, ...]:
        """The columns that a table must have."""
        return ("force", "time") if self.speeds or self.depth_file else REQUIRED
