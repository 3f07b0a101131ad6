"""What went well. Each function makes the sentences about one thing; ORDER has the most important first."""

from __future__ import annotations

import math
from collections.abc import Iterator

from punctura.exercise.coach import thresholds as t
from punctura.exercise.coach.seen import Seen, degrees, millilitres, mm
from punctura.exercise.limits import ForceJudge, LineJudge
from punctura.exercise.plunger import PlungerJudge
from punctura.exercise.remark import Remark
from punctura.exercise.stop import StopJudge
from punctura.exercise.words import tenths


def stopped(seen: Seen) -> Iterator[Remark]:
    for limit in seen.kept(StopJudge):
        stops = list(seen.stops(limit))
        if stops and all(one.distance <= t.FIRM_STOP * limit.within for _, one in stops):
            farthest = max(one.distance for _, one in stops)
            text = (
                f"You stopped well: only {mm(farthest)} past the {limit.membrane} when it gave way; "
                f"{mm(limit.within)} are allowed."
            )
            yield Remark(about="stop", text=text, numbers={"distance_m": farthest, "allowed_m": limit.within})


def let_go(seen: Seen) -> Iterator[Remark]:
    for limit in seen.kept(PlungerJudge):
        most = max((one.injected for one in seen.metrics.yields), default=math.inf)
        if most <= t.FIRM_STOP * limit.within:
            text = (
                f"You let the plunger go well: only {millilitres(most)} after it gave way; {millilitres(limit.within)} "
                "are allowed."
            )
            yield Remark(about="plunger", text=text, numbers={"injected_m3": most, "allowed_m3": limit.within})


def held_still(seen: Seen) -> Iterator[Remark]:
    hold = seen.hold
    if hold is not None and hold.tremor <= t.TREMOR_GOOD_M and hold.drift <= t.DRIFT_GOOD_M:
        text = (
            f"You held still: in {tenths(hold.seconds)} s the tip trembled by {hold.tremor * 1e3:.2f} mm (rms) and "
            f"drifted by {hold.drift * 1e3:.2f} mm."
        )
        numbers = {"tremor_m": hold.tremor, "drift_m": hold.drift, "held_s": hold.seconds}
        yield Remark(about="tremor", text=text, numbers=numbers)


def hit_the_line(seen: Seen) -> Iterator[Remark]:
    for limit in seen.kept(LineJudge):
        if limit.farthest is not None:
            text = f"You hit the middle of {seen.space.name}: at most {mm(limit.farthest)} beside its middle line."
            yield Remark(about="line", text=text, numbers={"beside_m": limit.farthest, "allowed_m": limit.within})


def pushed_gently(seen: Seen) -> Iterator[Remark]:
    for limit in seen.kept(ForceJudge):
        peak = seen.metrics.peak_force
        text = f"You never pushed with more than {seen.newtons(peak)}; {limit.at_most:.2f} N are allowed."
        yield Remark(about="force", text=text, numbers={"force_N": peak, "allowed_N": limit.at_most})


def pushed_steadily(seen: Seen) -> Iterator[Remark]:
    if seen.arrival is not None and seen.pauses.number == 0 and seen.metrics.entries == 1:
        seconds = seen.metrics.time_to_target
        text = f"You pushed without a pause from the {seen.first} to {seen.space.name}, at the first entry."
        yield Remark(about="pauses", text=text, numbers={"to_target_s": seconds or 0.0})


def kept_the_line(seen: Seen) -> Iterator[Remark]:
    m = seen.metrics
    if m.lateral_deviation is None or m.net_distance is None or m.net_distance < 5e-3:
        return
    if m.lateral_deviation <= t.ASIDE_GOOD_M:
        text = f"You kept to the line of entry: the tip went at most {mm(m.lateral_deviation)} to its side."
        yield Remark(about="aside", text=text, numbers={"aside_m": m.lateral_deviation})


def right_angle(seen: Seen) -> Iterator[Remark]:
    angle = seen.metrics.entry_angle
    if angle is not None and abs(angle - seen.angle) <= math.radians(t.ANGLE_GOOD_DEG):
        text = f"You entered at {degrees(angle)}; {degrees(seen.angle)} are asked."
        yield Remark(about="angle", text=text, numbers={"angle_rad": angle, "asked_rad": seen.angle})


ORDER = (stopped, let_go, hit_the_line, held_still, pushed_gently, pushed_steadily, kept_the_line, right_angle)
