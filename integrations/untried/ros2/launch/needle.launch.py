"""ros2 launch punctura_ros needle.launch.py scene:=venipuncture"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    scene = DeclareLaunchArgument("scene", default_value="venipuncture", description="a scene file or a ready scene")
    reliability = DeclareLaunchArgument(
        "reliability", default_value="reliable", choices=["reliable", "best_effort"],
        description="of the poses: best_effort also gets those of senders that offer no more",
    )  # fmt: skip
    parameters = {
        "scene": LaunchConfiguration("scene"),
        "qos_overrides./needle_pose.subscription.reliability": LaunchConfiguration("reliability"),
    }
    node = Node(package="punctura_ros", executable="needle", parameters=[parameters])
    return LaunchDescription([scene, reliability, node])
