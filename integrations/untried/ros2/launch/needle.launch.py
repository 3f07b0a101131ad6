"""ros2 launch punctura_ros needle.launch.py scene:=venipuncture"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    scene = DeclareLaunchArgument("scene", default_value="venipuncture", description="a scene file or a ready scene")
    node = Node(package="punctura_ros", executable="needle", parameters=[{"scene": LaunchConfiguration("scene")}])
    return LaunchDescription([scene, node])
