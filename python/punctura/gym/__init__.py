# ruff: noqa: E402
"""Gymnasium environments: find the vein, the epidural space, or stop after a pop, by the force of the needle.

`import punctura.gym` registers punctura/Venipuncture-v0, punctura/Epidural-v0 and punctura/StopAfterPop-v0, for
gymnasium.make and gymnasium.make_vec. Needs Gymnasium: the extra gym.
"""

from punctura.extras import optional

optional("gymnasium", "gym", "punctura.gym")  # before the imports below would fail

from punctura.gym.env import NeedleEnv
from punctura.gym.names import register
from punctura.gym.observation import OBSERVATION
from punctura.gym.population import Population, Vary
from punctura.gym.task import Task
from punctura.gym.tasks import TASKS
from punctura.gym.vector import NeedleVectorEnv

register()

__all__ = ["OBSERVATION", "TASKS", "NeedleEnv", "NeedleVectorEnv", "Population", "Task", "Vary"]
