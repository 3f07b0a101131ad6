"""Follows the tip at one membrane."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from punctura._core import Phase
from punctura.events.crossing import Crossing
from punctura.ticks import Columns

Numbers = NDArray[np.float64]

CLEAR = 0.25e-3  # m in front of the surface at which the tip has left: more than a trembling hand moves

_OUTSIDE, _INSIDE, _UNKNOWN = 0, 1, 2
# By phase; every other number is none.
_KINDS = np.full(256, _UNKNOWN, dtype=np.uint8)
_KINDS[Phase.outside.value] = _OUTSIDE
_KINDS[[Phase.sticking.value, Phase.sliding_in.value, Phase.sliding_out.value]] = _INSIDE


class Happening(NamedTuple):
    """An event before it has a time: `row` is the tick's place in the batch."""

    row: int
    what: str
    before: float = 0.0
    after: float = 0.0


class Contact:
    """State from tick to tick. The batches may be cut anywhere.

    touch: the model lets the tip in. pop: the depth passes `through`; it can happen again once the tip has come back to
    `again`, in front of the peak. out: the tip is in front of the surface by CLEAR. Ticks without a number, and those
    of a barred membrane, which gives no force, are passed over.
    """

    def __init__(self) -> None:
        self.open = False  # touched, and not out yet
        self.crossing: Crossing | None = None  # while inside
        self._ready = False  # for a pop
        self._strongest = 0.0

    def follow(
        self,
        phase: NDArray[np.uint8],
        depth: Numbers,
        resistance: Numbers,
        friction: Numbers,
        enter: Callable[[int], Crossing],
    ) -> Iterator[Happening]:
        """A batch. enter: the membrane's depths for the needle's direction in a row."""
        kinds = _KINDS[phase]
        kinds[~np.isfinite(depth)] = _UNKNOWN
        if not self.open and not (kinds == _INSIDE).any():
            return
        for start, end in _runs(kinds):
            kind = int(kinds[start])
            if kind == _INSIDE:
                if self.crossing is None:
                    self.crossing = enter(start)
                    self._ready, self._strongest = True, 0.0
                if not self.open:
                    self.open = True
                    yield Happening(start, "touch")
                yield from self._pops(depth, resistance, friction, start, end)
            elif kind == _OUTSIDE:
                self.crossing = None
                clear = _first(depth[start:end] <= -CLEAR)
                if self.open and clear is not None:
                    self.open = False
                    yield Happening(start + clear, "out")
            elif np.isfinite(depth[start:end]).any():  # barred: reset, say
                self.crossing = None

    def _pops(
        self, depth: Numbers, resistance: Numbers, friction: Numbers, start: int, end: int
    ) -> Iterator[Happening]:
        assert self.crossing is not None
        at = start
        while at < end:
            if not self._ready:
                back = _first(depth[at:end] <= self.crossing.again)
                if back is None:
                    return
                at += back
                self._ready, self._strongest = True, 0.0
            hit = _first(depth[at:end] >= self.crossing.through)
            last = end if hit is None else at + hit + 1
            self._strongest = float(np.fmax(self._strongest, np.fmax.reduce(resistance[at:last])))
            if hit is not None:
                self._ready = False
                after = float(friction[last - 1])
                yield Happening(last - 1, "pop", self._strongest, after if np.isfinite(after) else self.crossing.shaft)
            at = last


def _runs(kinds: NDArray[np.uint8]) -> Iterator[tuple[int, int]]:
    """Stretches of one kind, [start, end)."""
    cuts = np.flatnonzero(np.diff(kinds)) + 1
    edges = [0, *cuts.tolist(), len(kinds)]
    return itertools.pairwise(edges)


def _first(mask: NDArray[np.bool_]) -> int | None:
    at = int(mask.argmax())
    return at if mask[at] else None


def resistance_of(columns: Columns, membrane: int) -> tuple[Numbers, Numbers]:
    """(axial resistance -b.f, insertion friction -Phi_I), N."""
    force = -np.asarray(columns["axial_force"], dtype=np.float64)[:, membrane]
    lower = columns.get("lower")
    friction = force if lower is None else -np.asarray(lower, dtype=np.float64)[:, membrane]
    return force, np.where(np.isfinite(friction), friction, force)
