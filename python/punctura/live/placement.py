"""Placement files: the place of a device in the scene. TOML, in millimetres; the rotation is a quaternion.

Also reads the pose of a device, from which its place follows.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from punctura._core import DeviceError, Placement, ServoLoop
from punctura.files.fields import Number, Quaternion, Vector
from punctura.files.tables import Table, in_si, read_table

Array = npt.NDArray[np.float64]
POLL_S = 0.01


class PlacementFile(Table):
    """The keys of a placement file."""

    rotation: Quaternion | None = None
    offset_mm: Vector | None = None
    scale: Number | None = None
    tip_offset_mm: Number | None = None


def load_placement(path: str | os.PathLike[str]) -> Placement:
    """Reads a placement file. Raises ConfigurationError with all of its problems."""
    return _placement(read_table(path, "placement", PlacementFile, (_placement,)))


def _placement(file: PlacementFile) -> Placement:
    given = Placement()
    w, x, y, z = map(float, file.rotation) if file.rotation else given.rotation
    a, b, c = (in_si("offset_mm", part) for part in file.offset_mm) if file.offset_mm else given.offset
    scale = given.scale if file.scale is None else float(file.scale)
    tip = given.tip_offset if file.tip_offset_mm is None else in_si("tip_offset_mm", file.tip_offset_mm)
    return Placement((w, x, y, z), (a, b, c), scale, tip)


def placement_text(placement: Placement) -> str:
    """The text of a placement file for load_placement."""
    rotation = ", ".join(repr(x) for x in placement.rotation)
    offset = ", ".join(repr(x * 1e3) for x in placement.offset)
    return (
        "# Where the device stands: point = rotation * (scale * device point) + offset + tip_offset * axis.\n"
        f"rotation = [{rotation}]  # quaternion w, x, y, z\n"
        f"offset_mm = [{offset}]\n"
        f"scale = {placement.scale!r}\n"
        f"tip_offset_mm = {placement.tip_offset * 1e3!r}\n"
    )


def placement_from_pose(
    position: npt.ArrayLike,
    axis: npt.ArrayLike,
    wanted_tip: npt.ArrayLike,
    wanted_axis: npt.ArrayLike,
    tip_offset: float = 0.0,
) -> Placement:
    """The placement that maps a pose of the device to a pose in the scene, by the smallest rotation.

    position (m) and axis: as the device reports them. wanted_tip (m) and wanted_axis: in the scene, of any length.
    """
    rotation = shortest_turn(axis, wanted_axis)
    turned = rotate(rotation, np.asarray(position, float))
    b = np.asarray(wanted_axis, float)
    offset = np.asarray(wanted_tip, float) - turned - tip_offset * b / np.linalg.norm(b)
    return Placement(rotation, (float(offset[0]), float(offset[1]), float(offset[2])), 1.0, tip_offset)


def shortest_turn(start: npt.ArrayLike, end: npt.ArrayLike) -> tuple[float, float, float, float]:
    """The quaternion w, x, y, z of the smallest rotation that takes one direction to another."""
    a, b = (np.asarray(v, float) / np.linalg.norm(np.asarray(v, float)) for v in (start, end))
    w = 1.0 + float(a @ b)
    if w < 1e-9:  # opposite directions: half a turn about any perpendicular axis
        across = np.cross(a, [1.0, 0.0, 0.0] if abs(a[0]) < 0.9 else [0.0, 1.0, 0.0])
        q = np.array([0.0, *(across / np.linalg.norm(across))])
    else:
        q = np.array([w, *np.cross(a, b)])
    q = q / np.linalg.norm(q)
    return float(q[0]), float(q[1]), float(q[2]), float(q[3])


def rotate(quaternion: tuple[float, float, float, float], v: Array) -> Array:
    """v rotated by the unit quaternion w, x, y, z."""
    w, u = quaternion[0], np.array(quaternion[1:])
    turned: Array = v + 2 * w * np.cross(u, v) + 2 * np.cross(u, np.cross(u, v))
    return turned


def present_pose(
    loop: ServoLoop, wait: float = 5.0, sleep: Callable[[float], None] = time.sleep
) -> tuple[Array, Array]:
    """Position (m) and axis in the last tick of a started loop. wait: the longest time to the first tick, s.

    Raises DeviceError if no tick came in this time, or if the position is not finite.
    """
    for _ in range(max(1, round(wait / POLL_S))):
        if loop.report()["ticks"]:
            break
        sleep(POLL_S)
    else:
        raise DeviceError(f"the device has not said in {wait:g} s where it is; {loop.device.trouble() or 'no reason'}")
    last = loop.latest()
    position, axis = last["position"][0], last["axis"][0]
    points = np.isfinite(axis).all() and (axis.any() or not loop.device.info.has_orientation)
    if not (np.isfinite(position).all() and points):
        raise DeviceError(f"the device says that it is at {position}, pointing along {axis}: no place at all")
    return position, axis
