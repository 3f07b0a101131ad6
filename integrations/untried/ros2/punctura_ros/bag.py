"""Reads a measured insertion from a ROS bag: force against depth, for `punctura identify`.

    bag_to_trace BAG --pose /needle_pose --wrench /wrench -o trace.csv

Needs no ROS: the package rosbags reads bags of ROS 1 and 2.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from punctura.trace import Trace, TraceError
from rosbags.highlevel import AnyReader, AnyReaderError
from rosbags.typesys import Stores, get_typestore

POSE, WRENCH = "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/WrenchStamped"


def bag_trace(bag: Path, pose: str, wrench: str, axis: list[float], *, inverted: bool = False) -> Trace:
    """The trace of one insertion: depth along `axis` from the first pose (m), force against it (N), time (s).

    axis (3,): the direction of the insertion in the frame of the poses and wrenches. inverted: the sensor measures the
    force of the needle on the tissue, not of the tissue on the needle. The times are those of the message headers.
    Raises TraceError.
    """
    with AnyReader([bag], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
        poses = _rows(reader, pose, POSE, lambda m: (m.pose.position.x, m.pose.position.y, m.pose.position.z))
        forces = _rows(reader, wrench, WRENCH, lambda m: (m.wrench.force.x, m.wrench.force.y, m.wrench.force.z))
    direction = np.asarray(axis, float) / np.linalg.norm(axis)
    along = (poses[:, 1:] - poses[0, 1:]) @ direction
    inside = (forces[:, 0] >= poses[0, 0]) & (forces[:, 0] <= poses[-1, 0])
    if inside.sum() < 2:
        raise TraceError("fewer than two wrenches lie between the first and the last pose")
    time = forces[inside, 0]
    force = forces[inside, 1:] @ direction * (1 if inverted else -1)
    return Trace(np.interp(time, poses[:, 0], along), force, time - time[0], str(bag))


def _rows(reader: AnyReader, topic: str, kind: str, values: object) -> np.ndarray:
    """Time and three numbers of each message of a topic, by time."""
    connections = [c for c in reader.connections if c.topic == topic]
    if not connections or any(c.msgtype != kind for c in connections):
        known = ", ".join(sorted(f"{c.topic} ({c.msgtype})" for c in reader.connections)) or "nothing"
        raise TraceError(f"the bag has no topic {topic} of type {kind}; it has {known}")
    rows = []
    for connection, _, raw in reader.messages(connections=connections):
        message = reader.deserialize(raw, connection.msgtype)
        stamp = message.header.stamp
        rows.append((stamp.sec + stamp.nanosec * 1e-9, *values(message)))  # type: ignore[operator]
    found = np.array(rows, float).reshape(-1, 4)
    return found[np.argsort(found[:, 0], kind="stable")]


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bag", type=Path, help="a folder of ROS 2, or a .bag file of ROS 1")
    parser.add_argument("--pose", default="/needle_pose", help=f"topic, {POSE}")
    parser.add_argument("--wrench", default="/needle_wrench", help=f"topic, {WRENCH}")
    parser.add_argument("--axis", type=float, nargs=3, default=[0.0, 0.0, 1.0], help="direction of the insertion")
    parser.add_argument("--inverted", action="store_true", help="the sensor measures the force on the tissue")
    parser.add_argument("-o", "--out", type=Path, required=True, help="the CSV file to write")
    given = parser.parse_args(arguments)
    if not np.any(given.axis):
        parser.error("--axis is 0 0 0: it must be the direction of the insertion")
    try:
        trace = bag_trace(given.bag, given.pose, given.wrench, given.axis, inverted=given.inverted)
    except (TraceError, AnyReaderError, OSError) as error:
        sys.exit(f"{given.bag}: {error}")
    table = np.column_stack([trace.time, trace.depth * 1e3, trace.force])
    np.savetxt(given.out, table, "%.9g", ",", header="time_s,depth_mm,force_N", comments="")
    print(f"{given.out}: {len(table)} samples, {np.ptp(trace.depth) * 1e3:.1f} mm, {trace.force.max():.2f} N")
