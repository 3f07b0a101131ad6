"""The force as the sensor of a rig gives it: behind a first-order filter, the lag, and after a delay."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from punctura import Needle
from punctura._core import TraceModel
from punctura.identify.parameters import LATE, Parameters
from punctura.trace.trace import USUAL_DEPTH, power_of_1000

Array = NDArray[np.float64]

FINE = 8  # steps of a filter from sample to sample
SHIFT = 1e-5  # s, of a lag or a delay, for a derivative
STEP = 1e-7  # m, the same of a play, for a trace of the usual scale
KEPT = 3  # models, of the last motions
OUTSIDE, JUST, SLOWLY = 0.3, 1e-6, 1e-3  # m, m, m/s: from where the needle came to the first sample, and how fast;
# for such a trace
BEYOND, LAST = 10.0, 5  # s; samples: at both ends a motion goes on as these samples show it


class _CameIn:
    """The model's force along a trace, to whose first sample the needle came from outside: it may begin in tissue."""

    def __init__(self, needle: Needle, depth: Array, time: Array | None) -> None:
        before = np.array([OUTSIDE, JUST])
        if time is not None:
            time = np.concatenate((time[0] - before / SLOWLY, time))
        before *= power_of_1000(depth, USUAL_DEPTH)
        self._model = TraceModel(needle, np.concatenate((depth[0] - before, depth)), time)

    def forces(self, p: Parameters, jacobian: bool = True, by: Sequence[str] = ()) -> tuple[Array, Array]:
        """As TraceModel.forces()."""
        force, columns = self._model.forces(p.membranes, p.coupling, jacobian, by)
        return force[2:], columns[2:]


def played(depth: Array, play: float) -> Array:
    """The depth (n,), m, of a needle whose drive has play: it stays behind by so many m where the drive turns.

    The measured depth is that of the needle on the first way in.
    """
    if play == 0:
        return depth
    found = np.empty(len(depth))
    at = float(depth[0])
    for i, driven in enumerate(depth.tolist()):
        at = min(max(at, driven), driven + play)
        found[i] = at
    return found


class SensedModel:
    """The model's force along a trace, late as a lag and a delay make it, behind a drive with play; with derivatives.

    A delay is one of the force behind the depth: the force of a sample belongs to the depth before it. A slack is a
    play that the needle crosses where its force changes the sign, as on a slide that moves easily.
    """

    def __init__(self, needle: Needle, depth: Array, time: Array | None) -> None:
        """depth, time: (n,), m and s. Without time, the force is not late."""
        self._needle, self._depth, self._time = needle, depth, time
        self._prompt = _CameIn(needle, depth, time)
        self._moved: dict[tuple[float, int, float], _CameIn] = {}  # by delay, s, steps, and play, m; the last ones
        if time is not None:
            near = (0, LAST - 1), (-LAST, -1)
            self._slopes = [(depth[j] - depth[i]) / (time[j] - time[i]) for i, j in near]
            self._times = np.concatenate(([time[0] - BEYOND], time, [time[-1] + BEYOND]))

    def forces(self, p: Parameters) -> Array:
        """The force at every sample (n,), N."""
        lag = 0.0 if self._time is None else p.late[0]
        return self._filtered(self._unfiltered(p, lag, False)[0], lag)

    def jacobian(self, p: Parameters, kinds: Sequence[str], late: Sequence[str]) -> tuple[Array, Array]:
        """Derivatives (n, q) by the q parameters of coupling and membranes, and those by LATE (n, 4).

        Only those by these kinds, and by these of LATE, are computed; others are 0.
        """
        by_late = np.zeros((len(self._depth), len(LATE)))
        late = late if self._time is not None else [one for one in late if one in ("play", "slack")]
        lag = 0.0 if self._time is None else p.late[0]
        force, columns = self._unfiltered(p, max(lag, SHIFT if "lag" in late else 0.0), True, kinds)
        for name in late:
            step = SHIFT if name in ("lag", "delay") else STEP * power_of_1000(self._depth, USUAL_DEPTH)
            low, high = p.get(name) - step, p.get(name) + step
            low = low if name == "delay" else max(low, 0.0)
            if name == "lag":
                before, after = self._filtered(force, low), self._filtered(force, high)
            else:
                before, after = (self.forces(p.with_values({name: one})) for one in (low, high))
            by_late[:, LATE.index(name)] = (after - before) / (high - low)
        known = np.flatnonzero(columns.any(axis=0))  # the rest is 0 behind the filter, too
        given = np.zeros((len(self._depth), columns.shape[1]))
        given[:, known] = self._filtered(columns[:, known], lag)
        return given, by_late

    def _unfiltered(self, p: Parameters, lag: float, jacobian: bool, by: Sequence[str] = ()) -> tuple[Array, Array]:
        """The force in front of a filter with this lag, in its steps, and its derivatives."""
        _, delay, play, slack = p.late
        if self._time is None:
            delay = 0.0
        force, columns = self._model(delay, lag, play).forces(p, jacobian, by)
        if slack == 0:
            return force, columns
        across, others = self._model(delay, lag, play + slack).forces(p, jacobian, by)
        pushed, pulled = force > 0, across < 0  # between them the needle is free
        given = np.where(pushed, force, 0.0) + np.where(pulled & ~pushed, across, 0.0)
        if not jacobian:
            return given, columns
        return given, np.where(pushed[:, None], columns, np.where((pulled & ~pushed)[:, None], others, 0.0))

    def _model(self, delay: float, lag: float, play: float) -> _CameIn:
        """The model along the motion before the delay, in fine steps if a filter follows."""
        steps = FINE if lag > 0 else 1
        if delay == play == 0 and steps == 1:
            return self._prompt
        key = delay, steps, play
        if key not in self._moved:
            depth, times = played(self._depth, play), self._time
            if times is not None and (delay or steps > 1):
                times = self._fine(steps)
                ends = depth[0] - BEYOND * self._slopes[0], depth[-1] + BEYOND * self._slopes[1]
                depth = np.interp(times - delay, self._times, np.concatenate((ends[:1], depth, ends[1:])))
            while len(self._moved) >= KEPT:
                del self._moved[next(iter(self._moved))]
            self._moved[key] = _CameIn(self._needle, depth, times)
        return self._moved[key]

    def _fine(self, steps: int) -> Array:
        """So many times, s, from sample to sample."""
        assert self._time is not None
        samples = np.arange(len(self._time))
        return np.interp(np.arange(samples[-1] * steps + 1) / steps, samples, self._time)

    def _filtered(self, columns: Array, lag: float) -> Array:
        """What a first-order filter gives of columns in fine steps, at the samples."""
        from scipy.linalg.lapack import dtbtrs

        steps = (len(columns) - 1) // (len(self._depth) - 1)
        if lag <= 0 or not columns.size:  # without columns, SciPy's dtbtrs writes beyond its memory
            return columns[::steps]
        kept = np.exp(-np.diff(self._fine(steps)) / lag)
        band = np.ones((2, len(columns)))
        band[1, :-1] = -kept
        gain = np.concatenate(([1.0], 1 - kept))
        given, _ = dtbtrs(band, gain[:, None] * columns.reshape(len(columns), -1), uplo="L", diag="U")
        return np.asarray(given.reshape(columns.shape)[::steps])
