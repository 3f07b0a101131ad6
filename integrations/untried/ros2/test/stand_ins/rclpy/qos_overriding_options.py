"""A stand-in for the choice of policies that parameters may override."""

from typing import NamedTuple

from rclpy.qos import QoSPolicyKind


class QoSOverridingOptions(NamedTuple):
    policy_kinds: tuple[QoSPolicyKind, ...] = ()
