"""What to change next time. Each function makes the sentences about one thing; ORDER has the most important first."""

from __future__ import annotations

import math
from collections.abc import Iterator

from punctura.exercise.achievements import FeelJudge
from punctura.exercise.coach import thresholds as t
from punctura.exercise.coach.seen import Seen, degrees, millilitres, mm, speed, times
from punctura.exercise.limits import EntriesJudge, ForceJudge, LineJudge, NeverPassJudge, TimeJudge
from punctura.exercise.motion_limits import SpeedJudge
from punctura.exercise.plunger import PlungerJudge
from punctura.exercise.remark import Remark
from punctura.exercise.stop import StopJudge
from punctura.exercise.words import tenths
from punctura.exercise.yield_measures import REACTION_S


def went_through(seen: Seen) -> Iterator[Remark]:
    last = seen.trace.last
    for limit in seen.missed(NeverPassJudge):
        if last.speed <= 0:
            continue  # the readings before it are missing
        since = None if seen.arrival is None or seen.decision is None else seen.decision.time - seen.arrival
        if since is not None and since >= 2 * t.REACTION_S:
            when, what = f", {tenths(since)} s after you reached {seen.space.name}", "draw back when the force grows"
        else:
            when, what = "", "push more slowly, so that you have time to stop"
        text = (
            f"You still moved in at {speed(last.speed)}, against {seen.newtons(last.force)}, when the point went "
            f"through the {limit.membrane}{when}: {what}."
        )
        numbers = {"speed_m_s": last.speed, "force_N": last.force}
        yield Remark(about="through", text=text, numbers=numbers | ({} if since is None else {"after_s": since}))


def went_too_far(seen: Seen) -> Iterator[Remark]:
    for limit in seen.missed(StopJudge):
        for push, one in seen.stops(limit):
            if one.distance <= limit.within:
                continue
            too_far = f"when the {limit.membrane} gave way, and went {mm(one.distance - limit.within)} too far"
            # A moving hand goes on until it reacts. A hand that pushes without moving fast is let go by the wall.
            if push.speed * t.REACTION_S >= one.distance / 2:
                text = f"You moved at {speed(push.speed)} {too_far}: push more slowly when the resistance grows."
            else:
                text = f"You were still pushing with {seen.newtons(push.force)} {too_far}: brace your hand earlier."
            numbers = {
                "speed_m_s": push.speed, "force_N": push.force, "distance_m": one.distance, "allowed_m": limit.within,
            }  # fmt: skip
            yield Remark(about="stop", text=text, numbers=numbers)


def pushed_on(seen: Seen) -> Iterator[Remark]:
    """The thumb went on when the plunger gave way."""
    for limit in seen.missed(PlungerJudge):
        one = max(seen.metrics.yields, key=lambda one: one.injected, default=None)
        if one is None:
            continue
        still = one.push_after is not None and one.push_after > t.RESTING_N
        after = (
            f"You still pushed the plunger with {one.push_after:.2f} N {REACTION_S:g} s after it gave way"
            if still
            else ("You pushed the plunger on when it gave way")
        )
        text = (
            f"{after}, and injected {millilitres(one.injected)}; {millilitres(limit.within)} are allowed: push more "
            "gently, and let go at once."
        )
        numbers = {"push_N": one.push, "injected_m3": one.injected, "allowed_m3": limit.within}
        yield Remark(
            about="plunger",
            text=text,
            numbers=numbers | ({} if one.push_after is None else {"push_after_N": one.push_after}),
        )


def pushed_too_early(seen: Seen) -> Iterator[Remark]:
    """The syringe was empty before the plunger could give way."""
    for goal in seen.achievements:
        if isinstance(goal, FeelJudge) and goal.met is None and goal.empty:
            text = (
                f"You emptied the syringe before the plunger could give way behind the {goal.behind}: push it only "
                f"while the point is in the tissue in front of {seen.space.name}."
            )
            yield Remark(about="plunger", text=text, numbers={"injected_m3": goal.injected})


def pushed_too_little(seen: Seen) -> Iterator[Remark]:
    """The thumb did not push when the needle came into the space, so it felt no loss of resistance."""
    for goal in seen.achievements:
        if not isinstance(goal, FeelJudge) or goal.met is not None or goal.load is None or goal.empty:
            continue
        load = max(0.0, goal.load)
        if load >= goal.at_least:
            continue
        text = (
            f"You pushed the plunger with {load:.2f} N when the point came out behind the {goal.behind}; at least "
            f"{goal.at_least:g} N are asked: keep your thumb on the plunger until it gives way."
        )
        yield Remark(about="plunger", text=text, numbers={"push_N": load, "asked_N": goal.at_least})


def pushed_too_fast(seen: Seen) -> Iterator[Remark]:
    for limit in seen.missed(SpeedJudge):
        fast = seen.trace.last.speed
        text = f"You moved in at {speed(fast)}; {speed(limit.at_most)} are allowed: push more slowly."
        yield Remark(about="speed", text=text, numbers={"speed_m_s": fast, "allowed_m_s": limit.at_most})


def pushed_too_hard(seen: Seen) -> Iterator[Remark]:
    for limit in seen.missed(ForceJudge):
        peak = seen.metrics.peak_force
        text = (
            f"You pushed with {seen.newtons(peak)}; {limit.at_most:.2f} N are allowed: push more gently, and stop as "
            "soon as a wall gives way."
        )
        yield Remark(about="force", text=text, numbers={"force_N": peak, "allowed_N": limit.at_most})


def beside_the_line(seen: Seen) -> Iterator[Remark]:
    for limit in seen.missed(LineJudge):
        beside = limit.farthest or 0.0
        text = (
            f"The point was {mm(beside)} beside the middle line when it came into {seen.space.name}; "
            f"{mm(limit.within)} are allowed: move the needle sideways before you enter, until it points at the line."
        )
        yield Remark(about="line", text=text, numbers={"beside_m": beside, "allowed_m": limit.within})


def entered_again(seen: Seen) -> Iterator[Remark]:
    again = seen.metrics.entries - 1
    if again > 0 and any(isinstance(limit, EntriesJudge) for limit in seen.limits):
        text = (
            f"You came out of the {seen.first} and entered again {times(again)}: change the direction under the "
            f"{seen.first}, and do not draw the tip out."
        )
        yield Remark(about="entries", text=text, numbers={"entries": again + 1})


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
    ended_early = seen.decision is not None and not any(seen.missed(TimeJudge))
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
    if seen.stay is None or seen.stays < 2:
        return
    longest = seen.metrics.longest_stay
    text = (
        f"You left {seen.space.name} {times(seen.stays - 1)} before you had held for {seen.stay.seconds:g} s; your "
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


def nearly_too_far(seen: Seen) -> Iterator[Remark]:
    for limit in seen.kept(StopJudge):
        for push, one in seen.stops(limit):
            if one.distance >= t.NEAR_STOP * limit.within:
                text = (
                    f"You went {mm(one.distance)} past the {limit.membrane} when it gave way; {mm(limit.within)} are "
                    f"allowed: you were pushing with {seen.newtons(push.force)} at {speed(max(push.speed, 0.0))}, "
                    "so brace your hand earlier."
                )
                numbers = {"distance_m": one.distance, "allowed_m": limit.within, "force_N": push.force}
                yield Remark(about="stop", text=text, numbers=numbers)


ORDER = (
    went_through, beside_the_line, went_too_far, pushed_on, pushed_too_early, pushed_too_little, pushed_too_hard,
    pushed_too_fast,
    wrong_angle, too_short, pressed, left_the_space, entered_again, nearly_too_far, trembled, paused, went_aside,
)  # fmt: skip
