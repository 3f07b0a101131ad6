"""Chooses the model that a trace asks for: the extensions of K06, and the number of its membranes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice

import numpy as np

from punctura import Needle
from punctura.identify.contacts_moved import with_contacts_moved
from punctura.identify.criteria import Candidate, Rule, candidate
from punctura.identify.fit import Misfit, Start, best_fit
from punctura.identify.model import ONE_TISSUE, Extension, Model, extensions
from punctura.identify.pops_moved import noise_limit, with_pops_moved
from punctura.identify.rises import rise_starts
from punctura.identify.start import starts
from punctura.identify.walls import with_a_wall_more, without_a_wall
from punctura.trace import Segments, Trace, TraceError

SEARCHED = 600  # samples of a search; the last fit uses all
PASSES = 3  # over the extensions, at most: one may be worth it only after another
WHITE = 0.8  # of the samples are independent: the residuals have no shape, so no wall is missing


def thinned(trace: Trace) -> Trace:
    """At most SEARCHED samples, evenly taken."""
    return trace[:: max(1, -(-len(trace) // SEARCHED))]


@dataclass(eq=False)
class _Search:
    """What all fits of a trace share, and all candidates so far."""

    trace: Trace
    segments: Segments
    needle: Needle
    tell: Callable[[str], None]
    rule: Rule = field(init=False)
    tried: list[Candidate] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.rule = Rule(self.trace, self.segments)

    def fitted(self, name: str, model: Model, from_these: Sequence[Start]) -> Candidate | None:
        """The model's best fit from any of these; None if none ends."""
        self.tell(name)
        misfit = self.tried[0].fit.misfit if self.tried else Misfit(self.trace, from_these[0].parameters)
        enough = noise_limit(self.trace) if self.tried else 0.0  # K06 itself: always from all starts
        try:
            best = with_pops_moved(best_fit(misfit, model.names, from_these, enough))
            found = candidate(name, model, with_contacts_moved(best))
        except TraceError:
            if not self.tried:
                raise
            return None
        self.tried.append(found)
        return found

    def starts(self, membranes: int, curved: bool, most: int) -> list[Start]:
        """Start values of K06, or of a curved grip, for this number of walls: those with the least errors."""
        walls = starts(self.trace, self.segments, self.needle, membranes, curved)
        found = list(islice(walls, most) if curved else walls)
        if membranes > 1:
            found += islice(rise_starts(self.trace, self.segments, self.needle, membranes, curved), most)
        misfit = Misfit(self.trace, found[0])
        found.sort(key=lambda p: float(np.sum((misfit.forces(p) - self.trace.force) ** 2)))
        return [Start(parameters, blurred=True) for parameters in found[:most]]


def choose(
    trace: Trace,
    segments: Segments,
    needle: Needle,
    membranes: int,
    tell: Callable[[str], None] = lambda _: None,
    *,
    most: int | None = None,
) -> tuple[Candidate, ...]:
    """All models that were tried, the chosen one first. docs/identify.md has the rule.

    most: if given, one membrane fewer and one more (up to this number) are tried, too.
    """
    search = _Search(trace, segments, needle, tell)
    drift = trace.time is not None and any(finding.kind == "drift" for finding in trace.findings)
    plain = search.fitted("K06", Model(membranes, drift=drift), search.starts(membranes, False, 3))
    assert plain is not None
    current = _extended(search, plain)
    if membranes > 1:
        tied = _of_one_tissue(search, current)
        if tied is not current:
            current = _extended(search, tied)
    if most is not None:
        current = _other_number(search, current, most)
    told = {current: search.rule.held_out_error(current), plain: search.rule.held_out_error(plain)}
    rest = [c for c in search.tried if c is not current]
    return tuple(replace(c, held_out=told.get(c)) for c in (current, *rest))


def _extended(search: _Search, current: Candidate) -> Candidate:
    """Adds extensions, one after the other, as long as one is worth it."""
    for _ in range(PASSES):
        before = current
        for extension in extensions(search.needle):
            if not _seen(search.segments, extension, current.model):
                continue
            model = current.model.extended(extension)
            if any(one.model == model for one in search.tried):
                continue  # it was not worth it
            here = current.fit.parameters
            from_these = [Start(model.start(here, weak)) for weak in (True, False)]
            if "tissue.growth" in extension.start:
                fresh = search.starts(model.membranes, True, 2)
                from_these += [replace(one, parameters=model.start(one.parameters)) for one in fresh]
            found = search.fitted(extension.name, model, from_these)
            if found is not None and search.rule.prefers(found, current):
                current = found
        if current is before:
            break
    return current


def _seen(segments: Segments, extension: Extension, model: Model) -> bool:
    """Whether the trace can show an extension that the model has not yet."""
    return not (
        all(name in model.names for name in extension.start)
        or (extension.needs_hold and not segments.holds)
        or (extension.needs_withdrawal and not any(stroke.kind == "out" for stroke in segments.strokes))
        or segments.insertions < extension.needs_insertions
        or (extension.after and extension.after not in model.words)
    )


def _of_one_tissue(search: _Search, current: Candidate) -> Candidate:
    """The same model with one stiffness, friction and thickness for all walls, if the rule prefers it."""
    model = replace(current.model, one_tissue=True)
    from_these = [Start(model.start(current.fit.parameters), blurred=True)]
    if "tissue.growth" in model.names:
        fresh = search.starts(model.membranes, True, 3)
        from_these += [replace(one, parameters=model.start(one.parameters)) for one in fresh]
    found = search.fitted(ONE_TISSUE, model, from_these)
    return found if found is not None and search.rule.prefers(found, current) else current


def _other_number(search: _Search, current: Candidate, most: int) -> Candidate:
    """One membrane fewer, and one more where the residuals still have a shape: the rule decides."""
    count, best = current.model.membranes, current
    if count > 1:
        fewer = replace(current.model, membranes=count - 1, one_tissue=current.model.one_tissue and count > 2)
        from_these = [Start(p, blurred=True) for p in without_a_wall(current.fit, search.segments)]
        from_these += [replace(s, parameters=fewer.start(s.parameters)) for s in search.starts(count - 1, False, 1)]
        found = search.fitted(f"{count - 1} membrane(s)", fewer, from_these)
        if found is not None and search.rule.prefers(found, best):
            best = found
    if count < most and current.effective < WHITE * len(search.trace):
        more = replace(current.model, membranes=count + 1)
        from_these = [Start(p) for p in with_a_wall_more(current.fit)]
        found = search.fitted(f"{count + 1} membranes", more, from_these) if from_these else None
        if found is not None and search.rule.prefers(found, best):
            best = found
    return best
