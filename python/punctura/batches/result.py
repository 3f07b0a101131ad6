"""The results of a batch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from punctura._core import Experiment, Fault, Hand, Plant, RecordedMotion, Scene, SimulatedDevice, Strokes
from punctura.extras import optional

if TYPE_CHECKING:
    import pyarrow as pa

Array = npt.NDArray[np.float64]
Motion = Strokes | RecordedMotion | Array
_OF_RUN = ("peak", "felt_peak", "depth", "work", "dwell", "limited")
_OF_MEMBRANE = ("pops", "first_pop", "drop", "overshoot")


def result_names(membranes: int) -> list[str]:
    """The columns of results in `BatchResult.to_arrow`."""
    return [*_OF_RUN, *(f"{name}[{j}]" for name in _OF_MEMBRANE for j in range(membranes)), "fault"]


@dataclass(frozen=True, eq=False, repr=False)
class BatchResult:
    """The numbers of n runs through m membranes, SI. NaN where there is none, such as the drop without a pop.

    They are those of `punctura.compare.statistics`: model_force against the hand, work from the first touch to the
    deepest place of the first insertion, overshoot in the 0.3 s after a pop.
    """

    peak: Array  # (n,), largest force of the model against the hand, N
    felt_peak: Array  # (n,), largest force of the device, N; NaN for positions
    depth: Array  # (n,), deepest place of the tip below the first surface, m
    work: Array  # (n,), of the hand against the model's force, J
    dwell: Array  # (n,), time inside a membrane, s
    limited: Array  # (n,), share of the ticks in which a limit made the device's force smaller
    fault: npt.NDArray[np.uint8]  # (n,), the code of a Fault; 0 is none
    in_lanes: npt.NDArray[np.bool_]  # (n,), whether SIMD lanes computed the run; otherwise one number at a time
    pops: npt.NDArray[np.uint32]  # (n, m), number of pops
    first_pop: Array  # (n, m), time of the first pop, s
    drop: Array  # (n, m), largest drop of the model's resistance at a pop, N
    overshoot: Array  # (n, m), farthest the bevel ran on past the membrane after a pop, m
    force: Array | None = field(default=None)  # (n, ticks, 3), the model's force, N, if it was kept
    vary: Mapping[str, Array] = field(default_factory=dict)  # the numbers that differ, by path
    seeds: npt.NDArray[np.uint64] = field(default_factory=lambda: np.zeros(0, np.uint64))  # (n,)
    base: Scene | None = None  # the scene before the numbers of a run were set
    motion: Motion | None = None  # of the hand, or of the tip
    plant: Plant = field(default_factory=Plant)  # the simulated device
    hand: Hand = field(default_factory=Hand)  # the simulated hand
    axis: tuple[float, ...] = ()  # direction of the needle, for positions; else empty

    def __len__(self) -> int:
        return len(self.peak)

    def __repr__(self) -> str:
        return f"<BatchResult of {len(self)} run{'s' * (len(self) != 1)}>"

    def scene(self, i: int) -> Scene:
        """The scene of run i. Raises IndexError."""
        assert self.base is not None
        return self.base.with_values(self._values("", i))

    def experiment(self, i: int) -> Experiment:
        """Run i again, alone, so that each of its ticks can be seen. Raises ValueError for a run along positions."""
        if not isinstance(self.motion, Strokes | RecordedMotion):
            raise ValueError("a run along positions has no hand: use punctura.simulate(result.scene(i), positions)")
        return Experiment(self.scene(i), *self._operator(self.motion, i), int(self.seeds[i]), list(self.axis))

    def device(self, i: int, ticks: int) -> SimulatedDevice:
        """A simulated device that repeats run i without waiting: a ServoLoop on it has the same ticks as `experiment`.

        ticks: number of ticks after which it ends. Raises ValueError for a run along positions.
        """
        if not isinstance(self.motion, Strokes | RecordedMotion):
            raise ValueError("a run along positions has no device")
        motion, plant, hand = self._operator(self.motion, i)
        rate, seed, axis = self.scene(i).servo.rate, int(self.seeds[i]), list(self.axis)
        return SimulatedDevice(
            motion, plant, hand, rate=rate, seed=seed, real_time=False, ticks=ticks, axis=axis, priority=0
        )

    def _operator(self, motion: Strokes | RecordedMotion, i: int) -> tuple[Strokes | RecordedMotion, Plant, Hand]:
        if isinstance(motion, Strokes):
            motion = motion.replace(**self._values("strokes.", i))
        plant, hand = self.plant.replace(**self._values("plant.", i)), self.hand.replace(**self._values("hand.", i))
        return motion, plant, hand

    def to_arrow(self) -> pa.Table:
        """A table with one row for each run: what differs, the seed, the results. "drop[0]" is that of membrane 0."""
        pa = optional("pyarrow", "files", "BatchResult.to_arrow")
        columns: dict[str, npt.NDArray[np.generic]] = dict(self.vary)
        columns["seed"] = self.seeds
        for name in _OF_RUN:
            columns[name] = getattr(self, name)
        for name in _OF_MEMBRANE:
            for j, column in enumerate(getattr(self, name).T):
                columns[f"{name}[{j}]"] = np.ascontiguousarray(column)
        table = {name: pa.array(column, from_pandas=column.dtype.kind == "f") for name, column in columns.items()}
        table["fault"] = pa.array([Fault(int(code)).name for code in self.fault])
        return pa.table(table)

    def _values(self, owner: str, i: int) -> dict[str, float]:
        """The numbers of run i whose path begins with `owner`; "" is the scene."""
        if not -len(self) <= i < len(self):
            raise IndexError(f"there is no run {i}: this batch has {len(self)}, and they are counted from 0")
        others = ("plant.", "hand.", "strokes.")
        chosen = (path for path in self.vary if (path.startswith(owner) if owner else not path.startswith(others)))
        return {path.removeprefix(owner): float(self.vary[path][i]) for path in chosen}
