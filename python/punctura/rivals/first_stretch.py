"""Models on the rise of the force from contact to the first pop, where each shows its law of the rise alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from punctura._core import Needle
from punctura.identify.fit import Misfit, Start, best_fit
from punctura.identify.noise import effective_samples
from punctura.identify.parameters import Parameters, default_coupling, default_membrane
from punctura.rivals.fit import fit_rival
from punctura.rivals.kinds import RivalKind
from punctura.trace import Segments, Trace, TraceError
from punctura.trace.information import information

Array = NDArray[np.float64]

BENDS = (0.5, 2.0, 4.0)  # growth times the opening at the end of the stretch, starts
STIFF = 1e5  # N/m, of a spring that does not show
FRICTION = 0.2  # before the pop, friction and grip are one number
RISE = ("membrane[0].surface", "membrane[0].stiffness")
FIRST, SPRING = "membrane[0].precompression", "coupling_stiffness"


@dataclass(frozen=True)
class StretchFit:
    """A model on the first stretch. residuals (n,), N. aic: the corrected form, with m of the best model."""

    residuals: Array
    parameters: int
    rmse_share: float = float("nan")  # of the stretch's peak
    aic: float = float("nan")


def first_stretch(trace: Trace, segments: Segments) -> Trace | None:
    """The trace up to the first pop, from a little before contact; None without a pop, or with too few samples."""
    if not segments.pops:
        return None
    contact, end = segments.contact or 0, segments.pops[0].start + 1
    start = max(0, contact - (end - contact) // 5)
    return trace[start:end] if end - start >= 8 else None


def rival_on(stretch: Trace, kind: RivalKind) -> StretchFit:
    """A rival, fitted to the stretch alone."""
    found = fit_rival(kind, stretch)
    return StretchFit(found.residuals, found.parameters)


def k06_on(stretch: Trace, needle: Needle, contact: float, curved: bool) -> StretchFit | None:
    """K06's rise, with a grip that may be curved or not; None if no fit ends. contact: a depth, m.

    Numbers that a rise cannot show are not fitted: friction, and what happens behind the tip. First force and spring
    are fitted if the corrected AIC then is smaller.
    """
    rise = (*RISE, "tissue.growth") if curved else RISE
    stretched = float(np.ptp(stretch.depth))
    soft = 4 * float(np.max(stretch.force)) / stretched
    fits = []
    for more in ((), (FIRST,), (SPRING,), (FIRST, SPRING)):
        starts = [
            _start(stretch, needle, contact, bend, stiffness, curved, FIRST in more)
            for bend in (BENDS if curved else (0.0,))
            for stiffness in ((soft, STIFF) if SPRING in more else (STIFF,))
        ]
        try:
            fits.append(best_fit(Misfit(stretch, starts[0]), (*rise, *more), [Start(one) for one in starts]))
        except TraceError:
            continue
    if not fits:
        return None
    best = min(fits, key=lambda one: one.sse)
    effective = effective_samples(best.residuals, len(best.u))
    chosen = min(fits, key=lambda one: information(one.residuals, len(one.u), effective).aic)
    return StretchFit(chosen.residuals, len(chosen.u))


def compared(fits: dict[str, StretchFit], stretch: Trace) -> dict[str, StretchFit]:
    """The fits with their share of the peak and their AIC, which counts the independent samples of the best one."""
    if not fits:
        return {}
    best = min(fits.values(), key=lambda one: float(np.sum(one.residuals**2)))
    effective = effective_samples(best.residuals, best.parameters)
    peak = float(np.max(np.abs(stretch.force)))
    return {
        name: StretchFit(
            one.residuals, one.parameters, float(np.sqrt(np.mean(one.residuals**2))) / peak,
            information(one.residuals, one.parameters, effective).aic,
        )
        for name, one in fits.items()
    }  # fmt: skip


def _start(
    stretch: Trace, needle: Needle, contact: float, bend: float, stiffness: float, curved: bool, first: bool
) -> Parameters:
    """A wall that rises to the peak at the end of the stretch. With `curved`, the tip is longer than the stretch."""
    reach = max(float(stretch.depth[-1]) - contact, 1e-4)
    peak = max(float(np.max(stretch.force)), 1e-3)
    tip = needle.diameter / np.tan(needle.tip_angle)
    length = max(2 * reach, tip) if curved else tip
    opening = needle.diameter * min(reach / length, 1.0)
    grip = peak / (2 * FRICTION + np.tan(needle.tip_angle))
    values = {
        "surface": contact, "stiffness": grip / (np.expm1(bend) * opening / bend if bend else opening),
        "precompression": 0.02 * grip if first else 0.0, "friction": FRICTION,
        "thickness": 0.02 * reach, "growth": bend / opening, "tip_length": length if curved else 0.0,
    }  # fmt: skip
    start = Parameters(needle, np.array([default_membrane()]), default_coupling(stiffness))
    return start.with_values({f"membrane[0].{name}": value for name, value in values.items()})
