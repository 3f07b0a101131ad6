"""NeedleVecEnv gives a learner what Stable-Baselines3's own make_vec_env gives it, to the bit."""

import numpy as np
import punctura.gym  # noqa: F401  registers the environments
from punctura.gym.stable_baselines import NeedleVecEnv
from stable_baselines3.common.env_util import make_vec_env

ours, theirs = NeedleVecEnv("StopAfterPop", 4), make_vec_env("punctura/StopAfterPop-v0", n_envs=4, seed=5)
ours.seed(5)
actions, ended = np.array([[1], [0.7], [0], [0.5]], np.float32), 0
np.testing.assert_array_equal(ours.reset(), theirs.reset())
for _ in range(300):
    (*columns, infos), (*also_columns, also_infos) = ours.step(actions), theirs.step(actions)
    np.testing.assert_equal(columns, also_columns)
    for i in np.flatnonzero(columns[-1]):
        ended += 1
        for word in ("terminal_observation", "TimeLimit.truncated", "success", "pierced", "fault"):
            np.testing.assert_equal(infos[i][word], also_infos[i][word])
        episode, also = infos[i]["episode"], also_infos[i]["episode"]
        assert episode["l"] == also["l"] and abs(episode["r"] - also["r"]) < 1e-5
assert ended >= 10
print(f"300 steps and {ended} ends of trials are the same")
