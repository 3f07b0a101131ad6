"""Finds the events in a run, batch by batch."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from punctura import Scene
from punctura.events.contact import Contact, Happening, resistance_of
from punctura.events.crossing import Crossing, crossing
from punctura.events.event import Event
from punctura.ticks import Columns, Ticks

_COMMAND_SCENE = 8


class EventFinder:
    """Events of a run, in the order of ticks, however its ticks are cut into batches.

    A batch has the columns of Listener.read(); of them `depth`, `axial_force` and `phase` are needed, `tick`, `time`,
    `lower`, `direction`, `axis` and `commands` used where they are there.
    """

    def __init__(self, scene: Scene, rate: float | None = None) -> None:
        """rate: ticks a second, for runs that do not tell the time; the scene's own if not given."""
        self._rate = rate or scene.servo.rate
        self._scene = scene
        self._next: Scene | None = None
        self._contacts = [Contact() for _ in scene.membranes]
        self._ticks = 0

    def change(self, scene: Scene) -> None:
        """The run goes on in another scene, from the next tick on that says that it has taken one."""
        self._next = scene

    def add(self, columns: Ticks | dict[str, NDArray[Any]]) -> list[Event]:
        """The events of the next ticks."""
        n = len(columns["depth"])
        if n == 0:
            return []
        events: list[Event] = []
        start = 0
        if self._next is not None:
            commands = columns.get("commands")
            taken = np.zeros(1, dtype=np.intp) if commands is None else np.flatnonzero(commands & _COMMAND_SCENE)
            if len(taken):
                start = int(taken[0])
                events += self._find({name: column[:start] for name, column in columns.items()}) if start else []
                self._switch(self._next)
                self._next = None
        events += self._find({name: column[start:] for name, column in columns.items()} if start else columns)
        return events

    def _switch(self, scene: Scene) -> None:
        """Membranes in the same place go on, under their new law; others begin anew, as in the servo step."""
        before, self._scene = self._scene, scene
        kept = [_same_place(before, scene, i) for i in range(len(scene.membranes))]
        self._contacts = [self._contacts[i] if kept[i] else Contact() for i in range(len(scene.membranes))]
        for i, contact in enumerate(self._contacts):
            if contact.crossing is not None:
                contact.crossing = crossing(scene, i, contact.crossing.cos_beta)

    def _find(self, columns: Columns) -> list[Event]:
        first, n = self._ticks, len(columns["depth"])
        self._ticks += n
        found: list[tuple[int, int, Happening]] = []
        for i in range(min(len(self._contacts), columns["depth"].shape[1])):
            found += [(happening.row, i, happening) for happening in self._follow(columns, i)]
        found.sort(key=lambda one: one[:2])
        return [self._event(columns, first, i, happening) for _, i, happening in found]

    def _follow(self, columns: Columns, i: int) -> Iterator[Happening]:
        depth = np.asarray(columns["depth"][:, i], dtype=np.float64)
        enter = partial(self._enter, columns, i)
        return self._contacts[i].follow(columns["phase"][:, i], depth, *resistance_of(columns, i), enter)

    def _enter(self, columns: Columns, i: int, row: int) -> Crossing:
        return crossing(self._scene, i, entry_cosine(self._scene, columns, i, row))

    def _event(self, columns: Columns, first: int, i: int, happening: Happening) -> Event:
        row = happening.row
        tick = int(columns["tick"][row]) if "tick" in columns else first + row
        time = float(columns["time"][row]) if "time" in columns else tick / self._rate
        before, after = happening.before, happening.after
        return Event(
            what=cast(Any, happening.what),
            membrane=i,
            name=self._scene.membranes[i].name,
            tick=tick,
            time=time,
            depth=float(columns["depth"][row, i]),
            force_before=before,
            force_after=after,
            drop=before - after,
        )


def entry_cosine(scene: Scene, columns: Columns, i: int, row: int) -> float:
    """n.b of a row in which the tip is inside: by the direction held since entry, else by the stylus, else 1."""
    normal = np.asarray(scene.membranes[i].inward_normal, dtype=np.float64)
    normal = normal / np.linalg.norm(normal)
    for name in ("direction", "axis"):
        if name not in columns:
            continue
        row_of = np.asarray(columns[name][row], dtype=np.float64)
        b = row_of[i] if row_of.ndim == 2 else row_of
        length = float(np.linalg.norm(b))
        if math.isfinite(length) and length > 0:
            return float(normal @ b) / length
    return 1.0


def _same_place(before: Scene, after: Scene, i: int) -> bool:
    if i >= len(before.membranes):
        return False
    one, other = before.membranes[i], after.membranes[i]
    return tuple(one.point) == tuple(other.point) and tuple(one.inward_normal) == tuple(other.inward_normal)
