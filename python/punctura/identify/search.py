"""What all fits of a trace share while its model is chosen."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice, pairwise

import numpy as np

from punctura import Needle
from punctura.identify.criteria import Candidate, Rule, candidate
from punctura.identify.fit import Fit, Misfit, Start, best_fit, fit, in_order
from punctura.identify.model import Extension, Model
from punctura.identify.moves import FEW, noise_limit, with_contacts_moved, with_hops, with_pops_moved
from punctura.identify.parameters import LATE, Parameters
from punctura.identify.start import starts
from punctura.identify.walls import rise_starts
from punctura.trace import Segments, Trace, TraceError

WEIGHTED = 2  # fits, each with the weights that the one before shows
SEARCHED = 600  # samples of a search; the last fit uses all
MOST_SAMPLES, MOVING = 4000, 1000  # of a trace, about; and of its motion, at least, if it has more
MOST_EVALUATIONS = 5000  # of the derivatives: then no further extension, late sensor or wall is tried


def in_means(trace: Trace, segments: Segments) -> Trace:
    """A long trace as means of neighbouring samples, fewer than twice MOST_SAMPLES; the same trace if it is short.

    White noise becomes smaller by the square root of their number, and slow noise stays, so the means tell as much. A
    rest, however long, leaves at least MOVING samples of the motion. A trace that turns without a rest stays as it is:
    the mean around a turn is less deep than the turn, and friction and spring would follow from a wrong depth.
    """
    moving = sum(stroke.end - stroke.start for stroke in segments.strokes if stroke.kind != "hold")
    count = min(len(trace) // MOST_SAMPLES, moving // MOVING)
    whole = [one.kind for one in segments.strokes if one.kind != "hold" or one.end - one.start >= 2 * count]
    turns = any({one, other} == {"in", "out"} for one, other in pairwise(whole))
    return trace.means(count) if count > 1 and not turns else trace


def mean_words(before: Trace, after: Trace) -> tuple[str, ...]:
    """A sentence for a trace of which means are used."""
    if len(after) == len(before):
        return ()
    steps = np.abs(np.diff(after.depth))
    way = float(np.median(steps[steps > 0.5 * np.mean(steps)]))  # of the motion, however long a rest is
    return (
        f"The trace has {len(before)} samples, so the fit is to the {len(after)} means of each "
        f"{len(before) // len(after)} neighbouring ones, {way * 1e3:.2g} mm apart. Samples and noise are those of the "
        "means.",
    )


def thinned(trace: Trace) -> Trace:
    """At most SEARCHED samples, evenly taken."""
    return trace[:: max(1, -(-len(trace) // SEARCHED))]


def weighted(found: Fit) -> Fit:
    """The same fit with the weights that it shows itself, as far as such fits end."""
    for _ in range(0 if found.misfit.trace.depths is None else WEIGHTED):
        try:
            more = fit(found.misfit.with_depth_error(found.parameters), found.free.names, found.parameters)
        except TraceError:
            break
        found = replace(more, others=found.others)
    return found


@dataclass(eq=False)
class Search:
    """What all fits of a trace share, and all candidates so far."""

    trace: Trace
    segments: Segments
    needle: Needle
    report: Callable[[str], None]
    stated: Mapping[str, float] = field(default_factory=dict)  # lag and delay of the sensor, s
    rule: Rule = field(init=False)
    tried: list[Candidate] = field(default_factory=list)
    refused: list[Model] = field(default_factory=list)  # with values that no rig has

    def __post_init__(self) -> None:
        self.rule = Rule(self.trace, self.segments)

    @property
    def ended(self) -> bool:
        """Whether the search has taken so long that it tries no further models. A model that explains ends it early."""
        return bool(self.tried) and self.tried[0].fit.misfit.evaluations > MOST_EVALUATIONS

    def fitted(self, name: str, model: Model, from_these: Sequence[Start], hops: bool = False) -> Candidate | None:
        """The model's best fit from any of these, and with hops around its end; None if none ends."""
        self.report(name)
        from_these = [replace(one, parameters=self._sensed(one.parameters, model)) for one in from_these]
        misfit = self.tried[0].fit.misfit if self.tried else self._misfit(from_these[0].parameters)
        enough = noise_limit(self.trace)
        if not self.tried or any(one.fit.weighted_rmse < enough for one in self.tried):
            enough = 0.0  # from all starts: K06 itself, and what must leave less than noise to be better
        try:
            best = best_fit(misfit, model.names, from_these, enough)
            best = best if self.tried else weighted(best)
            best = with_pops_moved(with_hops(best, FEW) if hops and not self.ended else best)
            found = candidate(name, model, in_order(with_contacts_moved(best)))
        except TraceError:
            if not self.tried:
                raise
            return None
        self.tried.append(found)
        return found

    def _misfit(self, parameters: Parameters) -> Misfit:
        return Misfit(self.trace, parameters, zero=self.rule.air.zero)

    def _sensed(self, parameters: Parameters, model: Model) -> Parameters:
        """With the lag and the delay that are stated; with none if they are not free either."""
        known = {name: self.stated.get(name, 0.0) for name in LATE if name not in model.late}
        return parameters.with_values(known)

    def starts(self, membranes: int, curved: bool, most: int) -> list[Start]:
        """Start values of K06, or of a curved grip, for this number of walls: those with the least errors."""
        walls = starts(self.trace, self.segments, self.needle, membranes, curved)
        found = list(islice(walls, most) if curved else walls)
        if membranes > 1:
            found += islice(rise_starts(self.trace, self.segments, self.needle, membranes, curved), most)
        misfit = self._misfit(found[0])
        found.sort(key=lambda p: float(np.sum((misfit.forces(p) - self.trace.force) ** 2)))
        kept: list[Parameters] = []
        for one in found:
            if len(kept) < most and not any(np.allclose(one.vector(), other.vector()) for other in kept):
                kept.append(one)
        return [Start(parameters, blurred=True) for parameters in kept]


def seen(segments: Segments, extension: Extension, model: Model) -> bool:
    """Whether the trace can show an extension that the model has not yet."""
    return not (
        all(name in model.names for name in extension.start)
        or (extension.needs_hold and not segments.holds)
        or (extension.needs_withdrawal and not any(stroke.kind == "out" for stroke in segments.strokes))
        or segments.insertions < extension.needs_insertions
        or (extension.after and extension.after not in model.words)
    )
