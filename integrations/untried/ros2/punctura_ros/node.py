"""The node, never run in ROS: geometry_msgs/PoseStamped of the needle's tip in, geometry_msgs/WrenchStamped out."""

from __future__ import annotations

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

_QOS = (QoSPolicyKind.RELIABILITY, QoSPolicyKind.DURABILITY, QoSPolicyKind.HISTORY, QoSPolicyKind.DEPTH)
_HOLD_S = 0.1  # between two answers at a held pose


def rotated(quaternion: object, vector: np.ndarray) -> np.ndarray:
    """A vector turned by a quaternion message, which need not have length 1. Raises ValueError if it is 0."""
    u = np.array([quaternion.x, quaternion.y, quaternion.z])  # type: ignore[attr-defined]
    w = float(quaternion.w)  # type: ignore[attr-defined]
    square = w * w + u @ u
    if not square > 0:
        raise ValueError("the orientation is 0")
    return vector + 2 / square * np.cross(u, np.cross(u, vector) + w * vector)


def seconds(stamp: object) -> float:
    return stamp.sec + stamp.nanosec * 1e-9  # type: ignore[attr-defined,no-any-return]


class NeedleNode(Node):
    """Publishes the force of the scene on the needle for each pose. The force acts at the tip: the torque is 0."""

    def __init__(self) -> None:
        super().__init__("needle")
        self.declare_parameter("scene", "venipuncture")
        self.declare_parameter("tool_axis", [0.0, 0.0, 1.0])
        self.declare_parameter("frame_id", "")
        self.declare_parameter("longest_gap_s", 0.25)
        self.declare_parameter("hold_last_pose", False)
        scene = load_scene(self.get_parameter("scene").value)
        self._needle = PosedNeedle(
            scene, longest_gap=self.get_parameter("longest_gap_s").value,
            hold_last_pose=self.get_parameter("hold_last_pose").value, notice=self.get_logger().warning,
        )  # fmt: skip
        self._last: tuple[PoseStamped, float, float] | None = None  # the last pose, its time and the clock then
        self._axis = np.array(self.get_parameter("tool_axis").value, float)
        self._frame = self.get_parameter("frame_id").value
        chosen = QoSOverridingOptions(_QOS)  # by parameters qos_overrides.TOPIC.subscription.reliability, ...
        self._publisher = self.create_publisher(WrenchStamped, "needle_wrench", 10, qos_overriding_options=chosen)
        self.create_subscription(PoseStamped, "needle_pose", self.on_pose, 10, qos_overriding_options=chosen)
        if self._needle.hold_last_pose:
            self.create_timer(_HOLD_S, self.on_timer)
        self.get_logger().info(f"scene {scene.name!r}, {scene.servo.rate:g} ticks a second")

    def on_pose(self, message: PoseStamped) -> None:
        if self._frame and message.header.frame_id != self._frame:
            self._warn(f"a pose in {message.header.frame_id!r}, not in {self._frame!r}: not used")
            return
        at, time = message.pose.position, seconds(message.header.stamp)
        if time == 0:  # not set, as by `ros2 topic pub`
            time = self._now()
        try:
            axis = rotated(message.pose.orientation, self._axis)
            force = self._needle.move(time, [at.x, at.y, at.z], axis)
        except ValueError as error:
            self._warn(f"this pose is not used: {error}")
            return
        self._last = message, time, self._now()
        self._publish(message.header.stamp, message.header.frame_id, force)

    def on_timer(self) -> None:
        """Goes on at the last pose, a little behind: the next pose may be on its way."""
        if self._last is not None:
            message, time, clock = self._last
            held = max(time, time + self._now() - clock - _HOLD_S)
            try:
                force = self._needle.hold(held)
            except ValueError as error:  # the clock was set by more than an hour
                self._warn(f"the last pose is held no longer: {error}")
                self._last = None
                return
            self._publish(Time(sec=int(held), nanosec=int(held % 1 * 1e9)), message.header.frame_id, force)

    def _now(self) -> float:
        return float(self.get_clock().now().nanoseconds * 1e-9)

    def _publish(self, stamp: object, frame: str, force: np.ndarray) -> None:
        answer = WrenchStamped()
        answer.header.stamp = stamp
        answer.header.frame_id = frame
        answer.wrench.force.x, answer.wrench.force.y, answer.wrench.force.z = (float(f) for f in force)
        self._publisher.publish(answer)

    def _warn(self, text: str) -> None:
        """At most once a second and call: poses come often."""
        self.get_logger().warning(text, throttle_duration_sec=1.0)


def main() -> None:
    rclpy.init()
    node = NeedleNode()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
