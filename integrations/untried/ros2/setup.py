"""The ROS 2 package punctura_ros. Needs the Python package punctura with its extra files."""

from setuptools import setup

NAME = "punctura_ros"

setup(
    name=NAME,
    version="0.1.0",
    packages=[NAME],
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (f"share/{NAME}", ["package.xml"]),
        (f"share/{NAME}/launch", ["launch/needle.launch.py"]),
    ],
    install_requires=["setuptools", "punctura"],
    entry_points={"console_scripts": ["needle = punctura_ros.node:main", "bag_to_trace = punctura_ros.bag:main"]},
)
