"""A stand-in for the kinds of policies of rclpy."""

from enum import Enum, auto


class QoSPolicyKind(Enum):
    DEPTH = auto()
    DURABILITY = auto()
    HISTORY = auto()
    RELIABILITY = auto()
