"""What to change next time, whatever the goals are. Each function makes the sentences about one thing."""

from __future__ import annotations

import math
from collections.abc import Iterator

from punctura.exercise.coach import thresholds as t
from punctura.exercise.coach.seen import Seen
from punctura.exercise.quantities import degrees, mm, tenths, times
from punctura.exercise.result import Remark


def wrong_angle(seen: Seen) -> Iterator[Remark]:
    angle = seen.metrics.entry_angle
    if angle is None or abs(angle - seen.angle) < math.radians(t.ANGLE_OFF_DEG):
        return
    way = "flatter" if angle > seen.angle else "steeper"
    text = (
        f"You entered at {degrees(angle)}; {degrees(seen.angle)} are asked: hold the needle "
        f"{degrees(abs(angle - seen.angle))} {way}."
    )
    yield Remark(about="angle", text=text, numbers={"angle_rad": angle, "asked_rad": seen.angle})


def too_short(seen: Seen) -> Iterator[Remark]:
    """The needle, or its whole tip, never came into the space."""
    space, trace = seen.space, seen.trace
    ended_early = seen.decision is not None and not seen.timed_out
    if seen.passed or ended_early or not (math.isfinite(trace.nearest) and math.isfinite(trace.tip_nearest)):
        return
    arrived = seen.arrival is not None
    whole = space.stay_whole if arrived else space.arrive_whole
    if arrived and (not space.stay_whole or seen.metrics.longest_stay > 0):
        return
    depth = space.begins if arrived or space.arrive_depth is None else space.arrive_depth
    point_short = depth - trace.nearest
    if point_short > 0.05e-3:
        text = f"The point stayed {mm(point_short)} or more away from {space.name}: push on until {_sign(seen)}."
        yield Remark(about="short", text=text, numbers={"short_m": point_short})
        return
    tip_short = depth - trace.tip_nearest
    if whole and tip_short > 0.05e-3:
        text = (
            f"The point was in {space.name}, but the end of the tip was still {mm(tip_short)} outside: go on until "
            f"the {seen.before} gives way."
        )
        yield Remark(about="short", text=text, numbers={"short_m": tip_short})


def _sign(seen: Seen) -> str:
    return f"you notice {seen.space.sign}" if seen.space.sign else f"the {seen.before} gives way"


def pressed(seen: Seen) -> Iterator[Remark]:
    trace = seen.trace
    if trace.pressed_s < t.PRESSED_S or trace.pressed_m < 0.05e-3:
        return
    what = f"against the {seen.after}" if seen.after else "too deep"
    text = (
        f"You were {what} for {tenths(trace.pressed_s)} s, up to {mm(trace.pressed_m)} behind the end of "
        f"{seen.space.name}: draw back as soon as "
        + ("the force grows again." if seen.after else f"you are {mm(seen.space.ends)} past the {seen.before}.")
    )
    yield Remark(about="pressed", text=text, numbers={"pressed_s": trace.pressed_s, "pressed_m": trace.pressed_m})


def left_the_space(seen: Seen) -> Iterator[Remark]:
    if seen.hold_s is None or seen.stays < 2:
        return
    longest = seen.metrics.longest_stay
    text = (
        f"You left {seen.space.name} {times(seen.stays - 1)} before you had held for {seen.hold_s:g} s; your "
        f"longest stay was {tenths(longest)} s: stop, rest your hand, and only then count."
    )
    yield Remark(about="left", text=text, numbers={"stays": seen.stays, "longest_s": longest})


def trembled(seen: Seen) -> Iterator[Remark]:
    hold = seen.hold
    if hold is None:
        return
    if hold.tremor >= t.TREMOR_OFF_M:
        text = f"The tip trembled by {hold.tremor * 1e3:.2f} mm (rms) while you held: rest your hand on the table."
        yield Remark(about="tremor", text=text, numbers={"tremor_m": hold.tremor, "held_s": hold.seconds})
    if hold.drift >= t.DRIFT_OFF_M:
        text = f"The tip drifted by {mm(hold.drift)} while you held for {tenths(hold.seconds)} s: hold the depth."
        yield Remark(about="drift", text=text, numbers={"drift_m": hold.drift, "held_s": hold.seconds})


def paused(seen: Seen) -> Iterator[Remark]:
    count, seconds = seen.pauses
    if seconds >= t.PAUSES_S:
        text = (
            f"You stood still {times(count)} in the tissue on the way, for {tenths(seconds)} s together: push slowly "
            "but without a pause."
        )
        yield Remark(about="pauses", text=text, numbers={"pauses": count, "paused_s": seconds})


def went_aside(seen: Seen) -> Iterator[Remark]:
    aside, straightness = seen.metrics.lateral_deviation, seen.metrics.straightness
    if aside is None or straightness is None or (aside < t.ASIDE_OFF_M and straightness < t.CROOKED):
        return
    text = f"The tip went up to {mm(aside)} to the side of its line of entry: push along the needle."
    yield Remark(about="aside", text=text, numbers={"aside_m": aside, "straightness": straightness})


FIRST = (wrong_angle, too_short, pressed, left_the_space)  # before what the goals advise
LAST = (trembled, paused, went_aside)
