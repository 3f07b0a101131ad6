#!/usr/bin/env bash
# The ROS 2 node, with ROS where it is installed and with stand-ins otherwise, and the reader of bags.
source "$(dirname "$0")/../../tools.sh"
need_module rosbags rosbags
make_reference
rm -rf "$work" && mkdir -p "$work"
export PYTHONPATH=$here:$here/test/stand_ins
echo "the node runs with stand-ins for rclpy and geometry_msgs"
python3 "$here/test/check.py" "$reference" "$work"
