"""The same motion through scenes that differ in one parameter."""

from collections.abc import Iterator, Sequence

import numpy as np

from punctura import ConfigurationError, Scene, simulate
from punctura.compare.motion import Motion, stroke
from punctura.compare.run import Run

MOST_RUNS = 25
MOST_SECONDS = 600.0  # of all runs together


class VaryError(ValueError):
    """A variation that is not possible; the text says why and what to do."""


def vary(scene: Scene, path: str, values: Sequence[float], motion: Motion | None = None) -> Iterator[Run]:
    """Yields a run for each value of a parameter (SI), all with the same motion; default: a stroke at 5 mm/s.

    path: of a field, as in `scene.fields()`. Raises VaryError before the first run; the scenes are checked, too.
    """
    motion = stroke(scene) if motion is None else motion
    if not 1 <= len(values) <= MOST_RUNS:
        raise VaryError(f"a variation has 1 to {MOST_RUNS} runs, not {len(values)}")
    if motion.seconds * len(values) > MOST_SECONDS:
        total = motion.seconds * len(values)
        raise VaryError(
            f"{len(values)} runs of {motion.seconds:.0f} s are {total:.0f} s; at most {MOST_SECONDS:g} s are "
            "simulated: take fewer values or a shorter motion"
        )
    fields = {one.path: one for one in scene.fields()}
    if path not in fields:
        raise VaryError(f"the scene has no field {path}; scene.fields() lists them")
    try:
        scenes = [scene.with_values({path: float(value)}) for value in values]
    except ConfigurationError as error:
        raise VaryError(str(error)) from None
    return _runs(scenes, path, fields[path].unit, values, motion)


def _runs(scenes: Sequence[Scene], path: str, unit: str, values: Sequence[float], motion: Motion) -> Iterator[Run]:
    for scene, value in zip(scenes, values, strict=True):
        ticks = simulate(scene, motion.position, time=motion.time, axis=motion.axis)
        full = np.broadcast_to(motion.axis, (len(motion.time), 3))
        if "axis" not in ticks:
            at = np.interp(ticks.time, motion.time, np.arange(len(motion.time)))
            ticks = ticks.replace(axis=full[np.round(at).astype(int)])
        yield Run.of_ticks(f"{path} = {value:g} {unit}".strip(), scene, ticks)
