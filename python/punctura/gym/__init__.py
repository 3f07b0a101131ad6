# ruff: noqa: E402
"""Gymnasium environments: find the vein, the epidural space, or stop after a pop, by the force of the needle.

`import punctura.gym` registers punctura/Venipuncture-v0, punctura/Epidural-v0 and punctura/StopAfterPop-v0, for
gymnasium.make and gymnasium.make_vec. Needs Gymnasium: the extra gym.
"""

from punctura.extras import optional

optional("gymnasium", "gym", "punctura.gym")  # before the imports below would fail

from punctura.gym.env import NeedleEnv, NeedleVectorEnv
from punctura.gym.population import Population, Vary
from punctura.gym.tasks import TASKS, Task, register
from punctura.gym.trials import OBSERVATION

register()

__all__ = ["OBSERVATION", "TASKS", "NeedleEnv", "NeedleVectorEnv", "Population", "Task", "Vary"]
