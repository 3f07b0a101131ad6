"""The kinds of goals. A new kind is one class with its judge, and one name below."""

from typing import Annotated, get_args

from pydantic import Field

from punctura.exercise.goals.goal import Course, Given, Goal
from punctura.exercise.goals.hand import EntryAngle, MostSpeed, NoPause, PeakForce, TimeLimit
from punctura.exercise.goals.line import OnLine, Straight
from punctura.exercise.goals.plunger import FeelPlunger, StopPlunger
from punctura.exercise.goals.reach import Reach, Stay
from punctura.exercise.goals.walls import Entries, MostDepth, NeverPass, StopAfterPop

# The coach speaks of limits and achievements in this order.
AnyGoal = Annotated[
    Reach
    | Stay
    | NeverPass
    | StopAfterPop
    | StopPlunger
    | FeelPlunger
    | OnLine
    | Straight
    | PeakForce
    | MostSpeed
    | EntryAngle
    | NoPause
    | MostDepth
    | TimeLimit
    | Entries,
    Field(discriminator="kind"),
]
GOALS: dict[str, type[Goal]] = {
    get_args(goal.model_fields["kind"].annotation)[0]: goal for goal in get_args(get_args(AnyGoal)[0])
}

__all__ = ["GOALS", "AnyGoal", "Course", "Given", "Goal", "MostDepth", "OnLine", "Reach", "Stay"]
