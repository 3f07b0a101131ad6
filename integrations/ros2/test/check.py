"""The node and the bag reader: the forces of the core.

python integrations/ros2/test/check.py REFERENCE FOLDER
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import punctura as pn
from geometry_msgs.msg import PoseStamped
from punctura.trace import read_trace
from punctura_ros.bag import POSE, WRENCH, main
from punctura_ros.node import NeedleNode, rotated
from rclpy.node import Node
from rosbags.rosbag2 import Writer
from rosbags.typesys import Stores, get_typestore


def quaternion(axis: np.ndarray) -> np.ndarray:
    """x, y, z, w of the shortest turn from z to `axis`, which has length 1."""
    q = np.append(np.cross([0, 0, 1], axis), 1 + axis[2])
    return q / np.linalg.norm(q)


def pose(time_ns: int, position: np.ndarray, axis: np.ndarray) -> PoseStamped:
    message = PoseStamped()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(time_ns, 10**9)
    message.header.frame_id = "patient"
    for name, value in zip("xyz", position, strict=True):
        setattr(message.pose.position, name, float(value))
    for name, value in zip("xyzw", quaternion(axis), strict=True):
        setattr(message.pose.orientation, name, float(value))
    return message


def check_node(reference: Path, rows: np.ndarray, rate: float) -> None:
    Node.overrides = {"scene": str(reference / "scene.toml"), "frame_id": "patient"}
    node = NeedleNode()
    axes = rows[:, 3:6] / np.linalg.norm(rows[:, 3:6], axis=1, keepdims=True)
    poses = [pose(round(k * 1e9 / rate), rows[k, :3], axes[k]) for k in range(len(rows))]
    for message in poses:
        node.callbacks["needle_pose"](message)
    sent = node.publishers_by_topic["needle_wrench"].sent
    forces = np.array([[m.wrench.force.x, m.wrench.force.y, m.wrench.force.z] for m in sent])
    turned = np.array([rotated(m.pose.orientation, np.array([0.0, 0.0, 1.0])) for m in poses])
    core = pn.Insertion(pn.load_scene(reference / "scene.toml")).run(rows[:, :3], turned).force
    assert np.array_equal(forces, core), "the forces differ from the core's"
    largest = np.abs(forces - rows[:, 6:]).max()
    print(f"ros2: {len(forces)} wrenches equal the core's forces bit for bit")
    print(f"ros2: the axes of the reference, not rounded to quaternions, change the force by {largest:.1e} N at most")

    poses[0].header.frame_id = "robot"
    node.callbacks["needle_pose"](poses[0])
    poses[1].pose.position.x = float("nan")
    node.callbacks["needle_pose"](poses[1])
    assert len(sent) == len(rows) and len(node.logger.lines) == 3, node.logger.lines


def check_bag(folder: Path, rows: np.ndarray, rate: float) -> None:
    """A bag as a robot with a force sensor writes it, read without ROS."""
    store = get_typestore(Stores.ROS2_HUMBLE)
    types = store.types
    stamp_type, header_type = types["builtin_interfaces/msg/Time"], types["std_msgs/msg/Header"]
    point, turn, vector = (types[f"geometry_msgs/msg/{name}"] for name in ("Point", "Quaternion", "Vector3"))
    pose_type, wrench_type = types["geometry_msgs/msg/Pose"], types["geometry_msgs/msg/Wrench"]
    bag = folder / "bag"
    with Writer(bag, version=8) as writer:
        topics = {}
        for name, kind in (("/pose", POSE), ("/wrench", WRENCH)):
            topics[kind] = writer.add_connection(name, kind, typestore=store)
        for k, row in enumerate(rows):
            time = 10**18 + round(k * 1e9 / rate)
            header = header_type(stamp_type(*divmod(time, 10**9)), "patient")
            measured = types[WRENCH](header, wrench_type(vector(*row[6:]), vector(0.0, 0.0, 0.0)))
            placed = types[POSE](header, pose_type(point(*row[:3]), turn(0.0, 0.0, 0.0, 1.0)))
            for kind, message in ((WRENCH, measured), (POSE, placed)):
                writer.write(topics[kind], time, store.serialize_cdr(message, kind))
    out = folder / "trace.csv"
    main([str(bag), "--pose", "/pose", "--wrench", "/wrench", "--axis", "0", "-1", "0", "-o", str(out)])
    trace = read_trace(out)
    assert np.allclose(trace.depth, rows[0, 1] - rows[:, 1], atol=1e-8)
    assert np.allclose(trace.force, rows[:, 7], atol=1e-6)
    assert np.allclose(np.diff(trace.time), 1 / rate, atol=2e-7)
    print(f"ros2: a bag of {len(rows)} poses and wrenches gives a trace that `punctura identify` can read")


if __name__ == "__main__":
    reference, folder = Path(sys.argv[1]), Path(sys.argv[2])
    rows = np.fromfile(reference / "motion.f64", "<f8").reshape(-1, 9)
    rate = pn.load_scene(reference / "scene.toml").servo.rate
    check_node(reference, rows, rate)
    check_bag(folder, rows[:1333], rate)
