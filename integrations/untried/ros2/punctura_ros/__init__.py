"""Punctura in ROS 2: a node that answers poses with wrenches, and a reader of bags."""
