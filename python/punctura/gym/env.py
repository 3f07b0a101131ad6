"""One needle for one learner."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt

from punctura._core import Hand, Plant
from punctura.gym.observation import Observations, action_space, observation_space
from punctura.gym.population import Population
from punctura.gym.task import Task
from punctura.gym.tasks import TASKS
from punctura.gym.trials import Outcome, Trials


def task_of(task: str | Task) -> Task:
    """A task by its name. Raises ValueError."""
    if isinstance(task, Task):
        return task
    if task not in TASKS:
        raise ValueError(f"there is no task {task!r}; the tasks are {', '.join(TASKS)}")
    return TASKS[task]


def no_render_mode(mode: object) -> None:
    """Raises ValueError if a render mode is asked for."""
    if mode is not None:
        raise ValueError(
            f"render_mode is {mode!r}: the environments draw no pictures. Leave it out; `punctura run` opens the studio"
        )


class NeedleEnv(gymnasium.Env[Observations, npt.NDArray[np.float32]]):
    """A simulated hand pushes a simulated device, and the learner sets the speed of the hand.

    Each reset draws a scene of the population. Observation: OBSERVATION. docs/gym.md has the rewards.
    """

    metadata = {"render_modes": []}  # noqa: RUF012  gymnasium declares it so

    def __init__(
        self, task: str | Task, population: Population | None = None, plant: Plant | None = None,
        hand: Hand | None = None, render_mode: None = None,
    ) -> None:  # fmt: skip
        """population: default is that of the task. plant, hand: default are those of punctura.simulation.Experiment."""
        no_render_mode(render_mode)
        self.task = task_of(task)
        self.trials = Trials(self.task, 1, population, plant, hand, threads=1)
        self.observation_space = observation_space()
        self.action_space = action_space()
        self.render_mode: None = None
        self._done = True

    def __repr__(self) -> str:
        return f"<NeedleEnv on {self.task.scene}, {'ended or not begun' if self._done else 'running'}>"

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observations, dict[str, Any]]:
        """A new scene, and the needle in front of the skin."""
        super().reset(seed=seed)
        self.trials.start(0, self.np_random)
        self._done = False
        return self.trials.first()[0], {}

    def step(self, action: npt.NDArray[np.float32]) -> tuple[Observations, float, bool, bool, dict[str, Any]]:
        """The hand moves for one decision period. Raises RuntimeError after the end of a trial."""
        if self._done:
            raise RuntimeError("the trial has ended or not begun: call reset()")
        out = self.trials.step(action)
        self._done = bool(out.terminated[0] or out.truncated[0])
        info = {"success": bool(out.success[0]), "pierced": bool(out.pierced[0]), "fault": int(out.fault[0])}
        return out.observation[0], float(out.reward[0]), bool(out.terminated[0]), bool(out.truncated[0]), info


def infos(out: Outcome) -> dict[str, npt.NDArray[Any]]:
    """The infos of a vector environment: a column and a mask for each word."""
    columns = {"success": out.success, "pierced": out.pierced, "fault": out.fault}
    everywhere = np.ones(len(out.fault), bool)
    return {**columns, **{f"_{name}": everywhere.copy() for name in columns}}
