"""What happened in an attempt, in sentences for the one who made it. Their numbers are those of the measures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from decimal import ROUND_HALF_UP, Decimal

from punctura._core import Fault, describe
from punctura.exercise.achievements import Achievement, StayJudge
from punctura.exercise.limit import Limit, Moment, by
from punctura.exercise.limits import EntriesJudge, ForceJudge, NeverPassJudge, TimeJudge
from punctura.exercise.measures import Measures
from punctura.exercise.result import GoalState
from punctura.exercise.schema import Space
from punctura.exercise.space import TargetSpace
from punctura.exercise.stop import StopJudge


def tenths(value: float) -> str:
    """With one decimal, rounded as the page rounds: a half goes up."""
    return str(Decimal(value).quantize(Decimal("0.1"), ROUND_HALF_UP))


def state(goal: GoalState) -> str:
    """A goal's state, for people."""
    return "not decided" if goal.state == "open" else goal.state


def missed(limit: Limit, when: Moment, measures: Measures, space: TargetSpace) -> str:
    """Why a limit was not kept."""
    if isinstance(limit, NeverPassJudge):
        if measures.arrival is None:
            return f"You went through the {limit.membrane} without having reached {space.name}."
        return f"You went through the {limit.membrane} {tenths(when.time - measures.arrival)} s after {space.arrival}."
    if isinstance(limit, StopJudge):
        return (
            f"You ran more than {limit.within * 1e3:g} mm past the {limit.membrane} when it gave way: "
            "hold against the loss of resistance."
        )
    if isinstance(limit, TimeJudge):
        return f"The time was over, {limit.seconds:g} s after the first touch."
    if isinstance(limit, ForceJudge):
        return f"You pushed with more than {limit.at_most:g} N."
    if isinstance(limit, EntriesJudge):
        return f"You went in more often than the {limit.at_most} time{'s' * (limit.at_most > 1)} that are allowed."
    return f"Missed: {limit.text}."


def not_measured(limit: Limit, until: Moment | None, first: str) -> str:
    """Why nobody can say whether a limit was kept."""
    if limit.unseen is not None and by(limit.unseen, until):
        return f"Not measured: “{limit.text}”. Readings were missing at {tenths(limit.unseen.time)} s of the run."
    if isinstance(limit, StopJudge):
        if limit.popped:
            when = f"the attempt ended within {limit.seconds:g} s after the {limit.membrane} gave way"
        else:
            when = f"the {limit.membrane} never gave way"
        return f"Not measured: how far you run on past the {limit.membrane}, because {when}."
    return f"Not measured: “{limit.text}”, because the {first} was never touched."


def waiting(limit: StopJudge) -> str:
    """What to do while a limit is still being measured."""
    if limit.waits_for == "rest":
        return "Hold still."
    return f"Go on until the {limit.membrane} gives way, and stop there: that is still to be measured."


def too_deep(space: Space) -> str:
    """What to do where the point is behind the space's end."""
    if space.in_front_of is not None:
        return f"You press against the {space.in_front_of}: draw back a little."
    return f"You are more than {space.deepest_mm:g} mm past the {space.behind}: draw back a little."


def spoilt(why: str, fault: Fault) -> str:
    """Why an attempt does not count; why: "scene" or "fault"."""
    if why == "scene":
        return "The scene was changed during the exercise, so this attempt does not count."
    return f"The run stopped: {describe(fault)}."


def open_still(achievement: Achievement, measures: Measures, space: TargetSpace, first: str) -> str:
    """Why an achievement is none, when the attempt ends without a decision."""
    if measures.entries == 0:
        return f"You did not touch the {first}."
    if measures.arrival is None:
        return f"You did not reach {space.name}."
    if isinstance(achievement, StayJudge) and not achievement.left:
        if achievement.whole_tip and measures.longest_stay == 0:
            return f"The whole tip never came into {space.name}."
        longest = tenths(measures.longest_stay)
        return f"You stayed in {space.name} for {longest} s at a time; {achievement.seconds:g} s are asked."
    if achievement.left:
        return f"You left {space.name} before everything was measured."
    return f"Not done: {achievement.text}."


def force_cut(seconds_by_limit: Mapping[str, float]) -> list[str]:
    """That the hand got less than the model's force."""
    cut = " and ".join(f"{tenths(seconds)} s ({words})" for words, seconds in seconds_by_limit.items())
    return [f"The device gave less than the model's force for {cut}."] if cut else []


def passed(achievements: Sequence[Achievement], measures: Measures, space: TargetSpace, first: str) -> list[str]:
    """What was good."""
    said = []
    if measures.arrival is not None and measures.first_touch is not None:
        seconds = tenths(measures.arrival - measures.first_touch)
        entries = "at the first entry" if measures.entries == 1 else f"with {measures.entries} entries"
        said.append(f"You reached {space.name} {seconds} s after touching the {first}, {entries}.")
    if any(isinstance(one, StayJudge) for one in achievements):
        said.append(f"You stayed in it for {tenths(measures.longest_stay)} s.")
    return said
