"""The class Trace: force against depth of one measured insertion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from punctura._core import PuncturaError
from punctura.errors import IncompleteCallError
from punctura.trace.air import without_turns_in_air
from punctura.trace.friction import Slide
from punctura.trace.turns import depth_hysteresis, insertion_numbers

Array = NDArray[np.float64]


class TraceError(PuncturaError, ValueError):
    """A trace cannot be read or used. Names the file, the problem and the remedy."""


class Unstated(TraceError):
    """A trace file does not state what is needed to read it. options: of the command line, which state it."""

    def __init__(self, text: str, options: Sequence[str]) -> None:
        super().__init__(text, tuple(options))
        self.options = tuple(options)

    def __str__(self) -> str:
        return str(self.args[0])


class IncompleteTraceError(TraceError, IncompleteCallError):
    """The command does not state what the file of a trace leaves open."""


@dataclass(frozen=True)
class Finding:
    """Something unusual in a trace. `kind` is one word for programs, `text` says what, where and what to do."""

    kind: str
    text: str
    repaired: bool = False  # the trace in memory no longer has it
    severe: bool = False  # no model should be fitted before this is mended

    def __str__(self) -> str:
        return f"{self.kind.replace('_', ' ')}: {self.text}"


@dataclass(frozen=True, eq=False)
class Trace:
    """Force against depth, n samples in the order of the measurement, SI units.

    depth (n,): m along the needle, growing inwards. force (n,): N, positive where the tissue resists insertion.
    time (n,): s, ascending, or None. Raises TraceError if the arrays do not fit together.
    """

    depth: Array
    force: Array
    time: Array | None = None
    source: str = ""  # its file, for messages
    findings: tuple[Finding, ...] = field(default=(), repr=False)  # what is unusual in it
    depths: Array | None = field(default=None, repr=False)  # (m, n) m, draws of the true depth; None: it is exact
    rig: Array | None = field(default=None, repr=False)  # (n, 5) shapes of the rig's own forces (rig_force.py), if any
    rig_sizes: tuple[float, ...] = field(default=(0.0,) * 5, repr=False)  # SI, of these that are subtracted
    slide: Slide | None = field(default=None, repr=False)  # whose friction a rest keeps, if the air shows it

    def __post_init__(self) -> None:
        for name in ("depth", "force", "time"):
            given = getattr(self, name)
            if given is None and name == "time":
                continue
            column = np.array(given, dtype=np.float64)
            if column.ndim != 1 or len(column) != len(self.depth):
                raise TraceError(f"{self._where()}{name} must hold one number for each of the {len(self.depth)} depths")
            if not np.isfinite(column).all():
                raise TraceError(f"{self._where()}{name} holds NaN or infinite numbers: leave these samples out")
            column.flags.writeable = False
            object.__setattr__(self, name, column)
        if len(self.depth) < 5:
            raise TraceError(f"{self._where()}a trace needs at least 5 samples, and this one has {len(self.depth)}")
        if self.time is not None and (np.diff(self.time) <= 0).any():
            row = int(np.argmax(np.diff(self.time) <= 0)) + 1
            raise TraceError(f"{self._where()}time does not grow at sample {row}: leave out or sort these samples")

    def _where(self) -> str:
        return f"{self.source}: " if self.source else ""

    def __len__(self) -> int:
        return len(self.depth)

    def __getitem__(self, which: slice | NDArray[Any]) -> Trace:
        """A part of the trace, by slice, mask or indices in ascending order."""
        time = None if self.time is None else self.time[which]
        depths = None if self.depths is None else self.depths[:, which]
        rig = None if self.rig is None else self.rig[which]
        slide = None if self.slide is None else self.slide[which]
        depth, force = self.depth[which], self.force[which]
        return replace(self, depth=depth, force=force, time=time, depths=depths, rig=rig, slide=slide)

    def means(self, count: int) -> Trace:
        """The means of each `count` samples in turn. At the beginning, up to count - 1 samples are left out."""
        first = len(self) % count

        def of(column: Array) -> Array:
            return np.asarray(column[first:].reshape(-1, count, *column.shape[1:]).mean(axis=1))

        return replace(
            self,
            depth=of(self.depth),
            force=of(self.force),
            time=None if self.time is None else of(self.time),
            depths=None if self.depths is None else of(self.depths.T).T,
            rig=None if self.rig is None else of(self.rig),
            slide=None if self.slide is None else replace(self.slide, way=of(self.slide.way)),
        )

    @cached_property
    def strokes(self) -> NDArray[np.int64]:
        """The number of the insertion that each sample belongs to (n,): 0 for the first, with its withdrawal."""
        numbers = insertion_numbers(self.depth, depth_hysteresis(self.depth))
        return without_turns_in_air(numbers, self.depth, self.force) if numbers[-1] else numbers

    @cached_property
    def scale(self) -> tuple[float, float]:
        """How large the force is beside 1 N, and the depth beside 10 mm, in powers of 1000: 1 for most insertions."""
        return power_of_1000(self.force, 1.0), power_of_1000(self.depth, USUAL_DEPTH)

    @property
    def speed(self) -> Array | None:
        """Speed of the needle at each sample (n,), m/s, positive inwards; None without time."""
        return None if self.time is None else np.gradient(self.depth, self.time)


USUAL_DEPTH = 1e-2  # m, range of a depth


def power_of_1000(column: Array, usual: float) -> float:
    """The nearest power of 1000 to the range of values over the usual one; 1 where they are all the same."""
    height = float(np.ptp(column))
    return float(1e3 ** np.round(np.log10(height / usual) / 3)) if height > 0 else 1.0
