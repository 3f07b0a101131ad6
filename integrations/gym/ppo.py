"""PPO of Stable-Baselines3 learns to stop behind a pop, in the lanes of one NeedleVecEnv.

    python -m pip install stable-baselines3 matplotlib
    python integrations/gym/ppo.py --plot curve.png

The learner gets the last observations side by side, because a pop is a change of the force. Ten times a second it
decides whether to go on or to stop: a hand that chooses any speed by chance hardly ever rests for 0.5 s, and then
there is no success to learn from.
"""

import argparse
import time
from dataclasses import replace

import numpy as np
import torch
from gymnasium.spaces import Discrete
from punctura.gym import TASKS
from punctura.gym.stable_baselines import NeedleVecEnv
from stable_baselines3 import PPO
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.vec_env import VecEnvWrapper, VecFrameStack

TASK = replace(TASKS["StopAfterPop"], decision=0.1)
FIRST_UNSEEN = 1_000_000  # seed of the first patient of the trial


class GoOrStop(VecEnvWrapper):
    """Two actions: 0 stops, 1 goes on at half of the fastest speed."""

    def __init__(self, trials: int) -> None:
        super().__init__(NeedleVecEnv(TASK, trials), action_space=Discrete(2))

    def reset(self) -> np.ndarray:
        return self.venv.reset()

    def step_async(self, actions: np.ndarray) -> None:
        self.venv.step_async(0.5 * actions)

    def step_wait(self) -> tuple:
        return self.venv.step_wait()


class Curve(BaseCallback):
    """Keeps (decisions, share of the last 200 trials with success)."""

    def __init__(self) -> None:
        super().__init__()
        self.points: list[tuple[int, float]] = []
        self._last: list[bool] = []

    def _on_step(self) -> bool:
        self._last += [info["is_success"] for info in self.locals["infos"] if "is_success" in info]
        self._last = self._last[-200:]
        return True

    def _on_rollout_end(self) -> None:
        if self._last:
            share = float(np.mean(self._last))
            self.points.append((self.num_timesteps, share))
            print(f"  {self.num_timesteps:8d} decisions: {share:4.0%} of the last trials succeed", flush=True)


def success(model: PPO, patients: int) -> float:
    """The share of patients that it has not seen with whom the trained hand succeeds."""
    env = VecFrameStack(GoOrStop(patients), 4)
    env.seed(FIRST_UNSEEN)
    seen, outcome = env.reset(), np.full(patients, -1)
    while (outcome < 0).any():
        action, _ = model.predict(seen)  # at random, as trained: its most probable actions alone hardly ever go on
        seen, _, done, infos = env.step(action)
        for i in np.flatnonzero(done & (outcome < 0)):
            outcome[i] = infos[i]["is_success"]
    return float(outcome.mean())


def main() -> None:
    given = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    given.add_argument("--decisions", type=int, default=120_000, help="of all trials together")
    given.add_argument("--seed", type=int, default=0)
    given.add_argument("--patients", type=int, default=200, help="of the trial after the training")
    given.add_argument("--plot", help="a file for the curve of the training")
    chosen = given.parse_args()
    torch.set_num_threads(1)  # several wait for each other at so small a network
    env = VecFrameStack(GoOrStop(64), 4)
    model = PPO("MlpPolicy", env, n_steps=64, batch_size=512, ent_coef=0.003, seed=chosen.seed, device="cpu")
    curve, began = Curve(), time.monotonic()
    model.learn(chosen.decisions, callback=curve)
    print(f"trained in {time.monotonic() - began:.0f} s")
    print(f"PPO: {success(model, chosen.patients):4.0%} of {chosen.patients} unseen patients succeed")
    if chosen.plot:
        import matplotlib.pyplot as plt

        decisions, share = np.array(curve.points).T
        figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
        axes.plot(decisions, 100 * share)
        axes.set(xlabel="decisions of all trials", ylabel="success of the last 200 (%)", xlim=(0, None), ylim=(0, 100))
        axes.grid(alpha=0.3)
        figure.savefig(chosen.plot)


if __name__ == "__main__":
    main()
