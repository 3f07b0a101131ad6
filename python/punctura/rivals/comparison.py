"""Models beside each other on one trace, and the rivals that explain it better than the identified model does."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches

import numpy as np
from numpy.typing import NDArray

from punctura._core import Needle, Scene
from punctura.errors import ConfigurationError, Problem
from punctura.identify import Identification
from punctura.identify.criteria import EVIDENCE
from punctura.identify.depth_noise import with_quiet_depth
from punctura.identify.noise import effective_samples
from punctura.one_thread import one_thread
from punctura.progress import Report
from punctura.rivals.chatter import Chatter, places_of, rival_chatter
from punctura.rivals.first_stretch import StretchFit, compared, first_stretch, k06_on, rival_on
from punctura.rivals.fit import RivalFit, fit_rival
from punctura.rivals.k06 import CHOSEN, PRINTED, K06Fit, fit_k06, k06_chatter
from punctura.rivals.kinds import kinds
from punctura.rivals.layers import Layer
from punctura.trace import Segments, Trace, TraceError, segment
from punctura.trace.information import information

Array = NDArray[np.float64]
AnyFit = RivalFit | K06Fit


@dataclass(frozen=True)
class Row:
    """How well one model explains the trace, and with how many numbers. SI."""

    name: str  # of the model, for programs
    title: str  # for people
    parameters: int  # how many were fitted
    rmse: float  # N
    rmse_share: float  # of the peak
    aic: float  # Akaike's criterion: less is better
    bic: float  # Schwarz's criterion: less is better
    held_out_rmse: float  # N, on samples that the fit did not see; NaN if it was not measured
    first_rmse_share: float  # of the peak, fitted from contact to the first pop alone; NaN without a pop
    first_aic: float  # of that fit, among all models on the stretch
    chatter: Chatter | None  # of its force on a device; None: not computed
    converged: bool  # the fit ended by itself
    starts: int  # fits that were begun
    agreeing: int  # of them, that ended at the same numbers
    force: Array = field(repr=False)  # (n,), N, against the insertion
    layers: tuple[Layer, ...] = field(default=(), repr=False)  # of a rival
    scene: Scene | None = field(default=None, repr=False)  # of K06


@dataclass(frozen=True)
class TraceComparison:
    """All models on a trace, the one with the least AIC first."""

    trace: Trace = field(repr=False)  # that was given
    segments: Segments = field(repr=False)  # its contact, strokes and pops
    peak: float  # N
    effective_samples: float  # of AIC and BIC
    rows: tuple[Row, ...]  # one for each model

    def row(self, name: str) -> Row:
        """The row of the model with this name. Raises KeyError."""
        return {row.name: row for row in self.rows}[name]


def compare_trace(
    trace: Trace,
    names: Sequence[str] | None = None,
    *,
    needle: Needle | None = None,
    with_chatter: bool = True,
    progress: Report | None = None,
    identified: Identification | None = None,
) -> TraceComparison:
    """Fits rivals to a trace, and K06 if the needle is given, and compares them. names: of the rivals; default: all.

    identified: the identification of this trace with this needle, if there is one; K06 is then not fitted again.

    Needs SciPy. Raises ConfigurationError for an unknown name, TraceError for a trace without an insertion or
    a force.
    """
    if not trace.force.any():
        raise TraceError(f"{trace.source or 'the trace'}: the force is 0 throughout: state the column of the force")
    known = kinds()
    wanted = [*known, PRINTED] if names is None else list(names)
    for name in wanted:
        if name not in known and name != PRINTED:
            every = [PRINTED, *known]
            near = "".join(f"; did you mean {one}?" for one in get_close_matches(name, every, 1, 0.5))
            raise ConfigurationError([Problem("rival", name, f"must be one of {', '.join(every)}{near}")])
    if names is not None and PRINTED in names and needle is None:
        raise ConfigurationError([Problem("needle", "", "K06 needs the needle's diameter and tip angle")])
    trace = with_quiet_depth(trace)[0] if identified is None else identified.trace  # the same one for all models
    segments = segment(trace)
    first = first_stretch(trace, segments)
    fits: list[AnyFit] = []
    rises: dict[str, StretchFit | None] = {}  # of the first stretch
    with one_thread("punctura.rivals"):
        for i, name in enumerate(wanted):
            if progress is not None:
                progress(i / len(wanted))
            if name in known:
                fits.append(fit_rival(known[name], trace, segments))
                if first is not None:
                    rises[name] = rival_on(first, known[name])
            elif needle is not None:
                fits += fit_k06(trace, needle, identified)
                if first is not None:
                    contact = float(trace.depth[segments.contact or 0])
                    rises[PRINTED] = k06_on(first, needle, contact, False)
                    rises[CHOSEN] = k06_on(first, needle, contact, True)
    comparisons = (
        {} if first is None else compared({name: one for name, one in rises.items() if one is not None}, first)
    )
    return _comparison(trace, segments, fits, comparisons, with_chatter)


def _comparison(
    trace: Trace, segments: Segments, fits: list[AnyFit], rises: dict[str, StretchFit], with_chatter: bool
) -> TraceComparison:
    peak = float(np.max(np.abs(trace.force)))
    best = min(fits, key=lambda fit: float(np.sum(fit.residuals**2)))
    effective = effective_samples(best.residuals, best.parameters)
    pop = segments.pops[0].depth if segments.pops else None
    rows = []
    for fit in fits:
        worth = information(fit.residuals, fit.parameters, effective)
        places = places_of(fit.surface, pop, float(trace.depth.max()))
        rival = fit if isinstance(fit, RivalFit) else None
        rmse = float(np.sqrt(np.mean(fit.residuals**2)))
        rise = rises.get(fit.name)
        rows.append(
            Row(
                name=fit.name,
                title=fit.title,
                parameters=fit.parameters,
                rmse=rmse,
                rmse_share=rmse / peak,
                aic=worth.aic,
                bic=worth.bic,
                held_out_rmse=fit.held_out_rmse,
                first_rmse_share=rise.rmse_share if rise else float("nan"),
                first_aic=rise.aic if rise else float("nan"),
                chatter=_chatter(fit, places) if with_chatter else None,
                converged=rival.converged if rival else True,
                starts=rival.starts if rival else 1,
                agreeing=rival.agreeing if rival else 1,
                force=fit.force,
                layers=rival.layers if rival else (),
                scene=fit.scene if isinstance(fit, K06Fit) else None,
            )
        )
    rows.sort(key=lambda row: (row.aic, row.rmse))
    return TraceComparison(trace, segments, peak, effective, tuple(rows))


def _chatter(fit: AnyFit, places: list[float]) -> Chatter:
    return rival_chatter(fit.layers, places) if isinstance(fit, RivalFit) else k06_chatter(fit.scene, places)


def better_rivals(found: Identification) -> tuple[TraceComparison, tuple[Row, ...]]:
    """All rivals on the trace of an identification, and those with a smaller BIC and a smaller error."""
    table = compare_trace(found.trace, needle=found.parameters.needle, with_chatter=False, identified=found)
    own = [row for row in table.rows if row.name in (PRINTED, CHOSEN)]
    bic = min(row.bic for row in own)
    error = min(row.rmse for row in own)
    better = [row for row in table.rows if row not in own and row.bic < bic - EVIDENCE and row.rmse < error]
    return table, tuple(sorted(better, key=lambda row: row.bic))


def better_in_words(found: Identification) -> str:
    """One sentence on the rivals, for a trace that the model does not explain."""
    table, better = better_rivals(found)
    rmse = min(row.rmse for row in table.rows if row.name in (PRINTED, CHOSEN))
    own = f"K06 {rmse:.2g} N (punctura rivals)"
    if better:
        return f"Another model does better: {'; '.join(map(_leaves, better[:2]))}, and {own}."
    rivals = [row for row in table.rows if row.name not in (PRINTED, CHOSEN)]
    return f"No rival does better: {_leaves(min(rivals, key=lambda row: row.bic))}, and {own}."


def _leaves(row: Row) -> str:
    return f"{row.title} leaves {row.rmse:.2g} N"
