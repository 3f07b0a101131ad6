"""What went well, whatever the goals are. Each function makes the sentences about one thing."""

from __future__ import annotations

import math
from collections.abc import Iterator

from punctura.exercise.coach import thresholds as t
from punctura.exercise.coach.seen import Seen
from punctura.exercise.quantities import degrees, mm, tenths
from punctura.exercise.result import Remark


def held_still(seen: Seen) -> Iterator[Remark]:
    hold = seen.hold
    if hold is not None and hold.tremor <= t.TREMOR_GOOD_M and hold.drift <= t.DRIFT_GOOD_M:
        text = (
            f"You held still: in {tenths(hold.seconds)} s the tip trembled by {hold.tremor * 1e3:.2f} mm (rms) and "
            f"drifted by {hold.drift * 1e3:.2f} mm."
        )
        numbers = {"tremor_m": hold.tremor, "drift_m": hold.drift, "held_s": hold.seconds}
        yield Remark(about="tremor", text=text, numbers=numbers)


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


ORDER = (held_still, pushed_steadily, kept_the_line, right_angle)
