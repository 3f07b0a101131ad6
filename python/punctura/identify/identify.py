"""Identification of a trace: from force against depth to membranes with intervals."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from punctura import Needle, Scene
from punctura._core import longest_name
from punctura.files.names import as_text
from punctura.identify.air_noise import AirNoise
from punctura.identify.causes import Cause
from punctura.identify.choose import choose
from punctura.identify.criteria import Candidate
from punctura.identify.depth_noise import noise_not_used, with_quiet_depth
from punctura.identify.doubts import Doubts, doubts
from punctura.identify.drifting import slow_misfit
from punctura.identify.explained import explained
from punctura.identify.fit import Fit, Misfit, Start, best_fit, in_order
from punctura.identify.growing_noise import with_growing_noise
from punctura.identify.intervals import Estimate, estimates, with_subtracted
from punctura.identify.late_sensor import late_words, not_told_apart
from punctura.identify.maybe_walls import maybe_walls
from punctura.identify.model import Model
from punctura.identify.moves import with_contacts_moved, with_pops_moved
from punctura.identify.moving_tissue import moving_tissue
from punctura.identify.needle_tolerance import doubt_of_needle, with_tolerance
from punctura.identify.noise import effective_samples
from punctura.identify.parameters import LATE, Parameters
from punctura.identify.profile import BetterPoint
from punctura.identify.records import IdentificationRecord
from punctura.identify.rig import UNKNOWN, Rig, RigValue, check
from punctura.identify.scene import scene_of
from punctura.identify.search import in_means, mean_words, thinned, weighted
from punctura.identify.slow_noise import with_slow_noise
from punctura.identify.smeared_force import smeared_rig, smeared_walls, smeared_words, without_smeared
from punctura.identify.uncertainty import Uncertainty
from punctura.identify.verdict import verdicts
from punctura.one_thread import one_thread
from punctura.trace import Segments, Trace, TraceError, segment

MOST_MEMBRANES = 6
BETTER_OPTIMA = 5  # that the intervals may meet, each one better than the one before; then they end as they are
MORE_OPTIMA = Cause(
    "more_optima",
    0.0,
    "The search for the intervals met parameters that explain the trace better than the fit, also after new fits from "
    "there. Do not trust the values: the trace holds too little for so many parameters, or the model is wrong",
)
NO_CONTACT = (
    "no contact: a zero of the sensor and noise of {:.2g} N explain the force as well as a wall does, so there is no "
    "law to tell. Insert deeper, or choose another column for the force"
)
ENDED = (
    "The search for a model ended before it had tried all: no short one explains the trace. State what is known, such "
    "as the number of walls (--membranes), the lag of the sensor or the noise of the depth (--rig)."
)


@dataclass(frozen=True, eq=False)
class Identification:
    """Membranes identified from a trace. `estimates` have the 95 % intervals, `verdicts` say what cannot be told."""

    trace: Trace  # that was fitted: of a force that is smoothed over k samples each k-th, of a long trace means
    segments: Segments  # its contact, strokes and pops
    fit: Fit  # the best one
    estimates: tuple[Estimate, ...]
    verdicts: tuple[str, ...]
    candidates: tuple[Candidate, ...]  # the chosen model first
    effective_samples: float  # how many independent samples the noise leaves
    doubts: Doubts  # all that says that the model is not the whole truth
    rig: tuple[RigValue, ...] = ()  # the errors of the rig that the fit and its intervals take into account

    @property
    def parameters(self) -> Parameters:
        """The values of all parameters."""
        return self.fit.parameters

    @property
    def peak(self) -> float:
        """The greatest measured force, N."""
        return float(np.max(np.abs(self.trace.force)))

    @property
    def scene(self) -> Scene:
        """The identified membranes as a scene. Its coupling has at least 1 N s/m of damping."""
        return scene_of(self.parameters, as_text(self.trace.source)[:longest_name] or "identified")

    @property
    def extensions(self) -> tuple[str, ...]:
        """The chosen extensions of K06."""
        return self.candidates[0].extensions

    def as_dict(self) -> IdentificationRecord:
        """Everything as plain values for JSON: SI units, `rmse_N` among the numbers."""
        chosen, needle = self.candidates[0], self.parameters.needle
        return {
            "trace": self.trace.source,
            "samples": len(self.trace),
            "effective_samples": self.effective_samples,
            "membranes": len(self.parameters.membranes),
            "extensions": list(self.extensions),
            "rmse_N": self.fit.rmse,
            "rmse_share_of_peak": self.fit.rmse / self.peak,
            "held_out_rmse_N": chosen.held_out,
            "needle": {"diameter_m": needle.diameter, "tip_angle_rad": needle.tip_angle},
            "parameters": [
                {"name": e.name, "value": e.value, "low": e.low, "high": e.high, "unit": e.unit,
                 "identifiable": e.identifiable}
                for e in self.estimates
            ],
            "correlations": Uncertainty(self.fit).correlations.round(4).tolist(),
            "rig": [{"name": r.name, "value": r.value, "unit": r.unit, "stated": r.stated} for r in self.rig],
            "findings": [{"kind": f.kind, "text": f.text, "repaired": f.repaired} for f in self.trace.findings],
            "explained": self.doubts.as_dict(),
            "verdicts": list(self.verdicts),
            "models": [
                {"name": c.name, "extensions": list(c.extensions), "rmse_N": c.fit.rmse, "parameters": len(c.fit.u),
                 "membranes": c.model.membranes, "aicc": worth.aic if np.isfinite(worth.aic) else None,
                 "bic": worth.bic, "held_out_rmse_N": c.held_out}
                for c in self.candidates for worth in [c.worth(chosen.effective)]
            ],
        }  # fmt: skip


def identify(
    trace: Trace,
    needle: Needle,
    membranes: int | Literal["auto"] = "auto",
    report: Callable[[str], None] = lambda _: None,
    rig: Rig = UNKNOWN,
) -> Identification:
    """Identifies membranes of a trace that was made with this needle.

    membranes: their number; "auto" begins with that of the pops, and tries one fewer and one more. report: gets a word
    about each step. rig: what is known of its sensors. Raises TraceError for a trace with a severe finding, and if no
    fit succeeds or the needle touches nothing; ConfigurationError for a rig that cannot be; ModuleNotFoundError.
    """
    check(rig, needle)
    severe = [finding for finding in trace.findings if finding.severe]
    if severe:
        raise TraceError(f"{trace.source or 'the trace'}: {severe[0]}")
    with one_thread("punctura.identify"):
        return _identified(trace, needle, membranes, report, rig)


def _identified(
    trace: Trace, needle: Needle, membranes: int | Literal["auto"], report: Callable[[str], None], rig: Rig
) -> Identification:
    given, (few, filtered) = trace, without_smeared(trace, segment(trace))
    smooth, words = len(few) < len(given), smeared_words(given, few)
    quiet, noise = with_quiet_depth(few, rig.depth_noise)
    known = [RigValue("depth_noise", noise, "m", rig.depth_noise is not None)] if noise else []
    trace = in_means(quiet, segment(quiet))
    words += mean_words(quiet, trace)
    segments = segment(trace)
    few = thinned(trace)
    all_used = len(few) == len(trace)
    count, most = (membranes, None) if isinstance(membranes, int) else (_pops(trace, segments), MOST_MEMBRANES)
    choice = choose(few, segments if all_used else segment(few), needle, count, report, most=most, rig=rig)
    if not choice.search.rule.touches(choice.current):
        raise TraceError(f"{trace.source or 'the trace'}: {NO_CONTACT.format(float(np.std(trace.force)))}")
    found: tuple[Estimate, ...] | None = None
    better: list[tuple[Model, Parameters]] = []
    air = choice.search.rule.air if all_used else AirNoise(trace, segments)
    least, more = np.inf, False  # the squares of the last fit, N^2; whether there are better optima still
    while found is None:
        few_fit = plain = choice.current.fit
        points = [point for model, point in better if model == choice.current.model]
        if not all_used or trace.depths is not None:
            report("all samples")
            plain = _with_all_samples(trace, few_fit, points)
        plain = with_growing_noise(trace, segments, plain)
        report("intervals")
        others = (few_fit.parameters, *few_fit.others)
        holds = explained(trace, segments, plain, air).ok  # otherwise no search makes the intervals hold
        final = with_slow_noise(plain, air, points) if holds else plain
        try:
            found = estimates(final, others, outwards=holds)
        except BetterPoint as point:
            if len(better) == BETTER_OPTIMA or not final.sse < least:
                found, more = estimates(final, others, stops=False, outwards=holds), True
                break
            report("a better optimum")
            least = final.sse
            better.append((choice.current.model, point.parameters))
            choice.again(point.parameters)
    wide = smeared_rig(rig, filtered) if filtered else rig
    if wide.values():
        report("tolerances of the rig")
        found = with_tolerance(found, final, wide)
    found = smeared_walls(found, trace) if smooth else found
    known += [one for one in rig.values() if trace.time is not None or one.unit != "s"]
    late = {one.name: one for one in found if one.name in LATE}
    known += [RigValue(name, one.value, one.unit, False) for name, one in late.items()]
    effective = effective_samples(plain.residuals, len(plain.u))
    doubt = doubts(trace, segments, plain, choice.current.extensions, air)
    moving = moving_tissue(trace, choice.plain.fit, choice.current.fit, doubt.explained)
    doubt = doubt if moving is None else doubt.by(moving)
    whitened = final.misfit.whitening is not None
    of_few = few_fit, choice.search.rule.air, doubt.explained.ok
    advice = verdicts(found, trace, segments, *of_few, whitened)
    advice = (
        *words,
        *noise_not_used(trace, rig.depth_noise),
        *late_words(late, trace, rig),
        *not_told_apart(choice.search, choice.current),
        *advice,
    )
    searched = [MORE_OPTIMA] if more else []
    maybe = maybe_walls(final, bool(segments.pops))
    doubt = doubt.beside(*doubt_of_needle(found, needle, rig), *slow_misfit(*of_few), *maybe, *searched)
    advice = (*doubt.sentences, *advice, *([ENDED] if choice.search.ended else []))
    found = with_subtracted(found, trace)
    return Identification(trace, segments, final, found, advice, choice.candidates, effective, doubt, tuple(known))


def _with_all_samples(trace: Trace, few: Fit, better: Sequence[Parameters]) -> Fit:
    """The fit of all samples. better: points that are better than such a fit of this model was.

    Fewer samples smear a pop, so a wrong optimum can look slightly better: all nearly equal ends begin again. The
    weights of the search are those of K06 with the first number of walls; these are of this model.
    """
    misfit = Misfit(trace, few.parameters, zero=few.misfit.zero).with_depth_error(few.parameters)
    ends = [Start(parameters) for parameters in (few.parameters, *few.others, *better)]
    try:
        best = weighted(best_fit(misfit, few.free.names, ends))
        return in_order(with_contacts_moved(with_pops_moved(best)))
    except TraceError:
        if len(few.misfit.trace) < len(trace):
            raise
        return few


def _pops(trace: Trace, segments: Segments) -> int:
    """One membrane for each pop of the first insertion."""
    pops = sum(int(trace.strokes[pop.start] == 0) for pop in segments.pops)
    return min(max(pops, 1), MOST_MEMBRANES)
