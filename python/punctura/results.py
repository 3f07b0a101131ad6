"""The types of results that are dicts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeAlias, TypedDict

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

# A JSON object of any content: what a file of another version may hold, or a message before it is checked. A function
# that knows the keys uses a TypedDict instead.
JsonObject: TypeAlias = dict[str, Any]
FoundEvent: TypeAlias = JsonObject  # the fields of punctura.events.Event, which checks them
LawCurve: TypeAlias = JsonObject  # likewise of punctura.studio.wire.common.LawCurve


class Quantiles(TypedDict):
    """Quantiles of a time, s, and the counts by bin of the histogram."""

    p50: float  # s
    p99: float  # s
    p99_9: float  # s
    largest: float  # s
    counts: npt.NDArray[np.uint64]  # of each bin


class FleetStep(TypedDict):
    """The results of a step of a Fleet of n trials with at most m membranes each."""

    force: npt.NDArray[np.float64]  # (n,) N in the last tick, against the needle's direction: positive holds it back
    lowest_force: npt.NDArray[np.float64]  # (n,) N, the smallest of the step
    highest_force: npt.NDArray[np.float64]  # (n,) N, the largest of the step
    travel: npt.NDArray[np.float64]  # (n,) m along the needle since the start, as the encoders measure it
    speed: npt.NDArray[np.float64]  # (n,) m/s along the needle, mean of the step
    fault: npt.NDArray[np.uint8]  # (n,) the latched Fault of the servo step; 0 is none
    depth: npt.NDArray[np.float64]  # (n, m) m behind each membrane's surface after the step; NaN if there is none
    deepest: npt.NDArray[np.float64]  # (n, m) m, the largest depth of the step


class LoopReport(TypedDict):
    """Timing statistics of a ServoLoop."""

    ticks: int  # made so far
    late: int  # ticks that came late
    period: Quantiles  # from tick to tick
    compute: Quantiles  # of a tick's computation


DeviceState = Literal[
    "available", "library_not_found", "symbol_missing", "no_device", "in_use", "needs_calibration", "fault"
]


class BackendState(TypedDict):
    """One kind of device, as `punctura.live.enumerate_devices` lists it."""

    backend: str  # the name for `--device`
    state: DeviceState  # whether it can be used, or why not
    detail: str  # where it searched, what to do
    devices: list[str]  # the names of the connected devices
