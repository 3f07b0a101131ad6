"""Trials of a task at a fleet: what the learner gets and gives, and the rules that all environments share."""

from __future__ import annotations

import math
from typing import NamedTuple, cast

import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box, Space

from punctura import load_scene
from punctura._core import Fault, Fleet, Hand, Plant
from punctura.gym.picture import Picture
from punctura.gym.population import Population
from punctura.gym.tasks import Task
from punctura.results import FleetStep

OBSERVATION = ("force_N", "lowest_force_N", "highest_force_N", "depth_mm", "speed_mm_s")
"""The columns of an observation, each measured at the device: the force along the needle now, and its lowest and
highest value since the last observation (positive holds the needle back); the way along the needle since the start; the
mean speed since the last observation."""

_BOUNDS = np.array([20, 20, 20, 200, 1000], np.float32)

Observations = npt.NDArray[np.float32]


def observation_space() -> Space[Observations]:
    """Five numbers, see OBSERVATION."""
    return cast(Space[Observations], Box(-_BOUNDS, _BOUNDS, dtype=np.float32))


def action_space() -> Space[npt.NDArray[np.float32]]:
    """The speed of the hand along the needle, as a share of the fastest: -1 back, 1 forward."""
    return cast(Space[npt.NDArray[np.float32]], Box(-1, 1, (1,), np.float32))


def observations(step: FleetStep) -> Observations:
    """(n, 5)"""
    columns = (
        step["force"], step["lowest_force"], step["highest_force"], 1e3 * step["travel"], 1e3 * step["speed"],
    )  # fmt: skip
    return np.clip(np.stack(columns, axis=1), -_BOUNDS, _BOUNDS).astype(np.float32)


Flags = npt.NDArray[np.bool_]


class Outcome(NamedTuple):
    """The results of a step, one row a trial."""

    observation: Observations
    reward: npt.NDArray[np.float64]
    terminated: Flags
    truncated: Flags
    success: Flags  # at rest in the space for long enough
    pierced: Flags  # went too far
    fault: npt.NDArray[np.uint8]  # the latched Fault of the servo step


class Trials:
    """n trials. Rewards: success 1 minus half the share of the time limit that was used; a needle that goes too far,
    or a fault, -1; otherwise 0."""

    def __init__(
        self, task: Task, n: int, population: Population | None, plant: Plant | None, hand: Hand | None, threads: int,
        max_steps: int | None = None,
    ) -> None:  # fmt: skip
        if isinstance(n, bool) or not isinstance(n, int | np.integer):
            raise TypeError(f"num_envs is {n!r}: it must be a whole number")
        if n < 1:
            raise ValueError(f"num_envs is {n}: there must be at least 1 environment")
        if not isinstance(population, Population | None):
            raise TypeError(f"population is {population!r}, not a punctura.gym.Population")
        if max_steps is not None and (isinstance(max_steps, bool) or not isinstance(max_steps, int | np.integer)):
            raise TypeError(f"max_episode_steps is {max_steps!r}: it must be a whole number")
        if max_steps is not None and max_steps < 1 and max_steps != -1:
            raise ValueError(f"max_episode_steps is {max_steps}: it must be at least 1, or -1 for the task's own limit")
        self.task, self.n = task, n
        self.population = population or Population(load_scene(task.scene), task.vary)
        count = len(self.population.scene.membranes)
        if max(task.wall, task.next_wall or 0) >= count:
            raise ValueError(f"the scene of the population has {count} membranes, too few for this task")
        # A vector of lanes costs as much as 2 to 4 trials alone, however few of its lanes are in use.
        few = "portable" if n < 4 else None
        self.fleet = Fleet(task.axis, plant or Plant(), hand or Hand(), threads, few)
        self.rate = self.population.scene.servo.rate
        self.ticks = max(1, round(task.decision * self.rate))
        self.period = self.ticks / self.rate
        own = task.time_limit / self.period - 0.5
        self.max_steps = max(1, math.ceil(own)) if math.isfinite(own) else None  # after them a trial is late
        if max_steps is not None and max_steps > 0:
            self.max_steps = min(int(max_steps), self.max_steps or int(max_steps))
        self.pictures: dict[int, Picture] = {}  # by trial, if the environment draws
        self._begin, self._end = np.zeros(n), np.zeros(n)
        self._steps, self._rest = np.zeros(n, int), np.zeros(n)

    def start(self, i: int, random: np.random.Generator, draws: bool = False) -> None:
        """Starts trial i anew, with a scene, a distance to the skin and a tremor that `random` draws. draws: with a
        picture."""
        scene = self.population.draw(random)
        distance = random.uniform(*self.task.distance)
        start = -distance * np.array(self.task.axis)
        self.fleet.place(i, scene, start, int(random.integers(2**63)))
        self._begin[i], self._end[i] = self.task.space(scene)
        self._steps[i] = self._rest[i] = 0
        if draws:
            self.pictures[i] = Picture(scene, start, np.array(self.task.axis))

    def first(self) -> Observations:
        """(n, 5) The observation before the first step: nothing is felt, nothing has moved."""
        return np.zeros((self.n, len(OBSERVATION)), np.float32)

    def step(self, action: npt.ArrayLike, begins: Flags | None = None) -> Outcome:
        """action (n,) or (n, 1): share of the fastest speed; clipped to -1 ... 1. begins (n,): trials whose action is
        ignored. Raises TypeError if an action is no number, ValueError for another number of actions, or if one is not
        finite."""
        task = self.task
        given = np.asarray(action)
        if given.dtype.kind not in "fiu":
            raise TypeError(f"the actions must be numbers, not {action!r}")
        given = given.astype(float)
        if given.size != self.n or given.shape[:1] not in ((), (self.n,)):
            raise ValueError(f"the actions have the shape {given.shape}; they need {(self.n, 1)}")
        given = given.reshape(self.n)
        if begins is not None:
            given[begins] = 0
        if not np.isfinite(given).all():
            i = int(np.flatnonzero(~np.isfinite(given))[0])
            raise ValueError(f"action {i} is {given[i]}: an action must be a finite number. No trial made a tick")
        share = np.clip(given, -1, 1)
        step = self.fleet.step(share * task.fastest, self.ticks)
        for i, picture in self.pictures.items():
            picture.add(step["travel"][i], step["lowest_force"][i], step["highest_force"][i])
        self._steps += 1
        depth, deepest = step["depth"], step["deepest"]
        pierced = deepest[:, task.wall] > self._end
        if task.next_wall is not None:
            pierced |= deepest[:, task.next_wall] > task.press
        resting = (depth[:, task.wall] >= self._begin) & ~pierced & (np.abs(step["speed"]) < task.still)
        self._rest = np.where(resting, self._rest + self.period, 0)
        fault = step["fault"]
        failed = pierced | (fault != Fault.none.value)
        success = (self._rest >= task.hold - self.period / 2) & ~failed
        late = self._steps >= (self.max_steps or math.inf)
        used = self._steps * self.period / task.time_limit
        reward = np.where(failed, -1.0, np.where(success, 1 - 0.5 * used, 0.0))
        terminated = failed | success
        return Outcome(observations(step), reward, terminated, late & ~terminated, success, pierced, fault)
