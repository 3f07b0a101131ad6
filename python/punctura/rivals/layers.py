"""One rival in each layer of the tissue: the force on the needle is the sum, along the motion that was measured."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from punctura._core import Rival
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.toml import read_text
from punctura.files.whole_file import write_whole
from punctura.rivals.kinds import Shows
from punctura.trace import Segments, Trace

Array = NDArray[np.float64]
ASSUMED_SPEED = 5e-3  # m/s, for a trace without time


@dataclass(frozen=True)
class Path:
    """Depth, velocity and time steps of a trace (n,), SI. A trace without time moves at ASSUMED_SPEED."""

    depth: Array
    velocity: Array
    period: Array
    shows: frozenset[Shows]  # what the numbers of a rival can be read from

    def slow(self) -> float:
        """A velocity that separates moving from resting, m/s: a tenth of the usual speed."""
        moving = np.abs(self.velocity[self.velocity != 0])
        return float(np.clip(0.1 * np.median(moving), 1e-6, 0.1)) if len(moving) else 1e-4


def path_of(trace: Trace, segments: Segments) -> Path:
    """The path of a trace. In a hold the velocity is 0, so that noise of the depth does not count as motion."""
    if trace.time is None:
        steps = np.abs(np.diff(trace.depth, prepend=trace.depth[0]))
        period = np.maximum(steps / ASSUMED_SPEED, 1e-9)
    else:
        period = np.diff(trace.time, prepend=trace.time[0] - float(np.median(np.diff(trace.time))))
    velocity = np.gradient(trace.depth, np.cumsum(period))
    for stroke in segments.strokes:
        rows = slice(stroke.start, stroke.end)
        if stroke.kind == "hold":
            velocity[rows] = 0.0
        else:  # noise of the depth must not turn the needle round
            sign = 1.0 if stroke.kind == "in" else -1.0
            velocity[rows] = sign * np.maximum(sign * velocity[rows], 1e-9)
    shows: set[Shows] = {"insertion"}
    if any(stroke.kind == "out" for stroke in segments.strokes):
        shows.add("withdrawal")
    if segments.holds or (trace.time is not None and _speeds_differ(velocity, segments)):
        shows.add("speeds")
    return Path(trace.depth, velocity, period, frozenset(shows))


def _speeds_differ(velocity: Array, segments: Segments) -> bool:
    """Whether two insertions have speeds that differ by more than a half."""
    speeds = [float(np.median(velocity[s.start : s.end])) for s in segments.strokes if s.kind == "in"]
    return len(speeds) > 1 and max(speeds) > 1.5 * min(speeds)


FORMAT = "punctura rival 1"


@dataclass(frozen=True)
class Layer:
    """A rival behind a surface. surface: its depth, m, on the depth axis of the trace."""

    surface: float
    rival: Rival  # with its numbers

    def resistance(self, path: Path) -> Array:
        """The force against the insertion (n,), N."""
        return self.rival.resistance(path.depth - self.surface, path.velocity, path.period)


def resistance(layers: tuple[Layer, ...], path: Path) -> Array:
    """The force of all layers against the insertion (n,), N."""
    total = np.zeros(len(path.depth))
    for layer in layers:
        total += layer.resistance(path)
    return total


def save_layers(file: str | os.PathLike[str], layers: tuple[Layer, ...]) -> None:
    """Writes layers as JSON, for `punctura simulate --rival`. Raises OSError."""
    found = [{"surface_m": one.surface, "rival": one.rival.name, "numbers": one.rival.numbers} for one in layers]
    write_whole(FilePath(file), (json.dumps({"format": FORMAT, "layers": found}, indent=2) + "\n").encode())


def load_layers(file: str | os.PathLike[str]) -> tuple[Layer, ...]:
    """Reads layers from a file of save_layers(). Raises ConfigurationError."""
    try:
        held: Any = json.loads(read_text(FilePath(file), "rival"))
        if not isinstance(held, Mapping) or held.get("format") != FORMAT:
            raise _wrong(file, f'is no file of punctura rivals --out: it must have "format": "{FORMAT}"')
        return tuple(Layer(float(one["surface_m"]), Rival(one["rival"], one["numbers"])) for one in held["layers"])
    except ConfigurationError:
        raise
    except json.JSONDecodeError as error:
        raise _wrong(file, f"is no JSON, as punctura rivals --out writes it: {error}") from None
    except (KeyError, TypeError, ValueError, RecursionError) as error:
        raise _wrong(file, f"each layer needs surface_m, rival and numbers ({error!r})") from None


def _wrong(file: str | os.PathLike[str], reason: str) -> ConfigurationError:
    return ConfigurationError([Problem("", MISSING, reason)], os.fspath(file))
