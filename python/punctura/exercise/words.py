"""What happened in an attempt, in sentences for the one who made it."""

from __future__ import annotations

from punctura.exercise.judges import (
    AttemptsJudge,
    ForceJudge,
    Judge,
    Moment,
    NeverPassJudge,
    StayJudge,
    StopJudge,
    TimeJudge,
)
from punctura.exercise.measures import Measures
from punctura.exercise.space import TargetSpace


def missed(judge: Judge, when: Moment, measures: Measures, space: TargetSpace) -> str:
    """Why a limit was not kept."""
    if isinstance(judge, NeverPassJudge):
        if measures.arrival is None:
            return f"You went through the {judge.membrane} without having reached {space.name}."
        return f"You went through the {judge.membrane} {when.time - measures.arrival:.1f} s after {space.arrival}."
    if isinstance(judge, StopJudge):
        return (
            f"You ran more than {judge.within * 1e3:g} mm past the {judge.membrane} when it gave way: "
            "hold against the loss of resistance."
        )
    if isinstance(judge, TimeJudge):
        return f"The time was over, {judge.seconds:g} s after the first touch."
    if isinstance(judge, ForceJudge):
        return f"You pushed with more than {judge.at_most:g} N."
    if isinstance(judge, AttemptsJudge):
        return f"You went in more often than the {judge.at_most} time{'s' * (judge.at_most > 1)} that are allowed."
    return f"Missed: {judge.text}."


def open_still(judge: Judge, measures: Measures, space: TargetSpace, first: str) -> str:
    """Why an achievement is none, when the attempt ends without a decision."""
    if measures.attempts == 0:
        return f"You did not touch the {first}."
    if measures.arrival is None:
        return f"You did not reach {space.name}."
    if isinstance(judge, StayJudge) and judge.longest == 0 and judge.whole_tip:
        return f"The whole tip never came into {space.name}."
    if isinstance(judge, StayJudge):
        return f"You stayed in {space.name} for {judge.longest:.1f} s at a time; {judge.seconds:g} s are asked."
    return f"Not done: {judge.text}."


def passed(judges: list[Judge], measures: Measures, space: TargetSpace, first: str) -> list[str]:
    """What was good."""
    said = []
    if measures.arrival is not None and measures.first_touch is not None:
        seconds = measures.arrival - measures.first_touch
        entries = "at the first attempt" if measures.attempts == 1 else f"with {measures.attempts} attempts"
        said.append(f"You reached {space.name} {seconds:.1f} s after touching the {first}, {entries}.")
    stays = [judge.seconds for judge in judges if isinstance(judge, StayJudge)]
    if stays:
        said.append(f"You stayed in it for {max(stays):g} s.")
    return said
