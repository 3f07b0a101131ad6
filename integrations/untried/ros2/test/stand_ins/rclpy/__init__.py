"""A stand-in for the few functions of rclpy that the node uses, for tests without ROS. No copy of its code."""


def init() -> None: ...


def spin(node: object) -> None: ...


def try_shutdown() -> None: ...
