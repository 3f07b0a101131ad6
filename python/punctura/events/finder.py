"""Finds the events of a run at its membranes, batch by batch or all at once."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

from punctura import Scene, _core
from punctura.ticks import Ticks

if TYPE_CHECKING:
    import pyarrow as pa

    from punctura.record import Recording


Finite = Annotated[float, Field(allow_inf_nan=False)]


class Event(BaseModel):
    """An event, in SI units. Forces are the model's, along the needle, before safety limits. Only a pop has forces."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    what: Literal["touch", "pop", "out"]  # tip enters; slanted face is through; tip has left
    membrane: int  # index in the scene, from 0
    name: str  # of the membrane
    tick: int  # its number, from 0
    time: Finite  # s, of the tick
    depth: Finite  # m: along the needle while inside, else along the normal
    force_before: Finite = 0.0  # N, largest resistance before the pop
    force_after: Finite = 0.0  # N, resistance of the shaft alone after the pop
    drop: Finite = 0.0  # N, force_before - force_after


class Crossing(NamedTuple):
    """The steps of a needle through a membrane, as depths of the tip behind the surface along the needle, m."""

    cos_beta: float  # n.b, with b the needle's direction at entry
    far_face: float  # the point of the tip leaves the far face: U
    peak: float  # the resistance -Phi_I is largest
    through: float  # the whole slanted face has left the far face; from here only the shaft has friction: X + U
    again: float  # a tip that is pulled back to this depth can pop again
    shaft: float  # N, friction of the shaft alone: F / n.b


def crossing(scene: Scene, membrane: int, cos_beta: float) -> Crossing:
    """The crossing of one membrane of a scene, by its index, for a needle with n.b = cos_beta. Raises IndexError."""
    return Crossing(*_core.crossing(scene, membrane, cos_beta))


class EventFinder:
    """Finds events in the order of ticks. The result does not depend on how the ticks are split into batches.

    A batch has columns of Listener.read(). `depth`, `axial_force` and `phase` are required; `tick`, `time`, `lower`,
    `direction`, `axis` and `commands` are optional.
    """

    def __init__(self, scene: Scene, rate: float | None = None) -> None:
        """rate: ticks per second, for runs without a time column; default: the scene's rate. Raises ValueError."""
        if rate is not None and not (math.isfinite(rate) and rate > 0):
            raise ValueError(f"rate must be greater than 0 Hz, not {rate}")
        self._finder = _core.EventFinder(scene, scene.servo.rate if rate is None else rate)

    def __repr__(self) -> str:
        return repr(self._finder)

    def change(self, scene: Scene) -> None:
        """Gives the scene that the run changes to: it applies from the next tick whose commands mark a new scene."""
        self._finder.change(scene)

    def add(self, columns: Ticks | dict[str, NDArray[Any]]) -> list[Event]:
        """The events of the next ticks."""
        return [Event(**found) for found in self._finder.add(columns)]


def recorded_ticks(recording: Recording) -> Iterator[tuple[Ticks, Scene | None]]:
    """Yields all ticks in order. The scene is set after a scene change, else None."""
    # A recording is there, so what reads it is loaded. Events of Ticks need none of it.
    from punctura.record.columns import NEW_SCENES, ticks_of
    from punctura.record.header import from_text

    def new_scenes(batch: pa.RecordBatch) -> list[tuple[int, list[str]]]:
        if NEW_SCENES not in batch.schema.names:
            return []
        column = batch.column(NEW_SCENES)
        rows = np.flatnonzero(np.asarray(column.is_valid()))
        return [(int(row), texts) for row in rows if (texts := column[int(row)].as_py())]

    for batch in recording.batches():
        start = 0
        for row, texts in new_scenes(batch):
            if row > start:
                yield ticks_of(batch.slice(start, row - start)), None
            end = next((later for later, _ in new_scenes(batch) if later > row), len(batch))
            yield ticks_of(batch.slice(row, end - row)), from_text(texts[-1], recording.path)
            start = end
        if start < len(batch):
            yield ticks_of(batch.slice(start)), None


def recorded_events(recording: Recording, scene: Scene | None = None) -> Iterator[tuple[Ticks, list[Event]]]:
    """Yields all ticks with the events in them. scene: replaces the recorded scene.

    A pop is where the scene's law lets the tip through, so a run with the force of a rival has none.
    """
    first = scene or recording.info.scene
    finder = EventFinder(first, first.servo.rate)
    with_pops = not recording.info.rivals
    for ticks, new_scene in recorded_ticks(recording):
        if new_scene is not None:
            finder.change(new_scene)
        yield ticks, [event for event in finder.add(ticks) if with_pops or event.what != "pop"]


def find_events(recording: Recording | Ticks, scene: Scene | None = None) -> list[Event]:
    """All events of a recording or of Ticks. scene: replaces the recorded scene; Ticks need one.

    A recording with the force of a rival has no pops, as a warning says. Raises RecordingError, TypeError for Ticks
    without a scene.
    """
    if isinstance(recording, Ticks):
        if scene is None:
            raise TypeError("find_events of Ticks needs the scene of the run: find_events(ticks, scene)")
        return EventFinder(scene).add(recording)
    if recording.info.rivals:
        names = " and ".join(rival.name for rival in recording.info.rivals)
        text = f"{recording.path}: the force is that of {names}, and pops follow from the scene's law: none is listed"
        warnings.warn(text, UserWarning, stacklevel=2)
    return [event for _, events in recorded_events(recording, scene) for event in events]
