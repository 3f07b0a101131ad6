"""Chooses the extensions of K06 that a trace asks for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from punctura import Needle
from punctura.identify.fit import Fit, Misfit, best_fit, with_pops_moved
from punctura.identify.noise import effective_samples
from punctura.identify.parameters import Parameters
from punctura.identify.start import starts
from punctura.identify.stretch import stretch_starts
from punctura.trace import Segments, Trace, TraceError

OWN = ("surface", "stiffness", "precompression", "friction", "thickness")  # each membrane's own
SEARCHED = 600  # samples of a search; the last fit uses all
FOLDS = 4


@dataclass(frozen=True)
class Extension:
    """An addition to K06 that all membranes share: its parameters with start values, and when it can be seen."""

    name: str
    start: dict[str, float]  # SI; a stiffness as a part of the coupling's
    needs_hold: bool = False
    needs_insertions: int = 1


def extensions(needle: Needle) -> tuple[Extension, ...]:
    """Every extension that identification tries, in this order."""
    w, tip = needle.diameter, needle.diameter / np.tan(needle.tip_angle)
    return (
        Extension("curved grip", {"tissue.growth": 1 / w, "tissue.tip_length": tip}),
        Extension("tip length", {"tissue.tip_length": 1.02 * tip}),
        Extension("tail", {"tissue.tail_length": 0.3 * tip, "tissue.tail_floor": 0.8}),
        Extension("relaxation", {"relaxation_1_stiffness": 0.4, "relaxation_1_time": 1.0}, needs_hold=True),
        Extension("second relaxation", {"relaxation_2_stiffness": 0.3, "relaxation_2_time": 10.0}, needs_hold=True),
        Extension("cutting", {"tissue.cutting": 0.05}, needs_insertions=2),
        Extension("set", {"tissue.set": 0.1}, needs_insertions=2),
    )


@dataclass(frozen=True, eq=False)
class Candidate:
    """A model that was tried, fitted to the samples of the search."""

    name: str
    extensions: tuple[str, ...]
    fit: Fit
    effective: float
    held_out: float | None = None  # N, rms of samples that the fit did not use

    @property
    def aicc(self) -> float:
        """Akaike's criterion, corrected for few samples, with the effective number of samples."""
        n, k = self.effective, len(self.fit.u) + 1
        return float(n * np.log(self.fit.sse / len(self.fit.residuals)) + 2 * k + 2 * k * (k + 1) / max(n - k - 1, 1))

    def bic(self, effective: float) -> float:
        """The Bayesian criterion with this number of independent samples."""
        size = len(self.fit.residuals)
        return float(effective * np.log(self.fit.sse / size) + (len(self.fit.u) + 1) * np.log(effective))


def thinned(trace: Trace) -> Trace:
    """At most SEARCHED samples, evenly taken."""
    return trace[:: max(1, -(-len(trace) // SEARCHED))]


def choose(
    trace: Trace, segments: Segments, needle: Needle, membranes: int, tell: Callable[[str], None] = lambda _: None
) -> tuple[Candidate, ...]:
    """All models that were tried, the chosen one first: extensions are added while BIC and held-out error fall."""
    names = [f"membrane[{i}].{kind}" for i in range(membranes) for kind in OWN] + ["coupling_stiffness", "offset"]
    names += ["drift"] * (trace.time is not None and any(f.kind == "drift" for f in trace.findings))
    plain = list(starts(trace, segments, needle, membranes))[:3]
    curved = list(starts(trace, segments, needle, membranes, True))[:2]
    if membranes > 1 and membranes == sum(int(trace.strokes[pop.start] == 0) for pop in segments.pops):
        plain += list(stretch_starts(trace, segments, needle, curved=False))[:2]
        curved = [*list(stretch_starts(trace, segments, needle, curved=True))[:2], *curved[:1]]
    tell("K06")
    current = _candidate("K06", (), Misfit(trace, plain[0]), names, plain)
    tried = [current]
    for extension in extensions(needle):
        if extension.needs_hold and not segments.holds:
            continue
        if segments.insertions < extension.needs_insertions or any(
            n in current.fit.free.names for n in extension.start
        ):
            continue
        tell(extension.name)
        here = current.fit.parameters
        from_here = here.with_values(_kept(here, extension))
        weak = [from_here.with_values({"tissue.tail_floor": 0.98})] if "tissue.tail_floor" in extension.start else []
        fresh = [p.with_values(_kept(p, extension)) for p in curved] if "tissue.growth" in extension.start else []
        try:
            found = _candidate(
                extension.name, (*current.extensions, extension.name), current.fit.misfit,
                [*current.fit.free.names, *extension.start], [from_here, *weak, *fresh],
            )  # fmt: skip
        except TraceError:
            continue
        tried.append(found)
        if _better(found, current):
            current = found
    if membranes > 1:
        tell("one tissue")
        tied = _one_tissue(current, membranes)
        if tied is not None:
            tried.append(tied)
            if _better(tied, current):
                current = tied
    return (current, *(c for c in tried if c is not current))


def _one_tissue(current: Candidate, membranes: int) -> Candidate | None:
    """The same extensions with one stiffness, friction and thickness for all walls. Depth and grip at rest stay own."""
    own = [f"membrane[{i}].{kind}" for i in range(membranes) for kind in ("surface", "precompression")]
    shared = ["stiffness", "friction", "thickness"]
    left_out = {f"membrane[{i}].{kind}" for i in range(membranes) for kind in OWN}
    names = [*own, *(f"tissue.{kind}" for kind in shared), *(n for n in current.fit.free.names if n not in left_out)]
    here = current.fit.parameters
    middle = {
        f"tissue.{kind}": float(np.median([here.get(f"membrane[{i}].{kind}") for i in range(membranes)]))
        for kind in shared
    }
    try:
        return _candidate(
            "one tissue", (*current.extensions, "one tissue"), current.fit.misfit, names, [here.with_values(middle)]
        )
    except TraceError:
        return None


def _kept(parameters: Parameters, extension: Extension) -> dict[str, float]:
    """The start values of an extension where these parameters have none of their own. A branch takes its part of K."""
    spring = parameters.get("coupling_stiffness")
    values = {}
    for name, value in extension.start.items():
        branch = name.startswith("relaxation") and name.endswith("stiffness")
        if branch:
            values[name] = value * spring
        elif parameters.get(name) in (0.0, 1.0) or name.startswith("relaxation"):
            values[name] = value
    return values


def _candidate(
    name: str, extended: tuple[str, ...], misfit: Misfit, names: Sequence[str], from_these: Sequence[Parameters]
) -> Candidate:
    found = with_pops_moved(best_fit(misfit, names, from_these))
    return Candidate(name, extended, found, effective_samples(found.residuals, len(names)), held_out_error(found))


def _better(new: Candidate, old: Candidate) -> bool:
    effective = max(new.effective, old.effective)  # of the residuals that are nearer to noise
    held_out = new.held_out is None or old.held_out is None or new.held_out < 1.02 * old.held_out
    return new.bic(effective) < old.bic(effective) - 2 and held_out


def held_out_error(fit: Fit) -> float | None:
    """The rms error, N, in parts of the trace that the fit did not use: whole insertions, or blocks of samples."""
    trace, n = fit.misfit.trace, len(fit.misfit.trace)
    groups = trace.strokes if trace.strokes.max() > 0 else np.arange(n) * 5 * FOLDS // n
    squares = []
    for fold in range(min(FOLDS, int(groups.max()) + 1)):
        out = groups % FOLDS == fold
        if out.all() or not out.any():
            continue
        part = Misfit(trace, fit.parameters, ~out)
        try:
            kept = best_fit(part, [n for n in fit.free.names], [fit.parameters], quick=True)
        except TraceError:
            return None
        squares.append((part.forces(kept.parameters) - trace.force)[out] ** 2)
    return float(np.sqrt(np.mean(np.concatenate(squares)))) if squares else None
