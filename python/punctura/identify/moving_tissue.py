"""Whether tissue that breathes or pulses explains a trace: K06 is fitted to a depth that swings about the measured one.

A swing is no sum to the force: where the needle rests it pushes and pulls, and where the needle slides it hardly shows.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from punctura.identify.causes import Cause
from punctura.identify.explained import Explained
from punctura.identify.fit import Fit, Misfit
from punctura.identify.least_squares import least_squares
from punctura.identify.parameters import Parameters
from punctura.trace import Trace

Array = NDArray[np.float64]

FASTEST, SAMPLES = 4.0, 8  # Hz, and samples of a period: a swing that is looked for is slower
PERIODS, MOST = 3.0, 2400  # in the time in tissue, at least; frequencies that are tried
PER_PERIOD = 2  # frequencies, from one that makes a period more in the trace to the next
LIKELY, FINER = 10, np.array([-1.0, 0.0, 1.0]) / 3  # frequencies that are tried again, in parts of the way to the next
SIZES, PHASES = (5e-5, 3e-4), np.arange(4) * np.pi / 4  # m; a factor may be negative
STARTS, EVALUATIONS = 4, 60
UNIT = 1e-4  # m, of the coordinates of a swing; those of a frequency are Hz
LARGEST = 20.0  # times this unit
SLOWEST = 1.01  # times the slowest frequency: what ends there is no swing
STEPS = (2e-3, 2e-3, 1e-4)  # for derivatives by the two parts of a swing, and its frequency
SHARE = 0.8  # of what the chosen model leaves beside noise, that a swing explains at least


class _Swinging:
    """K06 along a depth that swings. x: coordinates of the fit, then sine and cosine, UNIT, and frequency, Hz."""

    def __init__(self, fit: Fit) -> None:
        self.fit, self.trace = fit, fit.misfit.trace
        assert self.trace.time is not None
        self._since = self.trace.time - self.trace.time[0]

    def residuals(self, x: Array) -> Array:
        """Model minus measured force (n,), N."""
        p = self.fit.free.parameters(x[:-3])
        return self._misfit(x, p).forces(p) - self.trace.force

    def jacobian(self, x: Array) -> Array:
        """Derivatives of the residuals by the coordinates."""
        p = self.fit.free.parameters(x[:-3])
        columns = [self._misfit(x, p).jacobian(self.fit.free, x[:-3])]
        for k, step in enumerate(STEPS, len(x) - 3):
            low, high = x.copy(), x.copy()
            low[k], high[k] = x[k] - step, x[k] + step
            columns.append(((self.residuals(high) - self.residuals(low)) / (2 * step))[:, None])
        return np.hstack(columns)

    def _misfit(self, x: Array, p: Parameters) -> Misfit:
        turn = 2 * np.pi * x[-1] * self._since
        depth = self.trace.depth + UNIT * (x[-3] * np.sin(turn) + x[-2] * np.cos(turn))
        return Misfit(replace(self.trace, depth=depth, depths=None), p)

    def starts(self, rates: Array) -> Iterator[Array]:
        """The swings with which a linear model explains most. rates: Hz, at even steps."""
        known = self.fit.misfit.jacobian(self.fit.free, self.fit.u)
        known = np.linalg.qr(known / np.maximum(np.sqrt(np.sum(known**2, axis=0)), 1e-300))[0]
        before = self.residuals(np.concatenate((self.fit.u, np.zeros(3))))
        left = before - known @ (known.T @ before)

        def column(swing: Array) -> Array:
            added = self.residuals(np.concatenate((self.fit.u, swing))) - before
            return np.asarray(added - known @ (known.T @ added))

        def both(rate: float) -> float:
            """What sine and cosine of a small swing explain together."""
            columns = np.column_stack([column(np.array([*part, rate])) for part in np.eye(2)])
            return float(np.sum((np.linalg.qr(columns)[0].T @ left) ** 2))

        likely = sorted(rates, key=both)[-LIKELY:]
        step = float(rates[1] - rates[0]) if len(rates) > 1 else 0.0
        best = []
        for rate in np.clip(np.add.outer(likely, step * FINER).ravel(), rates[0], rates[-1]):
            gains = []
            for size, phase in product(SIZES, PHASES):
                swing = np.array([size / UNIT * np.cos(phase), size / UNIT * np.sin(phase), rate])
                added = column(swing)
                along = float(added @ left)
                swing[:2] *= -np.sign(along)
                gains.append((along**2 / max(float(added @ added), 1e-300), swing))
            best.append(max(gains, key=lambda one: one[0]))
        best.sort(key=lambda one: -one[0])
        yield from (np.concatenate((self.fit.u, swing)) for _, swing in best[:STARTS])

    def rates(self) -> Array:
        """Frequencies, Hz, so many that none between them is missed; of a very long trace only the slower ones."""
        span, in_tissue = float(self._since[-1]), float(np.mean(self.trace.depth > self._surface())) + 1e-9
        slowest = PERIODS / (span * in_tissue)
        fastest = max(min(FASTEST, len(self.trace) / (SAMPLES * span), MOST / (PER_PERIOD * span)), slowest)
        return np.linspace(slowest, fastest, int(np.ceil(PER_PERIOD * span * (fastest - slowest))) + 1)

    def _surface(self) -> float:
        return float(self.fit.parameters.membranes[:, 0].min())


def moving_tissue(trace: Trace, plain: Fit, chosen: Fit, assessment: Explained) -> Cause | None:
    """The cause, if a swing explains nearly all that the chosen model does not. plain: K06's, perhaps of few samples.

    A swing that ends at the slowest one is none: its period is not seen.
    """
    if assessment.ok or trace.time is None or not plain.misfit.used.all():
        return None
    fitted = plain.misfit.trace
    enough = max(len(fitted), int(SAMPLES * FASTEST * float(np.ptp(trace.time))))
    used = trace[:: max(1, len(trace) // enough)]
    if len(used) > len(fitted):
        misfit = Misfit(used, plain.parameters, zero=plain.misfit.zero)
        plain = replace(plain, misfit=misfit, free=misfit.free(plain.free.names, plain.parameters))
        plain = replace(plain, u=plain.free.coordinates(plain.parameters))
        chosen = replace(chosen, misfit=Misfit(used, chosen.parameters).with_depth_error(chosen.parameters))
    model, free = _Swinging(plain), plain.free
    rates = model.rates()
    low = np.concatenate((free.low, [-LARGEST, -LARGEST, rates[0]]))
    high = np.concatenate((free.high, [LARGEST, LARGEST, max(rates[-1], 1.001 * rates[0])]))
    ends = [
        least_squares(model.residuals, model.jacobian, start, (low, high), 1e-5, 1e-6, EVALUATIONS)[0]
        for start in model.starts(rates)
    ]
    x = min(ends, key=lambda end: float(np.sum(model.residuals(end) ** 2)))
    left = float(np.sum(model.residuals(x) ** 2))
    before = float(np.sum((chosen.misfit.forces(chosen.parameters) - model.trace.force) ** 2))
    share = (before - left) / max(before - len(model.trace) * assessment.noise**2, 1e-300)
    if not share > SHARE or x[-1] < SLOWEST * rates[0]:
        return None
    size, spring = UNIT * float(np.hypot(x[-3], x[-2])), free.parameters(x[:-3]).get("coupling_stiffness")
    text = (
        f"The trace is as if the tissue moved back and forth by ±{1e6 * size:.3g} um, {x[-1]:.2g} times a second, as "
        f"breathing or a pulse moves it. While the needle rests, the spring makes up to {size * spring:.2g} N of it. "
        "To tell: rest in the tissue for ten periods. To fit it: hold the breath, or record the motion of the surface "
        "and subtract it from the depth"
    )
    return Cause("moving_tissue", min(share, 1.0), text)
