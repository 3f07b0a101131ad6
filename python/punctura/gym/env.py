"""The environments: one needle for one learner, or many needles that are stepped on threads in one call."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from punctura._core import Hand, Plant
from punctura.gym.population import Population
from punctura.gym.tasks import TASKS, Task
from punctura.gym.trials import Flags, Observations, Outcome, Trials, action_space, observation_space


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


class NeedleVectorEnv(VectorEnv[Observations, npt.NDArray[np.float32], npt.NDArray[Any]]):
    """`num_envs` trials of a task. Trial i behaves as a NeedleEnv that was reset with seed + i, bit for bit.

    A trial that has ended is reset in the step after (AutoresetMode.NEXT_STEP). The results do not depend on the number
    of threads. `infos["fault"]` has the latched fault of each trial.
    """

    metadata = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}  # noqa: RUF012

    def __init__(
        self, task: str | Task, num_envs: int = 1, population: Population | None = None, plant: Plant | None = None,
        hand: Hand | None = None, threads: int = 0, render_mode: None = None,
    ) -> None:  # fmt: skip
        """threads: 0 is one for each processor."""
        no_render_mode(render_mode)
        self.task = task_of(task)
        self.num_envs = num_envs
        self.trials = Trials(self.task, num_envs, population, plant, hand, threads)
        self.single_observation_space = observation_space()
        self.single_action_space = action_space()
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.render_mode: None = None
        self._random: list[np.random.Generator] = []
        self._ended: Flags = np.zeros(num_envs, bool)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observations, dict[str, Any]]:
        """New scenes, and all needles in front of the skin. seed: a number s for s, s + 1, ..., or one for each."""
        seeds: Sequence[int | None]
        if isinstance(seed, int | np.integer):
            super().reset(seed=int(seed))
            seeds = [int(seed) + i for i in range(self.num_envs)]
        else:
            super().reset()
            seeds = [None] * self.num_envs if seed is None else seed
        if len(seeds) != self.num_envs:
            raise ValueError(f"seed must have one number for each of the {self.num_envs} environments")
        for i, own in enumerate(seeds):
            if own is not None or i >= len(self._random):
                self._random[i : i + 1] = [np.random.Generator(np.random.PCG64(np.random.SeedSequence(own)))]
            self.trials.start(i, self._random[i])
        self._ended[:] = False
        return self.trials.first(), {}

    def step(
        self, actions: npt.NDArray[np.float32]
    ) -> tuple[Observations, npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any], dict[str, Any]]:
        """All hands move for one decision period."""
        if not self._random:
            raise RuntimeError("the trials have not begun: call reset()")
        begins = self._ended
        out = self.trials.step(actions, begins)
        for i in np.flatnonzero(begins):
            self.trials.start(int(i), self._random[i])
            out.observation[i] = 0
            for column in (out.reward, out.terminated, out.truncated, out.success, out.pierced, out.fault):
                column[i] = 0
        self._ended = out.terminated | out.truncated
        return out.observation, out.reward, out.terminated, out.truncated, infos(out)
