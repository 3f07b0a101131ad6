"""The node and the bag reader: the forces of the core.

python integrations/untried/ros2/test/check.py REFERENCE FOLDER
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import punctura as pn
from geometry_msgs.msg import PoseStamped, WrenchStamped
from punctura.trace import read_trace
from punctura_ros.bag import POSE, WRENCH, main
from punctura_ros.node import NeedleNode, rotated
from rclpy.node import Node
from rosbags.rosbag1 import Writer as Writer1
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
    poses = [pose(10**9 + round(k * 1e9 / rate), rows[k, :3], axes[k]) for k in range(len(rows))]
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

    deep = int(np.abs(core).max(axis=1).argmax()) + 1
    check_pauses(reference, poses[:deep], core[deep - 1])

    poses[0].header.frame_id = "robot"
    node.callbacks["needle_pose"](poses[0])
    poses[1].pose.position.x = float("nan")
    node.callbacks["needle_pose"](poses[1])
    assert len(sent) == len(rows) and len(node.logger.lines) == 3, node.logger.lines

    # Poses without a time stamp get the time of the node's clock.
    node = NeedleNode()
    for k, row in enumerate(rows[:800]):
        node.clock_ns = 10**18 + round(k * 1e9 / rate)
        node.callbacks["needle_pose"](pose(0, row[:3], axes[k]))
    sent = node.publishers_by_topic["needle_wrench"].sent
    forces = np.array([[m.wrench.force.x, m.wrench.force.y, m.wrench.force.z] for m in sent])
    assert np.array_equal(forces, core[:800]) and np.ptp(forces[:, 1]) > 0.1


def check_pauses(reference: Path, poses: list[PoseStamped], before: np.ndarray) -> None:
    """A pause of 1 s starts the needle anew, with a warning; hold_last_pose keeps the needle where it is."""
    for hold in (False, True):
        Node.overrides = {"scene": str(reference / "scene.toml"), "hold_last_pose": hold}
        node = NeedleNode()
        for message in poses:
            node.callbacks["needle_pose"](message)
        sent = node.publishers_by_topic["needle_wrench"].sent
        node.clock_ns += 10**9
        for callback in node.timers:
            callback()
        late = pose(0, np.array([getattr(poses[-1].pose.position, name) for name in "xyz"]), np.array([0.0, -1.0, 0.0]))
        late.pose.orientation = poses[-1].pose.orientation
        late.header.stamp.sec = poses[-1].header.stamp.sec + 1
        late.header.stamp.nanosec = poses[-1].header.stamp.nanosec
        node.callbacks["needle_pose"](late)
        forces = np.array([[m.wrench.force.x, m.wrench.force.y, m.wrench.force.z] for m in sent[len(poses) :]])
        if hold:
            assert len(forces) == 2 and np.allclose(forces, before, atol=0.05) and len(node.logger.lines) == 1
        else:
            assert len(forces) == 1 and not forces.any() and "starts anew" in node.logger.lines[-1], node.logger.lines


def check_qos(reference: Path) -> None:
    """A sender that offers only best effort reaches the node that asks for no more."""
    for reliability in ("reliable", "best_effort"):
        chosen = {"qos_overrides./needle_pose.subscription.reliability": reliability}
        Node.overrides = {"scene": str(reference / "scene.toml"), **chosen}
        node = NeedleNode()
        assert node.hears("needle_pose", "reliable")
        assert node.hears("needle_pose", "best_effort") == (reliability == "best_effort")
        names = {f"qos_overrides.{end}.{policy}" for end in ("/needle_pose.subscription", "/needle_wrench.publisher")
                 for policy in ("reliability", "durability", "history", "depth")}  # fmt: skip
        assert names <= set(node.parameters)
    print("ros2: best effort reaches the node that asks for it")


def check_fields() -> None:
    """The stand-ins for messages have the fields of ROS 2's own definitions, as rosbags has them."""
    definitions = get_typestore(Stores.ROS2_HUMBLE).fielddefs

    def compared(message: object, name: str) -> None:
        known = {field: kind for field, (_, kind) in definitions[name][1]}
        for field, value in vars(message).items():
            assert field in known, f"{name} has no field {field}"
            if known[field] in definitions:
                compared(value, known[field])

    compared(PoseStamped(), POSE)
    compared(WrenchStamped(), WRENCH)


def check_bag(folder: Path, rows: np.ndarray, rate: float, one: bool) -> None:
    """A bag of ROS 1 or 2 as a robot with a force sensor writes it, read without ROS."""
    store = get_typestore(Stores.ROS1_NOETIC if one else Stores.ROS2_HUMBLE)
    types = store.types
    stamp_type, header_type = types["builtin_interfaces/msg/Time"], types["std_msgs/msg/Header"]
    point, turn, vector = (types[f"geometry_msgs/msg/{name}"] for name in ("Point", "Quaternion", "Vector3"))
    pose_type, wrench_type = types["geometry_msgs/msg/Pose"], types["geometry_msgs/msg/Wrench"]
    bag = folder / ("one.bag" if one else "bag")
    with Writer1(bag) if one else Writer(bag, version=8) as writer:
        topics = {}
        for name, kind in (("/pose", POSE), ("/wrench", WRENCH)):
            topics[kind] = writer.add_connection(name, kind, typestore=store)
        for k, row in enumerate(rows):
            time = 10**18 + round(k * 1e9 / rate)
            header = header_type(*([k] if one else []), stamp_type(*divmod(time, 10**9)), "patient")
            measured = types[WRENCH](header, wrench_type(vector(*row[6:]), vector(0.0, 0.0, 0.0)))
            placed = types[POSE](header, pose_type(point(*row[:3]), turn(0.0, 0.0, 0.0, 1.0)))
            for kind, message in ((WRENCH, measured), (POSE, placed)):
                raw = store.serialize_ros1(message, kind) if one else store.serialize_cdr(message, kind)
                writer.write(topics[kind], time, raw)
    out = folder / "trace.csv"
    main([str(bag), "--pose", "/pose", "--wrench", "/wrench", "--axis", "0", "-1", "0", "-o", str(out)])
    trace = read_trace(out)
    assert np.allclose(trace.depth, rows[0, 1] - rows[:, 1], atol=1e-8)
    assert np.allclose(trace.force, rows[:, 7], atol=1e-6)
    assert np.allclose(np.diff(trace.time), 1 / rate, atol=2e-7)
    try:
        main([str(bag), "--pose", "/other", "-o", str(out)])
    except SystemExit as end:
        assert "has no topic /other" in str(end), end
    else:
        raise AssertionError("a topic that the bag does not have was accepted")
    kind = f"ROS {1 if one else 2}"
    print(f"ros2: a bag of {kind} with {len(rows)} poses and wrenches gives a trace for `punctura identify`")


if __name__ == "__main__":
    reference, folder = Path(sys.argv[1]), Path(sys.argv[2])
    rows = np.fromfile(reference / "motion.f64", "<f8").reshape(-1, 9)
    rate = pn.load_scene(reference / "scene.toml").servo.rate
    check_fields()
    check_qos(reference)
    check_node(reference, rows, rate)
    check_bag(folder, rows[:1333], rate, one=False)
    check_bag(folder, rows[:1333], rate, one=True)
