"""Many needles at once, stepped on threads in one call."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from punctura._core import Hand, Plant
from punctura.gym.env import infos, no_render_mode, task_of
from punctura.gym.observation import Observations, action_space, observation_space
from punctura.gym.population import Population
from punctura.gym.task import Task
from punctura.gym.trials import Flags, Trials


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
