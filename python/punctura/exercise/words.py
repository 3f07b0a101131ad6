"""Sentences about an attempt for the student. Their numbers come from the measures."""

from __future__ import annotations

import math
from collections.abc import Sequence
from decimal import ROUND_HALF_UP, Decimal

from punctura._core import Fault, describe
from punctura.exercise.achievements import Achievement, FeelJudge, StayJudge
from punctura.exercise.limit import Limit, Moment, by
from punctura.exercise.limits import EntriesJudge, ForceJudge, LineJudge, NeverPassJudge, TimeJudge
from punctura.exercise.loss import remedy
from punctura.exercise.measures import Measures
from punctura.exercise.motion_limits import AngleJudge, DepthJudge, PauseJudge, SpeedJudge
from punctura.exercise.plunger import PlungerJudge
from punctura.exercise.result import GoalState, Loss, PlungerLoss
from punctura.exercise.schema import Space
from punctura.exercise.space import TargetSpace
from punctura.exercise.stop import StopJudge


def tenths(value: float) -> str:
    """The value with one decimal, rounded like on the page: a half goes up."""
    return str(Decimal(value).quantize(Decimal("0.1"), ROUND_HALF_UP))


def state(goal: GoalState) -> str:
    """The word for a goal's state."""
    return "not decided" if goal.state == "open" else goal.state


def missed(limit: Limit, when: Moment, measures: Measures, space: TargetSpace) -> str:
    """The reason why a limit was missed."""
    if isinstance(limit, NeverPassJudge):
        if measures.arrival is None:
            return f"You went through the {limit.membrane} before you reached {space.name}."
        return f"You went through the {limit.membrane} {tenths(when.time - measures.arrival)} s after {space.arrival}."
    if isinstance(limit, StopJudge):
        return (
            f"You ran more than {limit.within * 1e3:g} mm past the {limit.membrane} when it gave way: "
            "hold against the loss of resistance."
        )
    if isinstance(limit, PlungerJudge):
        return (
            f"You injected more than {limit.within * 1e6:g} mL in the {limit.seconds:g} s after the plunger gave way: "
            "let the plunger go when it gives way."
        )
    if isinstance(limit, LineJudge):
        return f"The point came into {space.name} {tenths((limit.farthest or 0.0) * 1e3)} mm beside the middle line."
    if isinstance(limit, TimeJudge):
        return f"The time ran out {limit.seconds:g} s after the first contact."
    if isinstance(limit, ForceJudge):
        return f"You pushed with more than {limit.at_most:g} N."
    if isinstance(limit, AngleJudge):
        entered = math.degrees(limit.entered or 0.0)
        return f"You entered at {entered:.0f} degrees; {limit.asked_deg:g} are asked, within {limit.within_deg:g}."
    if isinstance(limit, SpeedJudge):
        return f"You pushed in faster than {limit.at_most * 1e3:g} mm/s."
    if isinstance(limit, PauseJudge):
        return f"You stood still for {limit.seconds:g} s before you reached {space.name}."
    if isinstance(limit, DepthJudge):
        return f"The point went more than {limit.at_most * 1e3:g} mm past the {limit.behind}."
    if isinstance(limit, EntriesJudge):
        return f"You entered more than {limit.at_most} time{'s' * (limit.at_most > 1)}."
    return f"Missed: {limit.text}."


def not_measured(limit: Limit, until: Moment | None, first: str) -> str:
    """The reason why a limit was not measured."""
    if limit.unseen is not None and by(limit.unseen, until):
        return f"Not measured: “{limit.text}”. Readings were missing at {tenths(limit.unseen.time)} s of the run."
    if by(limit.gone, until):
        return f"Not measured: “{limit.text}”, because the page was late then, so that nobody moved the needle."
    if isinstance(limit, StopJudge):
        if limit.popped:
            when = f"the attempt ended within {limit.seconds:g} s after the {limit.membrane} gave way"
        else:
            when = f"the {limit.membrane} never gave way"
        return f"Not measured: how far you moved past the {limit.membrane}, because {when}."
    if isinstance(limit, PlungerJudge):
        ended = f"the attempt ended within {limit.seconds:g} s after it"
        return f"Not measured: “{limit.text}”, because {ended if limit.gave_way else 'the plunger never gave way'}."
    if isinstance(limit, LineJudge):
        return f"Not measured: “{limit.text}”, because the point was never in the space."
    return f"Not measured: “{limit.text}”, because there was no contact with the {first}."


def not_felt(loss: Loss | PlungerLoss) -> str:
    """The reason why an attempt that achieved everything is not judged as passed."""
    device = "second device" if isinstance(loss, PlungerLoss) else "device"
    return (
        f"Not judged as passed: the {device} could not show the loss of resistance of the {loss.name} "
        f"({loss.figures}). {remedy(loss)}"
    )


def waiting(limit: StopJudge) -> str:
    """The instruction while a limit is still being measured."""
    if limit.waits_for == "rest":
        return "Hold still."
    return f"Go on until the {limit.membrane} gives way, then stop."


def push_again(goal: FeelJudge) -> str:
    """The instruction while the needle is in the space, but the plunger has not given way under the thumb."""
    return f"Draw back into the {goal.behind}, push the plunger with at least {goal.at_least:g} N, and go on."


def emptied(space: TargetSpace) -> str:
    """The instruction when the syringe is empty, but the plunger has not given way under the thumb."""
    return (
        "The syringe is empty: end this attempt and try again. Push the plunger only in the tissue in front of "
        f"{space.name}."
    )


def aside(limit: LineJudge, inside: bool) -> str:
    """The instruction while the needle points beside the line that it must meet."""
    half_mm = round(abs(limit.aim or 0.0) * 2e3) / 2
    if inside:
        return f"The needle points {half_mm:g} mm beside the line: draw it out, and move it {limit.way}."
    return f"Move the needle {half_mm:g} mm {limit.way}, until it points at the line. Then push in."


def too_deep(space: Space) -> str:
    """The instruction while the point is behind the space's end."""
    if space.in_front_of is not None:
        return f"You press against the {space.in_front_of}: draw back a little."
    return f"You are more than {space.deepest_mm:g} mm past the {space.behind}: draw back a little."


def invalid(why: str, fault: Fault) -> str:
    """The reason why an attempt does not count. why: "scene" or "fault"."""
    if why == "scene":
        return "The scene was changed during the exercise, so this attempt does not count."
    return f"The run stopped: {describe(fault)}."


def open_still(achievement: Achievement, measures: Measures, space: TargetSpace, first: str) -> str:
    """The reason why a goal is still open when the attempt ends without a decision."""
    if measures.entries == 0:
        return f"You did not touch the {first}."
    if measures.arrival is None:
        return f"You did not reach {space.name}."
    if isinstance(achievement, FeelJudge):
        if achievement.empty:
            return f"The syringe was empty before the plunger could give way behind the {achievement.behind}."
        pushed = f"with {tenths(max(0.0, achievement.load))} N" if achievement.load is not None else "not at all"
        return (
            f"The plunger did not give way under your thumb: you pushed it {pushed} when the point came out behind the "
            f"{achievement.behind}; at least {achievement.at_least:g} N are asked."
        )
    if isinstance(achievement, StayJudge) and not achievement.left:
        if achievement.whole_tip and measures.longest_stay == 0:
            return f"The whole tip was never in {space.name}."
        longest = tenths(measures.longest_stay)
        return f"You stayed in {space.name} for {longest} s; the goal is {achievement.seconds:g} s."
    if achievement.left:
        return f"You left {space.name} before everything was measured."
    return f"Not done: {achievement.text}."


def of_page(late: float) -> list[str]:
    """Tells how long the page that moves the hand was silent."""
    text = f"The page was late: for {tenths(late)} s it sent nothing, so the needle stood still. This is no pause."
    return [text] if late >= 0.5 else []


def of_force(measures: Measures) -> list[str]:
    """Tells how long the force was off in the tissue, and how long limits made the felt force smaller."""
    said = []
    if measures.force_off:
        off = tenths(measures.force_off)
        said = [f"The force was off for {off} s while the needle was in the tissue: turn it on before you begin."]
    cut = " and ".join(f"{tenths(seconds)} s ({words})" for words, seconds in measures.force_cut.items())
    return [*said, f"Limits cut the felt force for {cut}."] if cut else said


def passed(achievements: Sequence[Achievement], measures: Measures, space: TargetSpace, first: str) -> list[str]:
    """Sentences about a success."""
    said = []
    if measures.arrival is not None and measures.first_touch is not None:
        seconds = tenths(measures.arrival - measures.first_touch)
        entries = "at the first entry" if measures.entries == 1 else f"with {measures.entries} entries"
        said.append(f"You reached {space.name} {seconds} s after touching the {first}, {entries}.")
    if any(isinstance(one, StayJudge) for one in achievements):
        said.append(f"You stayed in it for {tenths(measures.longest_stay)} s.")
    if measures.yields:
        last = measures.yields[-1]
        said.append(
            f"The plunger gave way under {tenths(last.push)} N; you injected {tenths(last.injected * 1e6)} mL in the "
            f"next {last.seconds:g} s."
        )
    return said
