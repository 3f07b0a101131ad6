"""Needle runs in the columns of a listener, for the tests of events and exercises."""

import itertools
from typing import Any

import numpy as np
import punctura as pn
from punctura.simulation import Experiment

Columns = dict[str, np.ndarray]


def along(scene: pn.Scene, path: Any, axis: Any = None) -> Columns:
    """Moves the tip along the first membrane's normal, or `axis`, through these depths (m) from its point, per tick."""
    normal = unit(scene.membranes[0].inward_normal if axis is None else axis)
    position = np.asarray(scene.membranes[0].point) + np.outer(path, normal)
    return moved(scene, position, normal)


def moved(scene: pn.Scene, position: np.ndarray, axis: np.ndarray) -> Columns:
    """Moves the tip through these positions, one per tick: (n, 3), m."""
    trace = pn.Insertion(scene).run(position, axis)
    return {**of_trace(trace), "model_force": trace.force, **_more(scene, position, axis)}


def ramp(scene: pn.Scene, *depths: float, speed: float = 5e-3) -> np.ndarray:
    """From depth to depth (m) at one speed (m/s), at the scene's rate."""
    step = speed / scene.servo.rate
    parts = [np.linspace(a, b, max(2, round(abs(b - a) / step)), endpoint=False) for a, b in itertools.pairwise(depths)]
    return np.concatenate([*parts, depths[-1:]])


def experiment(scene: pn.Scene, motion: Any, duration: float, axis: Any, seed: int = 0) -> Columns:
    """Runs a simulated hand at a simulated device."""
    trace = Experiment(scene, motion, seed=seed, axis=axis).run(duration)
    return {
        **of_trace(trace),
        "model_force": trace.model_force,
        "force": trace.force,
        "ceiling": trace.ceiling,
        "force_scale": trace.force_scale,
        **_more(scene, trace.position, unit(axis)),
    }


def of_trace(trace: Any) -> Columns:
    return {name: getattr(trace, name) for name in ("depth", "axial_force", "lower", "upper", "phase")}


def _more(scene: pn.Scene, position: np.ndarray, axis: np.ndarray) -> Columns:
    n = len(position)
    tick = np.arange(n, dtype=np.uint64)
    return {"tick": tick, "time": tick / scene.servo.rate, "tip": position, "axis": np.tile(axis, (n, 1))}


def cut(columns: Columns, places: Any) -> list[Columns]:
    """Splits the columns into batches, before each of the given rows."""
    n = len(columns["depth"])
    edges = [0, *sorted({int(p) for p in places} - {0, n}), n]
    return [{k: v[a:b] for k, v in columns.items()} for a, b in itertools.pairwise(edges)]


def unit(vector: Any) -> np.ndarray:
    array = np.asarray(vector, dtype=float)
    return array / np.linalg.norm(array)
