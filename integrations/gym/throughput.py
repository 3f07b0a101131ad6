"""Servo ticks a second through the vector interface, with everything that a learner pays for.

    python integrations/gym/throughput.py

Servo step, simulated device and hand, observations, rewards and resets count. The best of several rounds is printed.
"""

from __future__ import annotations

import argparse
import os
import platform
import time
from datetime import date
from pathlib import Path

import gymnasium
import numpy as np
import punctura.gym


def processor() -> str:
    """The processor's name."""
    info = Path("/proc/cpuinfo")
    names = [line.split(":")[1].strip() for line in info.read_text().splitlines() if line.startswith("model name")]
    return names[0] if names else platform.processor()


def measure(task: str, count: int, threads: int, rounds: int) -> tuple[float, float]:
    """(ticks per second, ticks per second of one core's time)"""
    env = gymnasium.make_vec(f"punctura/{task}-v0", num_envs=count, threads=threads)
    env.reset(seed=0)
    random = np.random.default_rng(0)
    trials = env.unwrapped.trials
    best, best_cpu = 0.0, 0.0
    for _ in range(rounds):
        actions = random.uniform(-0.2, 0.8, (20, count, 1)).astype(np.float32)
        wall, cpu = time.perf_counter(), time.process_time()
        for action in actions:
            env.step(action)
        ticks = len(actions) * count * trials.ticks
        best = max(best, ticks / (time.perf_counter() - wall))
        best_cpu = max(best_cpu, ticks / (time.process_time() - cpu))
    return best, best_cpu


def main() -> None:
    """Prints a table."""
    given = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    given.add_argument("--envs", type=int, default=256)
    given.add_argument("--rounds", type=int, default=10)
    options = given.parse_args()
    assert punctura.gym.TASKS
    print(
        f"{processor()}, {os.cpu_count()} processors, {date.today()}; {options.envs} trials of 3 membranes and a hand"
    )
    for threads in sorted({1, os.cpu_count() or 1}):
        wall, cpu = measure("Venipuncture", options.envs, threads, options.rounds)
        print(f"{threads:2d} threads: {wall:12,.0f} ticks/s, {cpu:12,.0f} ticks per second of processor time")


if __name__ == "__main__":
    main()
