#!/usr/bin/env bash
# The node in ROS 2 itself, whose Python client is on PyPI.
source "$(dirname "$0")/../tools.sh"
with_package rclpy ros-rclpy ros-geometry-msgs ros-rmw-fastrtps-cpp
make_reference
ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST "$python" "$here/check.py" "$reference"
