"""The ticks of an attempt as they are judged: geometry, moments, and the target space."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from punctura import Scene
from punctura._core import ServoState, grazing_cosine, tip_length
from punctura.events import Event
from punctura.ticks import ABSENT, COMMAND_SCENE, INSIDE, Columns

Numbers = NDArray[np.float64]
Flags = NDArray[np.bool_]

ROUNDING = 1e-12  # m
LATE_S = 0.3  # a page without a word for longer is late: it speaks ten times a second
GONE_S = 1.0  # a needle that such a page holds neither stays nor stops. Longer, so that a slow computer can pass
_OFF = [state.value for state in (ServoState.disarmed, ServoState.waiting, ServoState.faulted)]  # no force


@dataclass
class JudgedTicks:
    """n ticks, m membranes. Depths are the model's: a wall that is only pushed ahead does not count as pierced."""

    tick: NDArray[np.int64]
    time: Numbers  # s
    own: Numbers  # s, on the needle's own clock: on a simulated device nothing moves while a tick is late
    tip: Numbers  # (n, 3), m
    held: Numbers  # (n, 3), the needle's direction: fixed by the first membrane at entry, else the stylus's
    angle: Numbers  # rad, between it and the first membrane's surface; NaN if unknown
    force: Numbers  # N, the norm of the model's force; NaN if unknown
    model: Numbers  # N, the model's force against the needle, along it
    felt: Numbers  # N, the same of the felt force; the model's if only that is known
    felt_size: Numbers  # N, the norm of the felt force
    ceiling: Numbers  # N, what all limits permit; 0 while the force is off
    force_scale: Numbers  # how much of the model's force the device gives, before the limits
    push: Numbers  # N, the thumb on the syringe's plunger; NaN if unknown
    push_felt: Numbers  # N, of it what a second device gave, after force scale and limits; 0 without one
    thumb: Numbers  # m, how far the thumb has moved in; NaN if unknown
    plunger: Numbers  # m, the same of the plunger
    injected: Numbers  # m^3 that have left the syringe; NaN if unknown
    fault: NDArray[np.int64]
    limit: NDArray[np.int64]  # the Limit that cut the device's force; another number if unknown
    new_scene: Flags
    age: Numbers  # s since the page that moves the hand was last heard; 0 if the hand is none of a page
    inside: Flags  # (n, m), the membrane holds the needle
    resistance: Numbers  # (n, m), N, against the needle
    depth: Numbers  # (n, m), depth of the point, m: along the needle while inside, else along the normal
    below: Numbers  # (n, m), depth of the point along the normal, m
    run_on: Numbers  # (n, m), distance of the bevel past the membrane along the needle, m; negative before
    past: Numbers  # (n, m), distance of the point behind the membrane's far face, along its normal, m
    tip_past: Numbers  # (n, m), the same of the bevel's end
    # On the way: Ways fills them in.
    aside: Numbers  # m, distance of the point from the line of its last entry; 0 before one, NaN if unknown
    still: Numbers  # s, how long the needle has stood still in the tissue before the arrival; 0 if it moves
    silent: Flags  # the page was late in this standstill, so nobody knows whose it is
    slowed: Flags  # the same of the computer
    # For the point and for the whole tip, (n, 2); Stays fills them in.
    in_space: Flags
    stay: Numbers  # s since it entered the space; 0 outside
    dwell: Numbers  # s in the space so far, in total
    # Yields fills them in.
    load: Numbers  # N, of the thumb when the point came out behind the membrane before the space; NaN in front of it
    load_felt: Numbers  # N, the same of the felt force; NaN without a second device
    gave_way: Flags  # the plunger gives way in this tick
    # Since the point last came out behind that membrane; ThumbSoFar fills them in.
    farthest: Numbers  # m, how far in the thumb was; NaN if unknown
    cut_to: Numbers  # N, the least felt force on the thumb that was cut by limits; inf if none was

    def __len__(self) -> int:
        return len(self.tick)

    @property
    def in_tissue(self) -> Flags:
        """(n,), whether a membrane holds the needle."""
        flags: Flags = np.logical_or.reduce(self.inside, axis=1)
        return flags

    @property
    def placed(self) -> Flags:
        """(n,), whether the position of the tip is known."""
        flags: Flags = np.logical_and.reduce(np.isfinite(self.tip), axis=1)
        return flags

    @property
    def point_behind(self) -> Flags:
        """(n, m), whether the point is behind the membrane; False if unknown."""
        return self.past > 0

    @property
    def tip_behind(self) -> Flags:
        """(n, m), whether the whole bevel is behind the membrane."""
        return self.tip_past >= -ROUNDING

    def part(self, rows: slice) -> JudgedTicks:
        return JudgedTicks(*(getattr(self, name)[rows] for name in _NAMES))


_NAMES = [field.name for field in fields(JudgedTicks)]  # computed once: fields() is slow


class Geometry:
    """The geometry of a scene's membranes."""

    def __init__(self, scene: Scene, simulated: bool = False) -> None:
        """simulated: the device moves in its ticks only."""
        normals = np.array([placed.inward_normal for placed in scene.membranes], dtype=np.float64)
        self.normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        self.thickness = np.array([placed.membrane.thickness for placed in scene.membranes], dtype=np.float64)
        self.tip_length = tip_length(scene.needle)
        self._rate, self._simulated = scene.servo.rate, simulated

    def ticks(self, columns: Columns, first: int = 0) -> JudgedTicks:
        """Converts a batch of snapshots. first: number of its first tick, used if the batch has no `tick`."""
        m = len(self.thickness)
        depth = _wide(columns["depth"], m, np.nan)
        n = len(depth)
        finite = np.isfinite(depth)
        inside = INSIDE[_wide(columns["phase"], m, ABSENT)] & finite
        axis = _rows(columns.get("axis"), n)
        cosine = self._cosine(columns, axis, inside)
        below = np.where(inside, depth * cosine, depth)
        tick = columns["tick"].astype(np.int64) if "tick" in columns else np.arange(first, first + n)
        force = np.asarray(columns["model_force" if "model_force" in columns else "force"], dtype=np.float64)
        felt = np.asarray(columns["force"], dtype=np.float64) if "force" in columns else force
        held, known = self._held(columns, axis, inside)
        slope = np.einsum("ij,j->i", held, self.normals[0])
        zeros = np.zeros(n, dtype=np.int64)
        time = np.asarray(columns["time"] if "time" in columns else tick / self._rate, dtype=np.float64)
        return JudgedTicks(
            tick=tick,
            time=time,
            own=tick / self._rate if self._simulated else time,
            tip=columns["tip"],
            held=held,
            angle=np.where(known, np.arcsin(np.clip(slope, -1.0, 1.0)), np.nan),
            force=np.linalg.norm(force, axis=1),
            model=-np.einsum("ij,ij->i", force, held),
            felt=-np.einsum("ij,ij->i", felt, held),
            felt_size=np.linalg.norm(felt, axis=1),
            ceiling=_ceiling(columns, n),
            force_scale=np.asarray(columns["force_scale"], np.float64) if "force_scale" in columns else np.ones(n),
            push=-np.asarray(columns["thumb_force"], np.float64) if "thumb_force" in columns else np.full(n, np.nan),
            push_felt=-np.asarray(columns["thumb_felt"], np.float64) if "thumb_felt" in columns else np.zeros(n),
            thumb=_column(columns, "thumb", n),
            plunger=_column(columns, "plunger", n),
            injected=_column(columns, "injected", n),
            fault=columns["fault"].astype(np.int64) if "fault" in columns else zeros,
            limit=columns["limit"].astype(np.int64) if "limit" in columns else zeros,
            new_scene=(columns.get("commands", zeros).astype(np.int64) & COMMAND_SCENE) != 0,
            age=np.asarray(columns["page_age"], np.float64) if "page_age" in columns else np.zeros(n),
            inside=inside,
            resistance=-_wide(columns["axial_force"], m, np.nan),
            depth=depth,
            below=below,
            run_on=np.where(inside, depth - self.tip_length - self.thickness / cosine, -np.inf),
            past=below - self.thickness,
            tip_past=below - self.thickness - self.tip_length * cosine,
            aside=np.zeros(n),
            still=np.zeros(n),
            silent=np.zeros(n, dtype=np.bool_),
            slowed=np.zeros(n, dtype=np.bool_),
            in_space=np.zeros((n, 2), dtype=np.bool_),
            stay=np.zeros((n, 2)),
            dwell=np.zeros((n, 2)),
            load=np.full(n, np.nan),
            load_felt=np.full(n, np.nan),
            gave_way=np.zeros(n, dtype=np.bool_),
            farthest=np.full(n, np.nan),
            cut_to=np.full(n, np.inf),
        )

    def _held(self, columns: Columns, axis: Numbers, inside: Flags) -> tuple[Numbers, Flags]:
        """The direction, and whether it is known; else it is the first membrane's normal."""
        held = axis
        if "direction" in columns and columns["direction"].shape[1]:
            b = columns["direction"][:, 0]
            held = np.where(inside[:, :1] & np.isfinite(b).all(axis=1, keepdims=True), b, axis)
        length = np.linalg.norm(held, axis=1, keepdims=True)
        good = np.isfinite(length) & (length > 0)
        return np.where(good, held / np.where(good, length, 1.0), self.normals[0]), good[:, 0]

    def _cosine(self, columns: Columns, axis: Numbers, inside: Flags) -> Numbers:
        """n.b, with the direction at entry while the tip is inside, else with the stylus's direction."""
        cosine = axis @ self.normals.T
        if "direction" in columns:
            m = len(self.thickness)
            held = np.einsum("nmk,mk->nm", _wide(columns["direction"], m, np.nan), self.normals)
            cosine = np.where(inside & np.isfinite(held), held, cosine)
        return np.clip(np.where(np.isfinite(cosine), cosine, 1.0), grazing_cosine, 1.0)


def _ceiling(columns: Columns, n: int) -> Numbers:
    permitted = np.asarray(columns["ceiling"], np.float64) if "ceiling" in columns else np.full(n, np.inf)
    return np.where(np.isin(columns["state"], _OFF), 0.0, permitted) if "state" in columns else permitted


def _column(columns: Columns, name: str, n: int) -> Numbers:
    return np.asarray(columns[name], np.float64) if name in columns else np.full(n, np.nan)


def _rows(column: NDArray[Any] | None, n: int) -> Numbers:
    return np.full((n, 3), np.nan) if column is None else np.asarray(column, dtype=np.float64)


def _wide(column: NDArray[Any], m: int, none: float) -> NDArray[Any]:
    """The column for m membranes: further ones are cut off, missing ones are filled with `none`."""
    has = column.shape[1]
    if has >= m:
        return column[:, :m]
    shape = (column.shape[0], m - has, *column.shape[2:])
    return np.concatenate([column, np.full(shape, none, dtype=column.dtype)], axis=1)


def judged_depth(scene: Scene, geometry: Geometry, ticks: JudgedTicks, before: int) -> Numbers:
    """Depth of the point below the first surface, m, (n,), as judged for the space behind membrane `before`.

    It is behind a membrane's far face exactly where the model has the point behind it. The membranes are parallel.
    """
    first = np.asarray(scene.membranes[0].point)
    tops = np.array([(np.asarray(placed.point) - first) @ geometry.normals[0] for placed in scene.membranes])
    at = tops + ticks.below
    depth = np.fmin(at[:, before], np.fmin.reduce(np.where(ticks.past > 0, np.nan, at), axis=1))
    return np.fmax(depth, np.fmax.reduce(np.where(ticks.past > 0, tops + geometry.thickness, np.nan), axis=1))


class Moment(NamedTuple):
    tick: int
    time: float  # s


def moment(ticks: JudgedTicks, row: int) -> Moment:
    return Moment(int(ticks.tick[row]), float(ticks.time[row]))


def first_of(ticks: JudgedTicks, flags: Flags) -> Moment | None:
    return moment(ticks, int(flags.argmax())) if flags.any() else None


def by(when: Moment | None, until: Moment | None) -> bool:
    """Whether `when` exists and is not after `until`."""
    return when is not None and (until is None or when.tick <= until.tick)


def own_time(ticks: JudgedTicks, when: Moment | Event) -> float:
    """The needle's own time at a moment of these ticks, s."""
    return float(ticks.own[np.searchsorted(ticks.tick, when.tick)])


def contacts(events: list[Event]) -> list[Moment]:
    """The touches of the first membrane."""
    return [Moment(event.tick, event.time) for event in events if event.what == "touch" and event.membrane == 0]


@dataclass(frozen=True)
class TargetSpace:
    """The space behind one membrane's far face. It ends at another's near face, at a depth, or not at all.

    Distances are along the membranes' normals.
    """

    name: str
    sign: str  # sign of the arrival; may be empty
    behind: int
    in_front_of: int | None
    begins: float  # m behind the far face of `behind`
    ends: float  # the same; infinite without an end at a depth
    press: float  # m, allowed depth of the point in `in_front_of`
    # The definition of arriving and staying, for every measure and sentence.
    arrive_whole: bool  # the whole tip, not only the point
    arrive_depth: float | None  # m, if deeper than the start of the space
    stay_whole: bool

    def holds(self, ticks: JudgedTicks, whole_tip: bool, depth: float | None = None) -> Flags:
        """The ticks in which the point, or the whole tip, is in the space and at least at `depth`, m.

        A needle that the front membrane does not hold is not in the space.
        """
        least = self.begins if depth is None else depth
        past = (ticks.tip_past if whole_tip else ticks.past)[:, self.behind]
        deep = past > 0 if least == 0 and not whole_tip else past >= least - ROUNDING
        return deep & ticks.inside[:, self.behind] & ~self.too_deep(ticks)

    def too_deep(self, ticks: JudgedTicks) -> Flags:
        """The ticks in which the point is behind the space's end, or in an unknown place."""
        flags = np.zeros(len(ticks), dtype=np.bool_)
        if self.in_front_of is not None:
            flags |= ~(ticks.below[:, self.in_front_of] <= self.press)
        if np.isfinite(self.ends):
            flags |= ~(ticks.past[:, self.behind] <= self.ends + ROUNDING)
        return flags

    def arrived(self, ticks: JudgedTicks) -> Flags:
        """The ticks in which the needle meets the `reach` goal, or without one the place of the `stay` goal."""
        return self.holds(ticks, self.arrive_whole, self.arrive_depth)

    @property
    def arrival(self) -> str:
        """The arrival, for sentences such as "0.8 s after ..."."""
        return self.sign or f"you had reached {self.name}"


def place_of(scene: Scene, name: str) -> int:
    """The index of an existing membrane in the running scene."""
    return [placed.name for placed in scene.membranes].index(name)
