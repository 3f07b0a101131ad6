"""The environments: one needle for one learner, or many needles that are stepped on threads in one call."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.envs.registration import EnvSpec
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from punctura._core import Hand, Plant
from punctura.gym.picture import Image
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


RENDERING: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 50}  # one picture each 20 ms


def checked_render_mode(mode: str | None) -> str | None:
    """Raises ValueError for a render mode that the environments do not have."""
    if mode not in (None, *RENDERING["render_modes"]):
        raise ValueError(f"render_mode is {mode!r}; it can be 'rgb_array'. `punctura run` opens a needle to look at")
    return mode


def info_of(out: Outcome, i: int) -> dict[str, Any]:
    """The info of trial i."""
    return {"success": bool(out.success[i]), "pierced": bool(out.pierced[i]), "fault": int(out.fault[i])}


class _Limited:
    """An environment whose spec says after how many steps a trial is late, as Gymnasium's wrappers expect it. The
    registry cannot say it: its number is a limit for each task and population that a caller gives."""

    trials: Trials
    _spec: EnvSpec | None = None

    @property
    def spec(self) -> EnvSpec | None:
        """What gymnasium.make made it of."""
        return self._spec

    @spec.setter
    def spec(self, spec: EnvSpec | None) -> None:
        self._spec = spec and replace(spec, max_episode_steps=self.trials.max_steps)


class NeedleEnv(_Limited, gymnasium.Env[Observations, npt.NDArray[np.float32]]):
    """A simulated hand pushes a simulated device, and the learner sets the speed of the hand.

    Each reset draws a scene of the population. Observation: OBSERVATION. docs/gym.md has the rewards.
    """

    metadata = RENDERING  # what Gymnasium asks for: how it can be drawn

    def __init__(
        self, task: str | Task, population: Population | None = None, plant: Plant | None = None,
        hand: Hand | None = None, render_mode: str | None = None,
    ) -> None:  # fmt: skip
        """population: default is that of the task. plant, hand: default are those of punctura.simulation.Experiment."""
        self.render_mode = checked_render_mode(render_mode)
        self.task = task_of(task)
        self.trials = Trials(self.task, 1, population, plant, hand, threads=1)
        self.observation_space = observation_space()
        self.action_space = action_space()
        self._done = True

    def __repr__(self) -> str:
        return f"<NeedleEnv on {self.task.scene}, {'ended or not begun' if self._done else 'running'}>"

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observations, dict[str, Any]]:
        """A new scene, and the needle in front of the skin."""
        super().reset(seed=seed)
        self.trials.start(0, self.np_random, draws=self.render_mode is not None)
        self._done = False
        return self.trials.first()[0], {}

    def step(self, action: npt.NDArray[np.float32]) -> tuple[Observations, float, bool, bool, dict[str, Any]]:
        """The hand moves for one decision period. Raises RuntimeError after the end of a trial."""
        if self._done:
            raise RuntimeError("the trial has ended or not begun: call reset()")
        out = self.trials.step(action)
        self._done = bool(out.terminated[0] or out.truncated[0])
        ended, late = bool(out.terminated[0]), bool(out.truncated[0])
        return out.observation[0], float(out.reward[0]), ended, late, info_of(out, 0)

    def render(self) -> Image | None:
        """The picture of the trial, (height, width, 3), or None without a render mode or before the first reset."""
        return self.trials.pictures[0].draw() if self.trials.pictures else None


class NeedleVectorEnv(_Limited, VectorEnv[Observations, npt.NDArray[np.float32], npt.NDArray[Any]]):
    """`num_envs` trials of a task. Trial i behaves as a NeedleEnv that was reset with seed + i, bit for bit.

    The results do not depend on the number of threads. `infos["fault"]` has the latched fault of each trial.
    """

    metadata = RENDERING  # what Gymnasium asks for: how it can be drawn

    def __init__(
        self, task: str | Task, num_envs: int = 1, population: Population | None = None, plant: Plant | None = None,
        hand: Hand | None = None, threads: int = 0, render_mode: str | None = None,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP, max_episode_steps: int | None = None,
    ) -> None:  # fmt: skip
        """threads: 0 is one for each processor. autoreset_mode: when a trial that has ended begins anew.
        max_episode_steps: a trial is late after them, if the task's time is not up before."""
        self.render_mode = checked_render_mode(render_mode)
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.metadata = {**RENDERING, "autoreset_mode": self.autoreset_mode}
        self.task = task_of(task)
        self.num_envs = num_envs
        self.trials = Trials(self.task, num_envs, population, plant, hand, threads, max_episode_steps)
        self.single_observation_space = observation_space()
        self.single_action_space = action_space()
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._random: list[np.random.Generator] = []
        self._ended: Flags = np.zeros(num_envs, bool)
        self._seen = self.trials.first()

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observations, dict[str, Any]]:
        """New scenes, and the needles in front of the skin.

        seed: a number s for s, s + 1, ..., or one for each. options["reset_mask"]: (num_envs,) bool, the trials that
        begin anew; the others go on, and their last observation is in the result.
        """
        seeds: Sequence[int | None]
        if isinstance(seed, int | np.integer):
            super().reset(seed=int(seed))
            seeds = [int(seed) + i for i in range(self.num_envs)]
        else:
            super().reset()
            seeds = [None] * self.num_envs if seed is None else seed
        if len(seeds) != self.num_envs:
            raise ValueError(f"seed must have one number for each of the {self.num_envs} environments")
        mask = self._checked_mask((options or {}).get("reset_mask"))
        for i in np.flatnonzero(mask).tolist():
            if seeds[i] is not None or i >= len(self._random):
                self._random[i : i + 1] = [np.random.Generator(np.random.PCG64(np.random.SeedSequence(seeds[i])))]
        self._begin(mask)
        self._ended = self._ended & ~mask
        return self._seen.copy(), {}

    def step(
        self, actions: npt.NDArray[np.float32]
    ) -> tuple[Observations, npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any], dict[str, Any]]:
        """All hands move for one decision period. With AutoresetMode.SAME_STEP, `infos["final_obs"]` and
        `infos["final_info"]` have the last observation and info of each trial that ended. With DISABLED, RuntimeError
        is raised for a trial that has ended and was not reset."""
        if not self._random:
            raise RuntimeError("the trials have not begun: call reset()")
        begins = self._ended
        if self.autoreset_mode is AutoresetMode.DISABLED and begins.any():
            i = int(np.flatnonzero(begins)[0])
            raise RuntimeError(f"trial {i} has ended: reset it with options={{'reset_mask': ...}}")
        out = self.trials.step(actions, begins)
        self._seen = out.observation
        for column in (out.reward, out.terminated, out.truncated, out.success, out.pierced, out.fault):
            column[begins] = 0
        self._ended = out.terminated | out.truncated
        infos: dict[str, Any] = {}
        if self.autoreset_mode is AutoresetMode.SAME_STEP:
            begins, self._ended = self._ended, np.zeros(self.num_envs, bool)
            for i in np.flatnonzero(begins).tolist():
                final = {"final_obs": out.observation[i].copy(), "final_info": info_of(out, i)}
                infos = self._add_info(infos, final, i)
        self._begin(begins)
        for name, column in (("success", out.success), ("pierced", out.pierced), ("fault", out.fault)):
            infos |= {name: np.where(begins, 0, column).astype(column.dtype), f"_{name}": ~begins}
        return self._seen.copy(), out.reward, out.terminated, out.truncated, infos

    def render(self) -> tuple[Image, ...] | None:
        """A picture of each trial, or None without a render mode."""
        return tuple(self.trials.pictures[i].draw() for i in range(self.num_envs)) if self.trials.pictures else None

    def _begin(self, mask: Flags) -> None:
        """Starts the trials of the mask."""
        for i in np.flatnonzero(mask).tolist():
            self.trials.start(i, self._random[i], draws=self.render_mode is not None)
        self._seen[mask] = 0

    def _checked_mask(self, mask: Any) -> Flags:
        if mask is None:
            return np.ones(self.num_envs, bool)
        if not isinstance(mask, np.ndarray) or mask.dtype != np.bool_:
            raise TypeError(f"options['reset_mask'] must be a NumPy array of bool, not {mask!r}")
        if mask.shape != (self.num_envs,) or not mask.any():
            raise ValueError(
                f"options['reset_mask'] must have the shape ({self.num_envs},) and at least one True, not {mask!r}"
            )
        if not self._random and not mask.all():
            raise RuntimeError("the trials have not begun: call reset() without a reset_mask first")
        return mask.copy()
