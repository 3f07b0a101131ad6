"""What is said when a model does not explain its trace, or explains it by the wrong means."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np

from punctura.identify.air_noise import AirNoise
from punctura.identify.causes import Cause, both_ways, causes, way_out
from punctura.identify.depth_noise import steady_noise
from punctura.identify.explained import MATTERS, SURE, Explained, explained
from punctura.identify.fit import Fit
from punctura.identify.parameters import ZERO
from punctura.identify.records import ExplainedRecord
from punctura.trace import Segments, Trace
from punctura.trace.ends import NO_AIR, without_zero

WEAKER = frozenset({"set", "cutting"})  # extensions of K06 with which the way out is weaker
IN_AIR = 0.8  # of the samples before the contact: nearer, a soft wall may hide in the noise
IMPOSSIBLE = ("air_steps", NO_AIR, "wall_in_air", "wall_beyond")  # what no cause in the tissue explains
NOT_EXPLAINED = "not explained: see below"  # behind the error of a model that is not the whole truth
TAKEN_UP = 2.0  # times the slow noise that a fit leaves: it is on both ways and in the zero, and a fit takes it up
UNEQUAL = ("barbs", "asymmetric_way_out", "same_both_ways")  # causes


@dataclass(frozen=True, eq=False)
class Doubts:
    """Whether the model explains the trace, and what could explain what it leaves."""

    explained: Explained  # what the residuals say
    causes: tuple[Cause, ...]  # the best one first

    @property
    def whole(self) -> bool:
        """Whether nothing is said against the model. All results give this as `explained`."""
        return not self.sentences

    @property
    def sentences(self) -> tuple[str, ...]:
        """One sentence or two for each doubt."""
        whole = self.explained.sentence()
        return (*([whole] if whole else []), *(f"{cause}." for cause in self.causes))

    def by(self, cause: Cause) -> Doubts:
        """The same doubts with this cause, from which all else in the tissue may follow."""
        return replace(self, causes=(cause, *(one for one in self.causes if one.kind in IMPOSSIBLE)))

    def beside(self, *causes: Cause) -> Doubts:
        """The same doubts, and these, which the residuals do not show."""
        return replace(self, causes=(*self.causes, *causes))

    def as_dict(self) -> ExplainedRecord:
        """As plain values for JSON, SI."""
        assessment = self.explained
        return {
            "explained": self.whole, "left_N": assessment.left, "noise_N": assessment.noise,
            "noise_is_of_air": assessment.air, "runs": assessment.runs, "runs_of_noise": assessment.runs_of_noise,
            "not_explained": [
                {"way": place.kind, "insertion": place.insertion, "shallow_m": place.shallow, "deep_m": place.deep,
                 "force_N": place.force, "share": place.share}
                for place in assessment.places
            ],
            "causes": [{"kind": one.kind, "share": one.share, "text": one.text} for one in self.causes],
        }  # fmt: skip


def doubts(
    trace: Trace, segments: Segments, fit: Fit, extensions: Collection[str], air: AirNoise | None = None
) -> Doubts:
    """The doubts about the fit of all samples with these extensions of K06. air: of the same samples."""
    assessment = explained(trace, segments, fit, air)
    found = causes(trace, segments, fit, assessment)
    shaking = steady_noise(trace.depth)
    if not assessment.ok and shaking * fit.parameters.get("coupling_stiffness") > assessment.noise:
        text = (
            f"The depth has a noise of {shaking * 1e6:.2g} um, which the spring between needle and tissue turns into "
            "force. To tell: smooth the depth, or take it from the robot's command"
        )
        found = (Cause("depth_noise", 0.0, text),)  # all else may follow from it
    if not any(one.kind in UNEQUAL for one in found):
        found = (*_asymmetry(trace, segments, fit, assessment, extensions), *found)
    in_air = _air_steps(trace) or _no_air(trace) or _wall_in_air(segments, fit, assessment)
    return Doubts(assessment, (*in_air, *_walls_beyond(trace, fit), *found))


def _walls_beyond(trace: Trace, fit: Fit) -> tuple[Cause, ...]:
    """Walls that a search has left where the needle never was."""
    surfaces, deepest = fit.parameters.membranes[:, 0], float(trace.depth.max())
    beyond = [f"membrane[{i}]" for i in np.flatnonzero(surfaces > deepest)]
    if not beyond:
        return ()
    text = (
        f"The needle never came to {', '.join(beyond)}, and went down to {deepest * 1e3:.4g} mm: the trace shows "
        f"nothing there. State a number of walls (--membranes {len(surfaces) - len(beyond)})"
    )
    return (Cause("wall_beyond", 0.0, text),)


def _air_steps(trace: Trace) -> tuple[Cause, ...]:
    """A force of the rig that its air shows, and that no model has."""
    if not any(finding.kind == "air_steps" for finding in trace.findings):
        return ()
    text = (
        "The force in air steps where the needle begins to move, and no friction of the slide that is known here "
        "explains it (see the finding): walls and values may be its doing. The intervals do not hold"
    )
    return (Cause("air_steps", 0.0, text),)


def _no_air(trace: Trace) -> tuple[Cause, ...]:
    """Friction at both ends: what is in front of the first contact is not known."""
    if not without_zero(trace):
        return ()
    text = (
        "The zero of the force is not known: at both ends of the trace there may be friction (see the finding). "
        "Offset, friction of the slide and walls in front of the first contact may stand for it, and their intervals "
        "do not hold; the others hold if this friction is alike on both ways. To tell: begin and end in air, at rest"
    )
    return (Cause(NO_AIR, 0.0, text),)


def _wall_in_air(segments: Segments, fit: Fit, assessment: Explained) -> tuple[Cause, ...]:
    """A wall that the model has where the trace is in air: there, only the zero of the sensor and the rig change it."""
    tissue = fit.misfit.forces(fit.parameters.with_values(dict.fromkeys(ZERO, 0.0)))
    if segments.contact is not None:
        there, where = tissue[: int(IN_AIR * segments.contact) + 1], "in front of the contact"
    elif segments.exit is not None:
        there, where = tissue[len(tissue) - int(IN_AIR * (len(tissue) - segments.exit)) :], "behind the last way out"
    else:
        return ()
    force = float(np.max(np.abs(there)))
    if force < max(assessment.noise, MATTERS * assessment.peak):
        return ()
    text = (
        f"The model has {force:.2g} N of tissue {where}, where the needle is in air: such a wall is a change of the "
        "sensor's zero or a force of the rig, and the others follow from it. The intervals do not hold. To tell: let "
        "the sensor warm up, move the needle over the same depths without tissue, and repeat the insertion"
    )
    return (Cause("wall_in_air", 0.0, text),)


def _asymmetry(
    trace: Trace, segments: Segments, fit: Fit, assessment: Explained, extensions: Collection[str]
) -> tuple[Cause, ...]:
    """What the two ways themselves show: the model may have explained it by a wall or a tail that is not there."""
    ways = both_ways(trace, segments, fit)
    if ways is None or not ways.uneven or (ways.ratio < 1 and WEAKER & set(extensions)):
        return ()
    slow = fit.noise.slow_and_white()[0] if assessment.ok else 0.0
    if abs(ways.difference) < SURE * max(TAKEN_UP * slow, assessment.blocks.noise):
        return ()
    kind, text = way_out(ways.ratio, ways.growth)
    hidden = ". The model explains it by other means: do not trust its walls" if assessment.ok else ""
    return (Cause(kind, 0.0, text + hidden),)
