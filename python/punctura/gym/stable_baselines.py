"""Many trials for a learner of Stable-Baselines3 (which this module needs), in the lanes of a NeedleVectorEnv."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium.vector import AutoresetMode
from stable_baselines3.common.vec_env import VecEnv

from punctura.gym.env import NeedleVectorEnv
from punctura.gym.tasks import Task


class NeedleVecEnv(VecEnv):  # type: ignore[misc]  # the types are checked where Stable-Baselines3 is not installed
    """Trials of a task for a learner: `PPO("MlpPolicy", NeedleVecEnv("StopAfterPop", 64))`.

    The arguments are those of NeedleVectorEnv. An info has `success`, `pierced` and `fault`. At the end of a trial it
    also has what Stable-Baselines3 reads: `terminal_observation`, `TimeLimit.truncated`, `is_success` and `episode`.
    """

    def __init__(self, task: str | Task, num_envs: int = 1, **options: Any) -> None:
        self.envs = NeedleVectorEnv(task, num_envs, autoreset_mode=AutoresetMode.SAME_STEP, **options)
        self.render_mode = self.envs.render_mode
        super().__init__(self.envs.num_envs, self.envs.single_observation_space, self.envs.single_action_space)
        self._actions = np.zeros((self.num_envs, 1), np.float32)
        self._return, self._steps = np.zeros(self.num_envs), np.zeros(self.num_envs, int)

    def reset(self) -> npt.NDArray[np.float32]:
        """(n, 5) New scenes, with the seeds of `seed` if it was called."""
        seen, _ = self.envs.reset(seed=self._seeds)
        self._reset_seeds()
        self._reset_options()
        self._return[:] = self._steps[:] = 0
        return seen

    def step_async(self, actions: npt.NDArray[np.float32]) -> None:
        """Keeps the actions for step_wait, which makes the ticks."""
        self._actions = actions

    def step_wait(self) -> tuple[npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any], list[dict[str, Any]]]:
        """(observations, rewards, dones, infos) of one decision period. A trial that ended has begun anew."""
        seen, reward, ended, late, columns = self.envs.step(self._actions)
        self._return += reward
        self._steps += 1
        done = ended | late
        names = ("success", "pierced", "fault")
        infos = [{name: columns[name][i].item() for name in names} for i in range(self.num_envs)]
        for i in np.flatnonzero(done).tolist():
            final = {name: columns["final_info"][name][i].item() for name in names}
            infos[i] = final | {
                "terminal_observation": columns["final_obs"][i],
                "TimeLimit.truncated": bool(late[i]),
                "is_success": final["success"],
                "episode": {"r": float(self._return[i]), "l": int(self._steps[i])},
            }
        self._return[done] = self._steps[done] = 0
        return seen, reward.astype(np.float32), done, infos

    def close(self) -> None:
        self.envs.close()

    def get_images(self) -> list[npt.NDArray[np.uint8] | None]:
        """A picture of each trial, or None without a render mode."""
        return list(self.envs.render() or [None] * self.num_envs)

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """An attribute of the NeedleVectorEnv, once for each trial that is asked for."""
        return [getattr(self.envs, attr_name) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Raises NotImplementedError: the trials share their settings."""
        raise NotImplementedError("the trials share their settings: give them to NeedleVecEnv(...)")

    def env_method(self, method_name: str, *method_args: Any, indices: Any = None, **method_kwargs: Any) -> list[Any]:
        """Raises NotImplementedError: a trial is no object of its own. `envs` is the NeedleVectorEnv."""
        raise NotImplementedError(f"a trial has no method {method_name!r}: call it on `envs`, the NeedleVectorEnv")

    def env_is_wrapped(self, wrapper_class: type, indices: Any = None) -> list[bool]:
        """False for each trial."""
        return [False for _ in self._get_indices(indices)]
