"""A ROS 2 node: geometry_msgs/PoseStamped of the needle's tip in, geometry_msgs/WrenchStamped of the force on it out.

python integrations/ros2/node.py --ros-args -p scene:=venipuncture
"""

from contextlib import suppress

import numpy as np
import rclpy
from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, WrenchStamped
from punctura import load_scene
from punctura.poses import PosedNeedle
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSPolicyKind
from rclpy.qos_overriding_options import QoSOverridingOptions

QOS = (QoSPolicyKind.RELIABILITY, QoSPolicyKind.DURABILITY, QoSPolicyKind.HISTORY, QoSPolicyKind.DEPTH)
HOLD_S = 0.1  # between two answers at a held pose
SELDOM = {"throttle_duration_sec": 1.0}  # for each line that warns: poses come often


def rotated(quaternion: object, vector: np.ndarray) -> np.ndarray:
    """A vector turned by a quaternion message, which need not have length 1. Raises ValueError if it is 0."""
    u = np.array([quaternion.x, quaternion.y, quaternion.z])  # type: ignore[attr-defined]
    w = float(quaternion.w)  # type: ignore[attr-defined]
    square = w * w + u @ u
    if not square > 0:
        raise ValueError("the orientation is 0")
    return vector + 2 / square * np.cross(u, np.cross(u, vector) + w * vector)


class NeedleNode(Node):
    """Publishes the force of the scene on the needle for each pose. The force acts at the tip: the torque is 0."""

    def __init__(self) -> None:
        super().__init__("needle")
        given = {name: self.declare_parameter(name, default).value for name, default in (
            ("scene", "venipuncture"), ("tool_axis", [0.0, 0.0, 1.0]), ("frame_id", ""), ("longest_gap_s", 0.25),
            ("hold_last_pose", False))}  # fmt: skip
        scene = load_scene(given["scene"])
        self._needle = PosedNeedle(
            scene, longest_gap=given["longest_gap_s"], hold_last_pose=given["hold_last_pose"],
            notice=self.get_logger().warning,
        )  # fmt: skip
        self._last: tuple[PoseStamped, float, float] | None = None  # the last pose, its time and the clock then
        self._axis, self._frame = np.array(given["tool_axis"], float), given["frame_id"]
        chosen = QoSOverridingOptions(QOS)  # by parameters qos_overrides.TOPIC.subscription.reliability, ...
        self._publisher = self.create_publisher(WrenchStamped, "needle_wrench", 10, qos_overriding_options=chosen)
        self.create_subscription(PoseStamped, "needle_pose", self.on_pose, 10, qos_overriding_options=chosen)
        if self._needle.hold_last_pose:
            self.create_timer(HOLD_S, self.on_timer)
        self.get_logger().info(f"scene {scene.name!r}, {scene.servo.rate:g} ticks a second")

    def on_pose(self, message: PoseStamped) -> None:
        header, at, warn = message.header, message.pose.position, self.get_logger().warning
        if self._frame and header.frame_id != self._frame:
            warn(f"a pose in {header.frame_id!r}, not in {self._frame!r}: not used", **SELDOM)
            return
        # A time of 0 is not set, as by `ros2 topic pub`.
        time = header.stamp.sec + header.stamp.nanosec * 1e-9 or self._now()
        try:
            force = self._needle.move(time, [at.x, at.y, at.z], rotated(message.pose.orientation, self._axis))
        except ValueError as error:
            warn(f"this pose is not used: {error}", **SELDOM)
            return
        self._last = message, time, self._now()
        self._publish(header.stamp, header.frame_id, force)

    def on_timer(self) -> None:
        """Goes on at the last pose, a little behind: the next pose may be on its way."""
        if self._last is not None:
            message, time, clock = self._last
            held = max(time, time + self._now() - clock - HOLD_S)
            try:
                force = self._needle.hold(held)
            except ValueError as error:  # the clock was set by more than an hour
                self.get_logger().warning(f"the last pose is held no longer: {error}")
                self._last = None
                return
            self._publish(Time(sec=int(held), nanosec=int(held % 1 * 1e9)), message.header.frame_id, force)

    def _now(self) -> float:
        return float(self.get_clock().now().nanoseconds * 1e-9)

    def _publish(self, stamp: Time, frame: str, force: np.ndarray) -> None:
        answer = WrenchStamped()
        answer.header.stamp, answer.header.frame_id = stamp, frame
        answer.wrench.force.x, answer.wrench.force.y, answer.wrench.force.z = force.tolist()
        self._publisher.publish(answer)


def main() -> None:
    rclpy.init()
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(NeedleNode())


if __name__ == "__main__":
    main()
