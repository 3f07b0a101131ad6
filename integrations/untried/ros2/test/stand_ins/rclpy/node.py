"""A stand-in for rclpy's Node: topics are lists and callbacks in one process."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace

from rclpy.qos_overriding_options import QoSOverridingOptions


class Publisher:
    def __init__(self) -> None:
        self.sent: list[object] = []

    def publish(self, message: object) -> None:
        self.sent.append(message)


class Logger:
    def __init__(self) -> None:
        self.lines: list[str] = []

    def info(self, text: str) -> None:
        self.lines.append(text)

    def warning(self, text: str, *, throttle_duration_sec: float = 0.0) -> None:
        self.lines.append(text)


class Node:
    overrides: dict[str, object] = {}  # noqa: RUF012

    def __init__(self, name: str) -> None:
        self.parameters: dict[str, object] = {}
        self.publishers_by_topic: dict[str, Publisher] = {}
        self.callbacks: dict[str, Callable[[object], None]] = {}
        self.timers: list[Callable[[], None]] = []
        self.logger = Logger()
        self.clock_ns = 10**18

    def declare_parameter(self, name: str, default: object) -> None:
        self.parameters[name] = self.overrides.get(name, default)

    def get_parameter(self, name: str) -> SimpleNamespace:
        return SimpleNamespace(value=self.parameters[name])

    def create_publisher(
        self, kind: type, topic: str, depth: int, *, qos_overriding_options: QoSOverridingOptions
    ) -> Publisher:
        self._choose(f"/{topic}.publisher", depth, qos_overriding_options)
        return self.publishers_by_topic.setdefault(topic, Publisher())

    def create_subscription(
        self, kind: type, topic: str, callback: Callable[[object], None], depth: int, *,
        qos_overriding_options: QoSOverridingOptions,
    ) -> None:  # fmt: skip
        self._choose(f"/{topic}.subscription", depth, qos_overriding_options)
        self.callbacks[topic] = callback

    def _choose(self, end: str, depth: int, options: QoSOverridingOptions) -> None:
        """As rclpy: a parameter for each policy, with the name in small letters."""
        usual = {"DEPTH": depth, "DURABILITY": "volatile", "HISTORY": "keep_last", "RELIABILITY": "reliable"}
        for policy in options.policy_kinds:
            self.declare_parameter(f"qos_overrides.{end}.{policy.name.lower()}", usual[policy.name])

    def hears(self, topic: str, offered: str) -> bool:
        """Whether messages of a sender that offers this reliability reach the subscription."""
        asked = self.parameters[f"qos_overrides./{topic}.subscription.reliability"]
        return offered == "reliable" or asked == "best_effort"

    def create_timer(self, period_s: float, callback: Callable[[], None]) -> None:
        self.timers.append(callback)

    def get_logger(self) -> Logger:
        return self.logger

    def get_clock(self) -> SimpleNamespace:
        return SimpleNamespace(now=lambda: SimpleNamespace(nanoseconds=self.clock_ns))

    def destroy_node(self) -> None: ...
