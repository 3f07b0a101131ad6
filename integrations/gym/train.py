"""Trains a hand that finds the vein by its pop, with the cross-entropy method, and compares it with a blind hand.

    python integrations/gym/train.py                                     Venipuncture, about a minute on 2 cores
    python integrations/gym/train.py --task Epidural --seconds 120

Each generation draws hands around the best so far and tries all of them with the same patients. No network, no gradient
and nothing but NumPy: a start, not a limit.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import replace

import numpy as np
from policy import StopsAfterPop, StopsAtDepth
from punctura.gym import TASKS, NeedleVectorEnv

HANDS, PATIENTS, BEST = 24, 12, 6
FIRST_UNSEEN = 1_000_000  # seed of the first patient of the test


def run(env: NeedleVectorEnv, hand: StopsAfterPop | StopsAtDepth, seeds: list[int]) -> tuple[np.ndarray, np.ndarray]:
    """Reward and success of one trial for each seed."""
    seen, _ = env.reset(seed=seeds)
    reward, success, open_ = np.zeros(len(seeds)), np.zeros(len(seeds), bool), np.ones(len(seeds), bool)
    while open_.any():
        seen, earned, ended, late, info = env.step(hand.act(seen, env.task.decision))
        reward += open_ * earned
        success |= open_ & info["success"]
        open_ &= ~(ended | late)
    return reward, success


def train(kind: type, env: NeedleVectorEnv, seconds: float, seed: int, generations: int) -> np.ndarray:
    """The numbers of the best hand after `seconds`, or after `generations`."""
    random, middle, spread = np.random.default_rng(seed), kind.start.copy(), kind.spread.copy()
    begin = time.monotonic()
    for generation in range(generations):
        if time.monotonic() - begin > seconds:
            break
        hands = middle + spread * random.normal(size=(HANDS, middle.size))
        patients = [1000 * generation + i for i in range(PATIENTS)]
        reward, success = run(env, kind(np.repeat(hands, PATIENTS, axis=0)), patients * HANDS)
        order = np.argsort(-reward.reshape(HANDS, PATIENTS).mean(axis=1))
        chosen = hands[order[:BEST]]
        middle, spread = chosen.mean(axis=0), chosen.std(axis=0) + 0.02 * kind.spread
        best = success.reshape(HANDS, PATIENTS)[order[:BEST]].mean()
        print(f"  generation {generation + 1:2d}: {best:4.0%} of the best hands' trials succeed", flush=True)
    return middle


def main() -> None:
    """Trains both hands and prints their success with patients that neither has seen."""
    given = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    given.add_argument("--task", choices=sorted(TASKS), default="Venipuncture")
    given.add_argument("--seconds", type=float, default=45, help="for the training of each hand")
    given.add_argument("--generations", type=int, default=8)
    given.add_argument("--seed", type=int, default=0)
    given.add_argument("--test-patients", type=int, default=200)
    options = given.parse_args()
    task = TASKS[options.task]
    short = replace(task, time_limit=0.3 * task.time_limit)  # slow hands need not be tried to the end
    rows = []
    for kind in (StopsAfterPop, StopsAtDepth):
        print(f"{kind.__name__}:")
        begin = time.monotonic()
        numbers = train(
            kind, NeedleVectorEnv(short, HANDS * PATIENTS), options.seconds, options.seed, options.generations
        )
        spent = time.monotonic() - begin
        n = options.test_patients
        unseen = [FIRST_UNSEEN + i for i in range(n)]
        _, success = run(NeedleVectorEnv(task, n), kind(np.tile(numbers, (n, 1))), unseen)
        rows.append((kind.__name__, success.mean(), spent, np.round(numbers, 2)))
    print(f"\n{options.task}: success with {n} patients that were not seen in the training")
    for name, share, spent, numbers in rows:
        print(f"  {name:14s} {share:4.0%}   trained in {spent:.0f} s   {numbers}")


if __name__ == "__main__":
    main()
