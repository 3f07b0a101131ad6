"""Sentences about an attempt for the student. Their numbers come from the measures."""

from collections.abc import Sequence

from punctura._core import Fault, describe
from punctura.exercise.fields import Space
from punctura.exercise.goals.goal import Achievement, LimitJudge
from punctura.exercise.losses import remedy
from punctura.exercise.measures import Measures
from punctura.exercise.quantities import tenths
from punctura.exercise.result import GoalState, Loss, PlungerLoss
from punctura.exercise.ticks import TargetSpace


def state(goal: GoalState) -> str:
    """The word for a goal's state."""
    return "not decided" if goal.state == "open" else goal.state


def not_felt(loss: Loss | PlungerLoss) -> str:
    """The reason why an attempt that achieved everything is not judged as passed."""
    device = "second device" if isinstance(loss, PlungerLoss) else "device"
    return (
        f"Not judged as passed: the {device} could not show the loss of resistance of the {loss.name} "
        f"({loss.figures}). {remedy(loss)}"
    )


def readings_missing(limits: Sequence[LimitJudge]) -> list[str]:
    """Names all limits that were not measured because readings came late or never, in one sentence."""
    times = [limit.unseen.time for limit in limits if limit.unseen is not None]
    if not times:
        return []
    names = ", ".join(f"“{limit.text}”" for limit in limits)
    return [
        f"Not measured: {names}. Readings were late or missing at {tenths(min(times))} s of the run. If other "
        "programs keep the computer busy, close them, and try again."
    ]


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
    return achievement.why_open(measures, space)


def of_page(late: float) -> list[str]:
    """Tells how long the page that moves the hand was silent."""
    text = f"The page was late: for {tenths(late)} s it sent nothing, so the needle stood still."
    return [f"{text} This does not count as a pause."] if late >= 0.5 else []


def of_computer(late: float) -> list[str]:
    """Tells how long the ticks of a simulated device were late."""
    text = f"The computer was late: for {tenths(late)} s together it computed nothing, so the needle stood still."
    return [f"{text} This counts neither as a pause nor as time in the space."] if late >= 0.5 else []


def of_force(measures: Measures) -> list[str]:
    """Tells how long the force was off in the tissue, and how long limits made the felt force smaller."""
    sentences = []
    if measures.force_off:
        off = tenths(measures.force_off)
        sentences = [f"The force was off for {off} s while the needle was in the tissue: turn it on before you begin."]
    cut = " and ".join(f"{tenths(seconds)} s ({words})" for words, seconds in measures.force_cut.items())
    return [*sentences, f"Limits cut the felt force for {cut}."] if cut else sentences


def passed(achievements: Sequence[Achievement], measures: Measures, space: TargetSpace, first: str) -> list[str]:
    """Sentences about a success."""
    sentences = []
    if measures.arrival is not None and measures.first_touch is not None:
        seconds = tenths(measures.arrival - measures.first_touch)
        entries = "at the first entry" if measures.entries == 1 else f"with {measures.entries} entries"
        sentences.append(f"You reached {space.name} {seconds} s after touching the {first}, {entries}.")
    if any(one.seconds > 0 for one in achievements):
        sentences.append(f"You stayed in it for {tenths(measures.longest_stay)} s.")
    if measures.yields:
        last = measures.yields[-1]
        sentences.append(
            f"The plunger gave way under {tenths(last.push)} N; you injected {tenths(last.injected * 1e6)} mL in the "
            f"next {last.seconds:g} s."
        )
    return sentences
