"""The node in a process of its own gives, through ROS 2, the forces of the core.

python integrations/ros2/check.py REFERENCE
"""

import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import punctura as pn
import rclpy
from geometry_msgs.msg import PoseStamped, WrenchStamped
from node import rotated
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy

Z = np.array([0.0, 0.0, 1.0])


def pose(seconds: float, position: np.ndarray, axis: np.ndarray, frame: str = "patient") -> PoseStamped:
    """The orientation is the shortest turn from z to `axis`, which has length 1."""
    message = PoseStamped()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(round(seconds * 1e9), 10**9)
    message.header.frame_id = frame
    at, turn = message.pose.position, message.pose.orientation
    at.x, at.y, at.z = position.tolist()
    turn.x, turn.y, turn.z, turn.w = (*np.cross(Z, axis).tolist(), 1 + float(axis[2]))
    return message


def poses_of(rows: np.ndarray, rate: float) -> list[PoseStamped]:
    axes = rows[:, 3:6] / np.linalg.norm(rows[:, 3:6], axis=1, keepdims=True)
    return [pose(1 + k / rate, *row) for k, row in enumerate(zip(rows[:, :3], axes, strict=True))]


class Client(Node):
    def __init__(self, reliability: ReliabilityPolicy) -> None:
        super().__init__("client", enable_rosout=False)
        self.refused, self.answers = [], list[WrenchStamped]()
        events = PublisherEventCallbacks(incompatible_qos=self.refused.append)
        offered = QoSProfile(depth=10, reliability=reliability)
        self._poses = self.create_publisher(PoseStamped, "needle_pose", offered, event_callbacks=events)
        self._wrenches = self.create_subscription(WrenchStamped, "needle_wrench", self.answers.append, 10)

    def wait(self, condition: Callable[[], object], seconds: float = 60) -> None:
        end = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < end, "no answer"
            rclpy.spin_once(self, timeout_sec=0.1)

    def send(self, message: PoseStamped) -> None:
        self._poses.publish(message)

    def begin(self, message: PoseStamped) -> None:
        """Until both ends of the two topics have found each other. The same pose again changes nothing."""
        self.wait(lambda: (self.send(message), self.answers)[1])

    def ask(self, message: PoseStamped) -> np.ndarray:
        count, stamp = len(self.answers), message.header.stamp
        self.send(message)
        self.wait(lambda: any(answer.header.stamp == stamp for answer in self.answers[count:]))
        force = next(answer for answer in self.answers[count:] if answer.header.stamp == stamp).wrench.force
        return np.array([force.x, force.y, force.z])


@contextmanager
def needle(scene: Path, *parameters: str, offer: ReliabilityPolicy = ReliabilityPolicy.RELIABLE) -> Iterator[Client]:
    """A client of a new node. At the end `client.log` is what the node has written."""
    words = [word for value in (f"scene:={scene}", *parameters) for word in ("-p", value)]
    program = [sys.executable, str(Path(__file__).with_name("node.py")), "--ros-args", *words]
    client, process = Client(offer), subprocess.Popen(program, stderr=subprocess.PIPE, text=True)
    try:
        yield client
    finally:
        process.terminate()
        client.log = process.communicate()[1]
        client.destroy_node()


def check_forces(scene: Path, rows: np.ndarray, rate: float) -> None:
    poses = poses_of(rows, rate)
    turned = np.array([rotated(message.pose.orientation, Z) for message in poses])
    core = pn.Insertion(pn.load_scene(scene)).run(rows[:, :3], turned).force
    with needle(scene, "frame_id:=patient") as client:
        client.begin(poses[0])
        forces = np.array([client.ask(message) for message in poses])
        assert np.array_equal(forces, core) and np.ptp(core[:, 1]) > 0.1, "the forces differ from the core's"
        client.send(pose(2, rows[0, :3], Z, "robot"))
        client.send(pose(2, np.full(3, np.nan), Z))
        late = client.ask(pose(4, rows[-1, :3], Z))
    assert not late.any() and all(answer.header.stamp.sec != 2 for answer in client.answers)
    for words in ("a pose in 'robot'", "this pose is not used", "starts anew"):
        assert words in client.log, client.log
    print(f"ros2: {len(rows)} wrenches equal the core's forces bit for bit")


def check_hold(scene: Path, rows: np.ndarray, rate: float) -> None:
    """A sender that sends only what changes: the wrench comes ten times a second."""
    poses = poses_of(rows, rate)
    with needle(scene, "hold_last_pose:=true") as client:
        client.begin(poses[0])
        last = [client.ask(message) for message in poses][-1]
        count = len(client.answers)
        client.wait(lambda: len(client.answers) > count + 5)
        held = client.answers[-1].wrench.force
        assert abs(held.y - last[1]) < 0.05 < abs(last[1]), (held, last)
        client.ask(pose(0, rows[-1, :3], Z))  # a time of 0 is now
    print("ros2: the last pose is held")


def check_quality(scene: Path, row: np.ndarray) -> None:
    """Best effort reaches the node that asks for no more."""
    with needle(scene, offer=ReliabilityPolicy.BEST_EFFORT) as client:
        client.wait(lambda: client.refused)
    asked = "qos_overrides./needle_pose.subscription.reliability:=best_effort"
    with needle(scene, asked, offer=ReliabilityPolicy.BEST_EFFORT) as client:
        client.begin(pose(1, row[:3], Z))
        assert not client.refused
    print("ros2: best effort reaches the node that asks for it")


if __name__ == "__main__":
    rclpy.init()
    scene, rows = Path(sys.argv[1], "scene.toml"), np.fromfile(Path(sys.argv[1], "motion.f64"), "<f8").reshape(-1, 9)
    rate = pn.load_scene(scene).servo.rate
    check_quality(scene, rows[0])
    check_forces(scene, rows[:1500], rate)
    check_hold(scene, rows[: int(np.abs(rows[:1500, 7]).argmax()) + 1], rate)
    rclpy.shutdown()
