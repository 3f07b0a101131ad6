"""How well K06 and its rivals predict what they did not see: a second insertion, or another trace of a folder."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, TypedDict

import numpy as np
from numpy.typing import NDArray

from punctura import Needle
from punctura.identify import Identification, Parameters, identify
from punctura.identify.depth_noise import with_quiet_depth
from punctura.identify.fit import Misfit
from punctura.identify.rig import UNKNOWN, Rig
from punctura.one_thread import one_thread
from punctura.rivals.fit import RivalFit, fit_rival
from punctura.rivals.kinds import kinds
from punctura.rivals.layers import path_of, resistance
from punctura.trace import Segments, Trace, TraceError, segment

Array = NDArray[np.float64]

REPEAT = "repeat"  # no model: what was measured before, at the same depth
FEWEST = 2  # traces of a folder


@dataclass(frozen=True)
class Prediction:
    """A model's force where it was not fitted. SI."""

    name: str
    title: str
    trace: str  # the trace that was predicted
    rmse: float  # N
    rmse_share: float  # of the greatest force there
    force: Array = field(repr=False)  # (n,), N


class PredictionRecord(TypedDict):
    """A prediction as JSON."""

    name: str
    title: str
    trace: str
    rmse_N: float
    rmse_share_of_peak: float


@dataclass(frozen=True)
class Fitted:
    """K06 and the rivals, fitted to a trace or a part of one."""

    trace: Trace
    segments: Segments
    found: Identification
    rivals: tuple[RivalFit, ...]
    rig: Rig = UNKNOWN

    @property
    def contact(self) -> float:
        """The depth of the first contact, m. Raises TraceError."""
        if self.segments.contact is None:
            raise TraceError(f"{self.trace.source}: has no air before contact, so it cannot be laid over another trace")
        return float(self.trace.depth[self.segments.contact])


def fitted(
    trace: Trace,
    needle: Needle,
    membranes: int | Literal["auto"],
    report: Callable[[str], None],
    rig: Rig = UNKNOWN,
) -> Fitted:
    """Fits K06, as identify() chooses it, and all rivals. Raises TraceError; ConfigurationError, as identify()."""
    found = identify(trace, needle, membranes, report, rig)
    trace, segments = found.trace, found.segments  # without the noise of the depth, for all models
    fits = []
    with one_thread("punctura.rivals"):
        for kind in kinds().values():
            report(kind.title)
            fits.append(fit_rival(kind, trace, segments))
    return Fitted(trace, segments, found, tuple(fits), rig)


def second_insertion(
    trace: Trace,
    needle: Needle,
    membranes: int | Literal["auto"] = "auto",
    report: Callable[[str], None] = lambda _: None,
    rig: Rig = UNKNOWN,
) -> tuple[Prediction, ...]:
    """Fits the first insertion and predicts the second one at the same place, the best prediction first.

    rig: of both insertions. Raises TraceError for a trace with one insertion; ConfigurationError, as identify().
    """
    held = trace.strokes == 1
    if not held.any():
        raise TraceError(
            f"{trace.source or 'the trace'}: has one insertion; --hold-out predicts a second one at the same place. "
            "Record one, or give a folder of traces"
        )
    first = trace[trace.strokes == 0]
    known = fitted(replace(first, findings=()), needle, membranes, report, rig)
    both = trace[trace.strokes <= 1]
    later = both.strokes == 1
    return _ranked(trace.source, both.force[later], _forces(known, both, 0.0, later))


def another_trace(all_of_them: Mapping[str, Fitted]) -> tuple[Prediction, ...]:
    """Predicts each trace from all others: the mean of their models, laid over its contact.

    Raises TraceError for fewer than two traces, and for one without air.
    """
    if len(all_of_them) < FEWEST:
        raise TraceError(
            f"--hold-out needs at least {FEWEST} traces that could be fitted, and here are {len(all_of_them)}"
        )
    found: list[Prediction] = []
    for name, held in all_of_them.items():
        every = np.ones(len(held.trace), bool)
        forces = [_forces(one, held.trace, held.contact - one.contact, every)
                  for other, one in all_of_them.items() if other != name]  # fmt: skip
        means = {key: (each[0], np.mean([one[key][1] for one in forces], axis=0)) for key, each in forces[0].items()}
        found += _ranked(name, held.trace.force, means)
    return tuple(found)


def _forces(known: Fitted, trace: Trace, shift: float, used: NDArray[np.bool_]) -> dict[str, tuple[str, Array]]:
    """Title and force (n,), N, of each model along a trace whose depths are greater by `shift`, m."""
    quiet = with_quiet_depth(trace, known.rig.depth_noise)[0]
    depths = None if quiet.depths is None else quiet.depths - shift
    at = replace(quiet, depth=quiet.depth - shift, depths=depths)
    p: Parameters = known.found.parameters
    found = {"k06": (_title(known.found), Misfit(at, p).with_depth_error(p).forces(p)[used])}
    path = path_of(at, segment(at))
    found |= {one.name: (one.title, resistance(one.layers, path)[used]) for one in known.rivals}
    return found | {REPEAT: ("no model: as measured before", _repeated(known.trace, at)[used])}


def _title(found: Identification) -> str:
    return f"K06 with {', '.join(found.extensions)}" if found.extensions else "K06"


def _repeated(seen: Trace, trace: Trace) -> Array:
    """The force that was measured at the nearest depth on the same way, N: the median of a hundredth of the way."""
    force = np.zeros(len(trace))
    ways = [_inward(one) for one in (seen, trace)]
    edges = np.linspace(float(seen.depth.min()), float(seen.depth.max()), 101)
    middle = 0.5 * (edges[1:] + edges[:-1])
    for inward in (True, False):
        there, here = ways[0] == inward, ways[1] == inward
        if not there.any() or not here.any():
            continue
        place = np.clip(np.digitize(seen.depth[there], edges) - 1, 0, 99)
        filled = [i for i in range(100) if (place == i).any()]
        typical = [float(np.median(seen.force[there][place == i])) for i in filled]
        force[here] = np.interp(trace.depth[here], middle[filled], typical)
    return force


def _inward(trace: Trace) -> NDArray[np.bool_]:
    """Where the needle goes in or rests after that (n,)."""
    inward = np.ones(len(trace), bool)
    for stroke in segment(trace).strokes:
        if stroke.kind == "out":
            inward[stroke.start : stroke.end] = False
    return inward


def _ranked(trace: str, measured: Array, forces: Mapping[str, tuple[str, Array]]) -> tuple[Prediction, ...]:
    peak = max(float(np.max(np.abs(measured))), 1e-300)
    found = []
    for name, (title, force) in forces.items():
        rmse = float(np.sqrt(np.mean((force - measured) ** 2)))
        found.append(Prediction(name, title, trace, rmse, rmse / peak, force))
    return tuple(sorted(found, key=lambda one: one.rmse))


def records(found: Sequence[Prediction]) -> list[PredictionRecord]:
    """The predictions as plain values, SI."""
    return [
        {"name": one.name, "title": one.title, "trace": one.trace, "rmse_N": one.rmse,
         "rmse_share_of_peak": one.rmse_share}
        for one in found
    ]  # fmt: skip


def means(found: Sequence[Prediction]) -> list[PredictionRecord]:
    """The mean of each model over the traces, the best first. The title of K06 is its own: extensions differ."""
    found_means: list[PredictionRecord] = []
    for name in dict.fromkeys(one.name for one in found):
        of_it = [one for one in found if one.name == name]
        title = of_it[0].title if len({one.title for one in of_it}) == 1 else "K06 with what each trace asks for"
        found_means.append({"name": name, "title": title, "trace": f"{len(of_it)} traces",
                     "rmse_N": float(np.mean([one.rmse for one in of_it])),
                     "rmse_share_of_peak": float(np.mean([one.rmse_share for one in of_it]))})  # fmt: skip
    return sorted(found_means, key=lambda one: one["rmse_N"])


def in_words(what: str, rows: Sequence[PredictionRecord]) -> str:
    """One line a model, for a reader."""
    width = max(len(one["title"]) for one in rows)
    lines = [f"{one['title']:{width}}  {one['rmse_N']:10.4g} N  {100 * one['rmse_share_of_peak']:6.2f} % of the peak"
             for one in rows]  # fmt: skip
    return "\n".join([what, *(f"  {line}" for line in lines)])
