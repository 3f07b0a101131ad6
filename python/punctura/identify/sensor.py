"""The force as the sensor of a rig gives it: behind a first-order filter, the lag, and after a delay."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from punctura import Needle
from punctura._core import TraceModel
from punctura.identify.parameters import LATE, Parameters

Array = NDArray[np.float64]

FINE = 8  # steps of a filter from sample to sample
SHIFT = 1e-5  # s, of a lag or a delay, for a derivative
OUTSIDE, JUST, SLOWLY = 0.3, 1e-6, 1e-3  # m, m, m/s: from where the needle came to the first sample, and how fast
BEYOND, LAST = 10.0, 5  # s; samples: at both ends a motion goes on as these samples show it


class _CameIn:
    """The model's force along a trace, to whose first sample the needle came from outside: it may begin in tissue."""

    def __init__(self, needle: Needle, depth: Array, time: Array | None) -> None:
        before = np.array([OUTSIDE, JUST])
        if time is not None:
            time = np.concatenate((time[0] - before / SLOWLY, time))
        self._model = TraceModel(needle, np.concatenate((depth[0] - before, depth)), time)

    def forces(self, p: Parameters, jacobian: bool = True, by: Sequence[str] = ()) -> tuple[Array, Array]:
        """As TraceModel.forces()."""
        force, columns = self._model.forces(p.membranes, p.coupling, jacobian, by)
        return force[2:], columns[2:]


class SensedModel:
    """The model's force along a trace, late as a lag and a delay make it, with derivatives.

    A delay is one of the force behind the depth: the force of a sample belongs to the depth before it.
    """

    def __init__(self, needle: Needle, depth: Array, time: Array | None) -> None:
        """depth, time: (n,), m and s. Without time, nothing is late."""
        self._needle, self._depth, self._time = needle, depth, time
        self._prompt = _CameIn(needle, depth, time)
        self._moved: tuple[float, int, _CameIn] | None = None  # the delay, s, and the steps of the last such model
        if time is not None:
            near = (0, LAST - 1), (-LAST, -1)
            slopes = [(depth[j] - depth[i]) / (time[j] - time[i]) for i, j in near]
            self._times = np.concatenate(([time[0] - BEYOND], time, [time[-1] + BEYOND]))
            ends = depth[0] - BEYOND * slopes[0], depth[-1] + BEYOND * slopes[1]
            self._depths = np.concatenate(([ends[0]], depth, [ends[1]]))

    def forces(self, p: Parameters) -> Array:
        """The force at every sample (n,), N."""
        lag, delay = p.late
        if self._time is None or lag == delay == 0:
            return self._prompt.forces(p, False)[0]
        return self._filtered(self._model(delay, lag).forces(p, False)[0], lag)

    def jacobian(self, p: Parameters, kinds: Sequence[str], late: Sequence[str]) -> tuple[Array, Array]:
        """Derivatives (n, q) by the q parameters of coupling and membranes, and those by lag and delay (n, 2).

        Only those by these kinds, and by these of lag and delay, are computed; others are 0.
        """
        by_late = np.zeros((len(self._depth), len(LATE)))
        lag, delay = p.late
        if self._time is None or not (late or lag or delay):
            return self._prompt.forces(p, by=kinds)[1], by_late
        force, columns = self._model(delay, max(lag, SHIFT if "lag" in late else 0.0)).forces(p, by=kinds)
        if "lag" in late:
            low, high = max(lag - SHIFT, 0.0), lag + SHIFT
            by_late[:, 0] = (self._filtered(force, high) - self._filtered(force, low)) / (high - low)
        if "delay" in late:
            before, after = (self.forces(p.with_values({"delay": delay + shift})) for shift in (-SHIFT, SHIFT))
            by_late[:, 1] = (after - before) / (2 * SHIFT)
        known = np.flatnonzero(columns.any(axis=0))  # the rest is 0 behind the filter, too
        given = np.zeros((len(self._depth), columns.shape[1]))
        given[:, known] = self._filtered(columns[:, known], lag)
        return given, by_late

    def _model(self, delay: float, lag: float) -> _CameIn:
        """The model along the motion before the delay, in fine steps if a filter follows."""
        steps = FINE if lag > 0 else 1
        if self._moved is None or self._moved[:2] != (delay, steps):
            depth = np.interp(self._fine(steps) - delay, self._times, self._depths)
            self._moved = delay, steps, _CameIn(self._needle, depth, self._fine(steps))
        return self._moved[2]

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
