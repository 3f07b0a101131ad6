"""What the learner gets and gives: what a hand feels, and how fast the hand moves."""

from __future__ import annotations

from typing import cast

import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box, Space

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
