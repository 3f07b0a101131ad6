"""Models beside each other on one trace."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from punctura.errors import ConfigurationError, Problem
from punctura.progress import Tell
from punctura.rivals.chatter import Chatter, places_of, rival_chatter
from punctura.rivals.fit import RivalFit, fit_rival
from punctura.rivals.kinds import kinds
from punctura.rivals.layers import Layer
from punctura.trace import Segments, Trace, segment
from punctura.trace.information import effective_samples, information

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Row:
    """One model on the trace. SI."""

    name: str
    title: str
    parameters: int
    rmse: float  # N
    rmse_share: float  # of the peak
    aic: float
    bic: float
    held_out_rmse: float  # N, on blocks or insertions that the fit did not see
    first_rmse_share: float  # of the peak, fitted from contact to the first pop alone; NaN without a pop
    chatter: Chatter | None
    converged: bool
    starts: int
    agreeing: int
    force: Array = field(repr=False)  # (n,), N, against the insertion
    layers: tuple[Layer, ...] = field(default=(), repr=False)  # of a rival


@dataclass(frozen=True)
class TraceComparison:
    """All models on a trace, the one with the least AIC first."""

    trace: Trace = field(repr=False)
    segments: Segments = field(repr=False)
    peak: float  # N
    effective_samples: float  # of AIC and BIC
    rows: tuple[Row, ...]

    def row(self, name: str) -> Row:
        """Raises KeyError."""
        return next(row for row in self.rows if row.name == name)


def compare_trace(
    trace: Trace, names: Sequence[str] | None = None, *, with_chatter: bool = True, progress: Tell | None = None
) -> TraceComparison:
    """Fits rivals to a trace and compares them. names: default: all.

    Needs SciPy. Raises ConfigurationError for an unknown name, TraceError for a trace without an insertion.
    """
    known = kinds()
    wanted = list(known) if names is None else list(names)
    for name in wanted:
        if name not in known:
            raise ConfigurationError([Problem("rival", name, f"must be one of {', '.join(known)}")])
    segments = segment(trace)
    first = _first_stretch(trace, segments)
    fits: list[RivalFit] = []
    parts: list[RivalFit | None] = []
    for i, name in enumerate(wanted):
        if progress is not None:
            progress(i / len(wanted))
        fits.append(fit_rival(known[name], trace, segments))
        parts.append(None if first is None else fit_rival(known[name], first))
    return _comparison(trace, segments, fits, parts, with_chatter)


def _comparison(
    trace: Trace, segments: Segments, fits: list[RivalFit], parts: list[RivalFit | None], with_chatter: bool
) -> TraceComparison:
    peak = float(np.max(np.abs(trace.force)))
    effective = effective_samples(min(fits, key=lambda fit: fit.rmse).residuals)
    pop = segments.pops[0].depth if segments.pops else None
    rows = []
    for fit, part in zip(fits, parts, strict=True):
        worth = information(fit.residuals, fit.parameters, effective)
        places = places_of(fit.layers[0].surface, pop, float(trace.depth.max()))
        rows.append(
            Row(
                name=fit.kind.name,
                title=fit.kind.title,
                parameters=fit.parameters,
                rmse=fit.rmse,
                rmse_share=fit.rmse / peak,
                aic=worth.aic,
                bic=worth.bic,
                held_out_rmse=fit.held_out_rmse,
                first_rmse_share=float("nan") if part is None else part.rmse / float(np.max(np.abs(part.measured))),
                chatter=rival_chatter(fit.layers, places) if with_chatter else None,
                converged=fit.converged,
                starts=fit.starts,
                agreeing=fit.agreeing,
                force=fit.force,
                layers=fit.layers,
            )
        )
    rows.sort(key=lambda row: (row.aic, row.rmse))
    return TraceComparison(trace, segments, peak, effective, tuple(rows))


def _first_stretch(trace: Trace, segments: Segments) -> Trace | None:
    """The trace up to the first pop, from a little before contact."""
    if not segments.pops:
        return None
    contact, end = segments.contact or 0, segments.pops[0].start + 1
    start = max(0, contact - (end - contact) // 5)
    return trace[start:end] if end - start >= 8 else None
