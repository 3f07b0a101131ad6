"""Recognises what is wrong or missing in a trace, and names it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from punctura.trace.air import above_air, baseline, slope
from punctura.trace.ends import NO_AIR, NOISES, SMALL, rubbed
from punctura.trace.rig_force import with_friction_at_ends, without_rig_force
from punctura.trace.samples import (
    coarse_force,
    gaps,
    nothing_seen,
    smoothed,
    with_depth_between,
    without_cut_off,
    without_floor,
    without_spikes,
)
from punctura.trace.segment import Segments, Stroke, segment, way_to_tissue
from punctura.trace.trace import Finding, Trace
from punctura.trace.turns import noise_of

Array = NDArray[np.float64]

# An insertion outside these bounds, from microneedles to trocars, can point to a wrong unit.
DEPTHS = (1e-5, 0.5)  # m, range of the depth
FORCES = (2e-5, 1000.0)  # N, greatest force
_FASTEST, _SLOWEST = 0.1, 2e-5  # m/s
_BACK, _JUMP = 0.5, 20.0  # of the range of the depth, and times the usual step: no needle goes back like that


def examine(trace: Trace) -> Trace:
    """The trace with its findings. A reversed sign and an offset are repaired, and the findings say so."""
    nothing = nothing_seen(trace)
    if nothing:
        return replace(trace, findings=(*trace.findings, *nothing))
    trace, found = without_spikes(trace)
    found += coarse_force(trace)
    trace, held = with_depth_between(trace)
    found += held
    if trace.depth[0] - trace.depth.min() > 2 * (trace.depth.max() - trace.depth[0]):
        if _only_withdrawn(trace.force):
            return replace(trace, findings=(*trace.findings, *found, _NO_INSERTION))
        trace = replace(trace, depth=-trace.depth)
        found.append(Finding("reversed_depth", "the depth falls while the needle goes in; its sign is turned", True))
    trace, turned = _with_sign(trace)
    trace, of_rig = without_rig_force(trace)
    found += [*turned, *of_rig]
    segments = segment(trace)
    going_in = next((stroke for stroke in segments.strokes if stroke.kind == "in"), None)
    air, where = np.empty(0), "before contact"
    ends = rubbed(trace, segments.contact, segments.exit)
    if ends is not None:
        trace, told = _without_middle(trace, *ends)
        found.append(told)
    elif going_in is not None and segments.contact is not None and segments.contact >= going_in.start:
        air = trace.force[going_in.start : segments.contact + 1]
    elif segments.exit is not None:
        air, where = trace.force[segments.exit :], "after the needle has left the tissue"
    if len(air):
        level, height = float(np.median(air)), float(np.max(np.abs(trace.force - np.median(air))))
        if abs(level) > max(SMALL * height, 3 * noise_of(trace.force)):
            trace = replace(trace, force=trace.force - level)
            segments = segment(trace)
            found.append(Finding("offset", f"the force is {level:.3g} N {where}; this is subtracted", True))
    found += [
        *_stacked(trace),
        *_units(trace),
        *gaps(trace),
        *smoothed(*segments.air(trace.force)),
        *(_drift(trace, segments) if ends is None else ()),
    ]
    found += [*_depth_axis(trace, segments), *_missing(trace, segments)]
    trace, floor = without_floor(trace, segments)
    trace, limit = without_cut_off(trace)
    return replace(trace, findings=(*trace.findings, *found, *floor, *limit))


_NO_INSERTION = Finding(
    "no_insertion",
    "the depth falls all the way, and the force of its beginning goes: a withdrawal alone; record the insertion, too. "
    "If the depth counts down while the needle goes in, begin in air, where the force is zero",
    severe=True,
)


def _only_withdrawn(force: Array) -> bool:
    """Whether a force (n,), N, that is measured on one way ends in air, and does not begin there.

    Or it is let go at the beginning: an insertion has little force there, and its force changes later.
    """
    begin, soon, end = (baseline(part) for part in (force, force[len(force) // 4 :], force[::-1]))
    height = float(np.max(np.abs(force)))
    let_go = abs(begin) > 0.5 * height and abs(soon - begin) > 0.5 * abs(end - begin) > 4 * noise_of(force)
    return let_go or abs(end) < max(SMALL * height, 2 * noise_of(force)) < 0.3 * abs(begin)


def _with_sign(trace: Trace) -> tuple[Trace, list[Finding]]:
    """The trace whose force is positive while the needle goes in, and what is said of it."""
    segments = segment(trace)
    touching = way_to_tissue(trace, segments.strokes)
    if touching is None or not _pushed(trace.force[_inward(trace, segments, touching)]):
        return trace, []
    text = "the force is negative while the needle goes in; its sign is turned"
    return replace(trace, force=-trace.force), [Finding("reversed_sign", text, True)]


def _inward(trace: Trace, segments: Segments, touching: Stroke) -> NDArray[np.int64]:
    """The samples of the way in up to the tissue; of a needle that turns before, all on its ways in to the deepest one.

    On a way out, tissue that the needle is in from the beginning pulls.
    """
    begin = next(stroke for stroke in segments.strokes if stroke.kind == "in").start
    if not any(stroke.kind == "out" and begin < stroke.start < touching.end for stroke in segments.strokes):
        return np.arange(begin, touching.end)
    deepest = int(np.argmax(trace.depth))
    ways = [one for one in segments.strokes if one.kind == "in" and one.start <= max(deepest, touching.start)]
    return np.concatenate([np.arange(one.start, one.end) for one in ways])


def _pushed(force: Array) -> bool:
    """Whether the force of an insertion (n,), N, is that of the tissue on the needle: negative."""
    calm = above_air(force)
    return bool(-calm.min() > 2 * calm.max())


def _units(trace: Trace) -> Iterator[Finding]:
    span, peak = float(np.ptp(trace.depth)), float(np.max(np.abs(trace.force)))
    peak = 0.0 if np.ptp(trace.force) == 0 else peak
    for what, value, unit, (least, most) in (("depth", span, "m", DEPTHS), ("force", peak, "N", FORCES)):
        if value == 0:
            text = f"the {what} is the same in every sample; name another column (--column {what}=NAME)"
            yield Finding("constant", text, severe=True)
        elif not least <= value <= most:
            factor = "1000 times too large" if value > most else "1000 times too small"
            name = "range of the depths" if what == "depth" else "greatest force"
            other = "or this is another test than the insertion of a needle"
            text = f"the {name} is {value:.3g} {unit}, perhaps {factor}, {other}"
            yield Finding("wrong_unit", f"{text}; if the unit is wrong, state it (--unit {what}=UNIT)")


def _stacked(trace: Trace) -> Iterator[Finding]:
    """Several insertions after each other, whose withdrawals are not there: the next one may be at another place."""
    steps = np.diff(trace.depth)
    if not steps.any():
        return
    far, usual = _BACK * float(np.ptp(trace.depth)), float(np.median(np.abs(steps[steps != 0])))
    back = np.flatnonzero((steps < -far) & (np.abs(steps) > _JUMP * usual))
    if trace.time is not None:  # a pause of the recording, in which the needle came out, is a gap
        pace = np.diff(trace.time)
        back = back[pace[back] < _JUMP * float(np.median(pace))]
    each = np.split(trace.depth, back + 1)
    if len(back) and not (steps > far).any() and min(float(np.ptp(one)) for one in each) > far:
        where = f"{len(back)} times, first" if len(back) > 1 else "once,"
        text = f"the depth jumps back {where} by {-steps[back[0]] * 1e3:.3g} mm behind sample {int(back[0]) + 1}"
        advice = "as where several insertions stand after each other. Give each a file of its own, and their folder"
        yield Finding("stacked", f"{text}, {advice}", severe=True)


def _without_middle(trace: Trace, begin: float, end: float) -> tuple[Trace, Finding]:
    """The trace whose zero is between these levels of both ends, N, and what is said of it."""
    middle = 0.0 if end <= 0 <= begin else 0.5 * (begin + end)
    said = f"the middle, {middle:+.3g} N, is subtracted" if middle else "nothing is subtracted"
    text = (
        f"the force is {begin:+.3g} N at the beginning and {end:+.3g} N at the end, and drifts at neither: friction of "
        "tissue that the needle is in from the beginning, or of the slide, or a zero that has jumped. So no air shows "
        f"the zero, and {said}. Begin and end in air, at rest: it tells them apart"
    )
    return with_friction_at_ends(replace(trace, force=trace.force - middle)), Finding(NO_AIR, text)


def _drift(trace: Trace, segments: Segments) -> Iterator[Finding]:
    """A zero that is not the same at both ends."""
    if segments.contact is None:
        return
    height, noise = float(np.max(np.abs(trace.force))), noise_of(trace.force)
    before = trace.force[: segments.contact + 1]
    if segments.exit is not None:
        after = float(np.median(trace.force[segments.exit :])) - float(np.median(before))
        if abs(after) > max(SMALL * height, NOISES * noise):
            text = (
                f"the force is {after:+.3g} N different after the needle has left the tissue: let the sensor warm up, "
            )
            restless = all(stroke.kind != "hold" for stroke in (segments.strokes[0], segments.strokes[-1]))
            at_rest = f"or rest in air, which tells a drift from {-0.5 * after:.2g} N of friction of the slide"
            yield Finding("drift", text + (at_rest if after < 0 and restless else "or fit the drift"))
        return  # the zero is known at both ends
    if len(before) >= 30:
        rise, error = slope(np.linspace(-1, 1, len(before)), before)
        over_all = rise * 2 * len(trace) / len(before)
        if abs(rise) > 6 * error and abs(over_all) > 3 * SMALL * height:
            text = f"the force drifts before contact, by {over_all:+.3g} N if it goes on so to the end"
            yield Finding("drift", f"{text}: let the sensor warm up, or fit the drift")


def _depth_axis(trace: Trace, segments: Segments) -> Iterator[Finding]:
    steps = np.diff(trace.depth)
    moving = np.concatenate([steps[s.start : s.end - 1] for s in segments.strokes if s.kind != "hold"] or [steps])
    reasons = []
    usual = float(np.median(np.abs(moving[moving != 0]))) if (moving != 0).any() else 0.0
    if len(moving) and float(np.mean(moving == 0)) > 0.5 and usual > 0.005 * float(np.ptp(trace.depth)):
        reasons.append(f"it goes in steps of {usual * 1e3:.3g} mm, with repeats between them")
    largest = float(np.max(np.abs(steps)))
    if usual > 0 and largest > max(0.05 * float(np.ptp(trace.depth)), 30 * usual):
        reasons.append(f"it jumps by {largest * 1e3:.3g} mm at sample {int(np.argmax(np.abs(steps))) + 1}")
    if trace.time is not None:
        speed = np.abs(steps) / np.diff(trace.time)
        fast = float(np.median(speed[speed > 0.1 * speed.max()])) if speed.max() > 0 else 0.0
        if fast > _FASTEST:
            reasons.append(f"the needle would move at {fast:.3g} m/s; perhaps the axis is 10 or 1000 times too large")
        elif 0 < fast < _SLOWEST:
            text = f"the needle would take {float(np.ptp(trace.time)):.3g} s at {fast * 1e3:.2g} mm/s"
            yield Finding("time_doubtful", f"{text}; perhaps the time is in ms (--unit time=ms)")
    if trace.time is None and float(np.mean(steps < 0)) > 0.1 and len(segments.strokes) == 1:
        reasons.append(f"{int((steps < 0).sum())} depths go back; sort a digitised curve by depth (--order depth)")
    if reasons:
        yield Finding("depth_doubtful", "the depth axis is doubtful: " + "; ".join(reasons))


def _missing(trace: Trace, segments: Segments) -> Iterator[Finding]:
    if trace.time is None:
        text = "damping and relaxation cannot be told; record the time, too"
        yield Finding("no_time", text)
    if not segments.contact:  # none, or at the first sample
        unknown = "" if segments.exit is not None else ", and no air shows the zero and the noise of the force"
        text = "the force rises from the first samples on"
        air = trace.force[len(trace) if segments.exit is None else segments.exit :]
        above = baseline(trace.force) - float(np.median(air)) if len(air) else 0.0
        if above > SMALL * float(np.max(np.abs(trace.force))):
            text = f"the force begins {above:.3g} N above that in air behind the way out, as where a needle presses"
        text += f": the depth of contact is a guess{unknown}; begin before contact"
        yield Finding("no_contact", text)
    if not any(stroke.kind == "out" for stroke in segments.strokes):
        text = "friction and grip cannot be told apart; record the withdrawal, too"
        yield Finding("no_withdrawal", text)
    if not segments.pops:
        text = "the force never drops while the needle goes in; if the tip is not through the wall yet, go deeper"
        yield Finding("no_pop", text)
