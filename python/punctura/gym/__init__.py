"""Gymnasium environments: find the vein, the epidural space, or stop after a pop, by the force of the needle.

`import punctura.gym` registers punctura/Venipuncture-v0, punctura/Epidural-v0 and punctura/StopAfterPop-v0, for
gymnasium.make and gymnasium.make_vec. Needs Gymnasium: pip install 'punctura[gym]'.
"""

from punctura.extras import optional

optional("gymnasium", "gym", "punctura.gym")  # says what to install, before the imports below would fail

from punctura.gym.env import NeedleEnv  # noqa: E402
from punctura.gym.names import register  # noqa: E402
from punctura.gym.observation import OBSERVATION  # noqa: E402
from punctura.gym.population import Population, Vary  # noqa: E402
from punctura.gym.task import Task  # noqa: E402
from punctura.gym.tasks import TASKS  # noqa: E402
from punctura.gym.vector import NeedleVectorEnv  # noqa: E402

register()

__all__ = ["OBSERVATION", "TASKS", "NeedleEnv", "NeedleVectorEnv", "Population", "Task", "Vary"]
