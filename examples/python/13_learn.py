"""Reinforcement learning: a hand learns by trial and error to stop behind the pop, from the force that it feels.

It goes on until the force has fallen from its peak by so much, then it stops. The speed and that fall are learnt by the
cross-entropy method: try many, keep the best, try near them. Each trial has another patient.
"""

import gymnasium
import numpy as np
import punctura.gym
from numpy.typing import NDArray

Array = NDArray[np.float64]
TRIALS, BEST, GENERATIONS = 96, 16, 8
FORCE, HIGHEST = (punctura.gym.OBSERVATION.index(name) for name in ("force_N", "highest_force_N"))
envs = gymnasium.make_vec("punctura/StopAfterPop-v0", num_envs=TRIALS)


def rewards(speed: Array, fall: Array, seed: int) -> Array:
    """One trial for each speed (-1 to 1) and fall of the force (N)."""
    seen, _ = envs.reset(seed=seed)
    highest, total = np.zeros((2, TRIALS))
    stopped, goes_on = np.zeros(TRIALS, bool), np.ones(TRIALS, bool)
    while goes_on.any():
        highest = np.maximum(highest, seen[:, HIGHEST])
        stopped |= highest - seen[:, FORCE] > fall
        speeds = np.where(stopped, 0, speed).astype(np.float32)
        seen, reward, ended, late, _ = envs.step(speeds[:, None])
        total += np.where(goes_on, reward, 0)
        goes_on &= ~(ended | late)
    return total


rng = np.random.default_rng(1)
mean, spread = np.array([0.5, np.log(0.5)]), np.array([0.3, 1.0])  # of the speed, of the logarithm of the fall
curve = []
for generation in range(GENERATIONS):
    tried = mean + spread * rng.standard_normal((TRIALS, 2))
    speed, fall = np.clip(tried[:, 0], 0.02, 1), np.exp(tried[:, 1])
    reward = rewards(speed, fall, seed=1000 * generation)
    curve.append(float((reward > 0).mean()))
    best = tried[np.argsort(reward)[-BEST:]]
    mean, spread = best.mean(axis=0), best.std(axis=0) + 0.02
    print(f"generation {generation}: {100 * curve[-1]:3.0f} % of the trials stop behind the pop")
print(f"learnt: {20 * np.clip(mean[0], 0.02, 1):.1f} mm/s, until the force has fallen by {np.exp(mean[1]):.2f} N")
