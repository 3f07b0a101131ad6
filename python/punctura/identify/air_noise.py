"""What the air before the contact and behind the exit tells about the sensor: its zero, its noise, whether it drifted.

What the sensor does not do in air is not blamed on it in tissue.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from punctura.identify.noise import Mixture
from punctura.trace import Segments, Stroke, Trace
from punctura.trace.air import spread
from punctura.trace.rig_force import RIG_FORCES, shapes

Array = NDArray[np.float64]

ZERO_NOISES, ZERO_SHARE = 8.0, 0.01  # standard deviations in air and share of the peak, by which the zero may be wrong
SHORT, STEEP = 0.005, 95  # share of the range of the depths, that is a way; per cent of the ways are less steep
RELAXED = 0.05  # of the peak: a force that falls by more in a rest relaxes
FEWEST, MOST = 5, 100  # samples at one end: fewer tell nothing, more are thinned
TELLING = 40  # samples of air, by which a noise that is as large as an error of a model in tissue may be excluded
UNLIKELY = 16.3  # -2 ln of a likelihood ratio, beyond which a noise is excluded: chi-squared of 3, 1 in 1000
TOO_LARGE = 10.8  # -2 ln of a likelihood ratio of a variance: chi-squared of 1, 1 in 1000
SHOWN = -2.0  # the same, below which the air shows a noise: more is "not worth a mention" (Kass and Raftery 1995)


class AirNoise:
    """The measured force in air: an unknown zero, a drift where the models have one, and noise.

    A noise that it excludes explains nothing in tissue.
    """

    def __init__(self, trace: Trace, segments: Segments) -> None:
        n = len(trace)
        before = np.arange(0 if segments.contact is None else segments.contact + 1)
        after = np.arange(n if segments.exit is None else segments.exit, n)
        ends = [rows[:: -(-len(rows) // MOST)] for rows in (before, after) if len(rows) >= FEWEST]
        self._sizes = [len(rows) for rows in ends]
        self._rows = np.concatenate(ends) if ends else np.arange(0)
        self._force = trace.force[self._rows]
        known = [np.ones(n), *shapes(trace).T]
        if trace.time is not None and "drift" in seen_in_air(trace):
            known.append(trace.time - trace.time[0])
        self._known = np.column_stack([one for one in known if one.any()])[self._rows]
        levels = [float(np.median(trace.force[rows])) for rows in ends]
        self._change = abs(levels[1] - levels[0]) if len(levels) == 2 else None
        self._noise = max(spread(trace.force[rows]) for rows in ends) if ends else np.inf
        self._peak = float(np.max(np.abs(trace.force - (levels or [0.0])[0])))
        self._zero = float(np.mean(levels)) if levels else 0.0
        self._steepest = _steepest(trace)
        self.relaxes = self._change is not None and any(self._relaxes(trace, hold) for hold in segments.holds)

    @property
    def zero(self) -> tuple[float, float]:
        """The least and the greatest zero of the force, N, that air at both ends allows; open if it is at one end."""
        if self._change is None:
            return -np.inf, np.inf
        away = max(ZERO_NOISES * self._noise, ZERO_SHARE * self._peak) + self._change
        return self._zero - away, self._zero + away

    def _relaxes(self, trace: Trace, hold: Stroke) -> bool:
        """Whether the force falls in this rest by more than noise, the sensor's change in air and motion explain."""
        force, depth = trace.force[hold.start : hold.end], trace.depth[hold.start : hold.end]
        part = len(force) // 5
        if part < 3:
            return False
        starts = (part // 2, 2 * part, len(force) - part)
        first, middle, last = (float(np.median(force[at : at + part])) for at in starts)
        fell = min(first - last, 2.5 * (first - middle))  # it begins with the rest
        moved = float(np.ptp(depth[part // 2 :]))
        assert self._change is not None
        return fell > max(RELAXED * self._peak, ZERO_NOISES * self._noise, 3 * self._change) + self._steepest * moved

    def allows(self, mixture: Mixture, variance: float) -> bool:
        """Whether the air does not exclude this noise, of this variance, N^2; short air excludes little."""
        if len(self._force) < 2 * FEWEST:
            return True
        return self._against(mixture, variance) <= UNLIKELY and not self._too_large(mixture, variance)

    def tested(self, mixture: Mixture, variance: float) -> bool:
        """Whether there are TELLING samples of air, and they do not exclude this noise: it need not be there."""
        return len(self._force) >= TELLING and self.allows(mixture, variance)

    def shows(self, mixture: Mixture, variance: float) -> bool:
        """Whether this noise, of this variance, N^2, is clearly more likely in air than white noise.

        What is slow in tissue alone may as well be a model that is wrong there.
        """
        return self.allows(mixture, variance) and (
            len(self._force) >= 2 * FEWEST and self._against(mixture, variance) < SHOWN
        )

    def _too_large(self, mixture: Mixture, variance: float) -> bool:
        """Whether one end of the trace is too quiet for so much of this noise, although it may be correlated so.

        Correlated air excludes white noise, and then any noise of that correlation is more likely than white noise.
        """
        begin = 0
        for size in self._sizes:
            rows, begin = slice(begin, begin + size), begin + size
            if size >= 2 * FEWEST:
                lags = np.abs(self._rows[rows, None] - self._rows[rows])
                shape = mixture.share * np.exp(-lags / mixture.length) + (1 - mixture.share) * np.eye(size)
                excess, likely = self._excess(shape, variance, rows)
                if likely < variance and excess > TOO_LARGE:
                    return True
        return False

    def _against(self, mixture: Mixture, variance: float) -> float:
        """-2 ln of the likelihood of this noise in air over that of the most likely white noise."""
        m = len(self._force)
        lags = np.abs(self._rows[:, None] - self._rows)
        shape = mixture.share * np.exp(-lags / mixture.length) + (1 - mixture.share) * np.eye(m)
        return self._misfit(shape, variance) - self._misfit(np.eye(m), None)

    def _misfit(self, shape: Array, variance: float | None) -> float:
        """-2 ln of the restricted likelihood for the correlations `shape` (m, m); variance None: the most likely."""
        squares, free, sizes = self._left(shape, slice(None))
        v = max(squares / free if variance is None else variance, 1e-300)
        return float(2 * np.log(sizes).sum() + free * np.log(v) + squares / v)

    def _excess(self, shape: Array, variance: float, rows: slice) -> tuple[float, float]:
        """-2 ln of the likelihood of this variance over that of the most likely one, and the most likely one, N^2."""
        squares, free, _ = self._left(shape, rows)
        likely = max(squares / max(free, 1), 1e-300)
        return float(free * (np.log(max(variance, 1e-300) / likely) + likely / max(variance, 1e-300) - 1)), likely

    def _left(self, shape: Array, rows: slice) -> tuple[float, int, Array]:
        """The squares that the zero and the rig leave, N^2, their degrees of freedom, and the factors of a volume."""
        lower = np.linalg.cholesky(shape)
        columns = np.linalg.solve(lower, np.column_stack((self._known[rows], self._force[rows])))
        known, force = columns[:, :-1], columns[:, -1]
        basis, triangle = np.linalg.qr(known)
        left = force - basis @ (basis.T @ force)
        sizes = np.concatenate((np.diag(lower), np.abs(np.diag(triangle))))
        return float(left @ left), len(shape) - known.shape[1], sizes


def seen_in_air(trace: Trace) -> tuple[str, ...]:
    """What the air says of the rig: each model then has a drift over the time, and what is left of its forces."""
    forces = [name for name, shape in zip(RIG_FORCES, shapes(trace).T, strict=True) if shape.any()]
    drifts = trace.slide is not None or any(finding.kind == "drift" for finding in trace.findings)
    return (*(("drift",) if drifts and trace.time is not None else ()), *forces)


def _steepest(trace: Trace) -> float:
    """How steep the force is against the depth, N/m, over ways that count."""
    size = max(1, len(trace) // 100)
    ways, forces = (np.abs(column[size:] - column[:-size]) for column in (trace.depth, trace.force))
    far = ways > SHORT * float(np.ptp(trace.depth))
    return float(np.percentile(forces[far] / ways[far], STEEP)) if far.any() else np.inf
