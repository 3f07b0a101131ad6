"""A trace, its fit and the other models as lines for the page."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from punctura import ConfigurationError
from punctura.identify import Identification
from punctura.rivals import Row, TraceComparison
from punctura.rivals.k06 import CHOSEN, PRINTED
from punctura.rivals.words import notes
from punctura.scene import scene_text
from punctura.studio.loaded import from_text
from punctura.studio.wire.identified import (
    ColumnPart,
    CurvesPart,
    EstimatePart,
    FileLine,
    FindingPart,
    FitLine,
    NeedlePart,
    RivalRow,
    RivalsLine,
    Role,
    RolePart,
    TraceLine,
    TriedPart,
)
from punctura.trace import Trace, segment
from punctura.trace.columns import REQUIRED
from punctura.trace.look import Look
from punctura.trace.units import UNITS

POINTS = 3000  # samples of a curve, at most
DIGITS = 6
Array = npt.NDArray[np.float64]
ROLES: tuple[Role, ...] = ("depth", "force", "time")


def file_line(name: str, look: Look) -> FileLine:
    """What a file holds."""
    guesses = {guess.role: guess for guess in look.guesses}
    roles = [
        RolePart(
            role=role,
            needed=role in REQUIRED,
            column=guesses[role].column,
            units=list(UNITS[role]),
        )
        for role in ROLES
        if role in guesses
    ]
    known = look.needle
    needle = None if known is None else NeedlePart(diameter=known.diameter, tip_angle=known.tip_angle)
    columns = [ColumnPart(name=one.name, unit=one.unit, examples=list(one.examples)) for one in look.columns]
    return FileLine(name=name, rows=look.rows, columns=columns, roles=roles, needle=needle)


def trace_line(trace: Trace) -> TraceLine:
    """A trace before its fit."""
    segments = segment(trace)
    return TraceLine(
        name=trace.source,
        samples=len(trace),
        peak=float(np.max(np.abs(trace.force))),
        contact=None if segments.contact is None else float(trace.depth[segments.contact]),
        pops=[pop.depth for pop in segments.pops],
        curves=_curves(trace, None),
        findings=[FindingPart(kind=one.kind, text=one.text) for one in trace.findings],
    )


def fit_line(found: Identification) -> FitLine:
    """The identified membranes, and their scene, checked as a scene file that a user loads."""
    chosen = found.candidates[0]
    scene, no_scene = _scene(found)
    return FitLine(
        membranes=len(found.parameters.membranes),
        extensions=list(found.extensions),
        rmse=found.fit.rmse,
        rmse_share=found.fit.rmse / found.peak,
        explained=found.doubts.whole,
        effective_samples=found.effective_samples,
        curves=_curves(found.trace, found.fit.misfit.forces(found.parameters)),
        estimates=[
            EstimatePart(
                name=one.name, value=one.value, low=one.low, high=one.high, unit=one.unit, identifiable=one.identifiable
            )
            for one in found.estimates
        ],
        verdicts=list(found.verdicts),
        tried=[
            TriedPart(
                membranes=one.model.membranes,
                extensions=list(one.extensions),
                parameters=len(one.fit.u),
                rmse=one.fit.rmse,
                held_out_rmse=one.held_out,
                aicc=worth.aic if math.isfinite(worth.aic) else None,
                bic=worth.bic,
            )
            for one in found.candidates
            for worth in [one.worth(chosen.effective)]
        ],
        scene=scene,
        no_scene=no_scene,
    )


def _scene(found: Identification) -> tuple[str, str]:
    """The text of the scene file, or why there is none."""
    try:
        text = scene_text(found.scene)
        from_text(text)
    except ConfigurationError as error:
        return "", "; ".join(str(problem) for problem in error.problems)
    return text, ""


def rivals_line(comparison: TraceComparison, found: Identification) -> RivalsLine:
    """All models on the trace of an identification."""
    kept = kept_samples([found.trace.force, found.fit.misfit.forces(found.parameters)])
    return RivalsLine(rows=[_row(row, kept) for row in comparison.rows], notes=notes(comparison))


def _row(row: Row, kept: npt.NDArray[np.int64]) -> RivalRow:
    return RivalRow(
        name=row.name,
        title=row.title,
        parameters=row.parameters,
        rmse=row.rmse,
        rmse_share=row.rmse_share,
        aic=_finite(row.aic),
        bic=_finite(row.bic),
        held_out_rmse=_finite(row.held_out_rmse),
        rest=None if row.chatter is None else _finite(row.chatter.rest),
        converged=row.converged,
        own=row.name in (PRINTED, CHOSEN),
        force=_numbers(row.force[kept]),
    )


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _curves(trace: Trace, model: Array | None) -> CurvesPart:
    kept = kept_samples([trace.force] if model is None else [trace.force, model])
    return CurvesPart(
        depth=_numbers(trace.depth[kept]),
        force=_numbers(trace.force[kept]),
        time=None if trace.time is None else _numbers(trace.time[kept]),
        model=None if model is None else _numbers(model[kept]),
    )


def kept_samples(curves: list[Array], points: int = POINTS) -> npt.NDArray[np.int64]:
    """The samples of a drawing, ascending: of each stretch the first, the last, and the extremes of each curve."""
    n = len(curves[0])
    if n <= points:
        return np.arange(n)
    size = math.ceil(n * (2 + 2 * len(curves)) / points)
    kept = {0, n - 1}
    for start in range(0, n, size):
        end = min(start + size, n)
        kept |= {start, end - 1}
        for curve in curves:
            kept |= {start + int(np.argmin(curve[start:end])), start + int(np.argmax(curve[start:end]))}
    return np.array(sorted(kept), np.int64)


def _numbers(values: Array) -> list[float]:
    return [float(f"{value:.{DIGITS}g}") for value in values]
