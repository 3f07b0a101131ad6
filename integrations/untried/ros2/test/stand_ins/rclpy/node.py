"""A stand-in for rclpy's Node: topics are lists and callbacks in one process."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace


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

    def create_publisher(self, kind: type, topic: str, depth: int) -> Publisher:
        return self.publishers_by_topic.setdefault(topic, Publisher())

    def create_subscription(self, kind: type, topic: str, callback: Callable[[object], None], depth: int) -> None:
        self.callbacks[topic] = callback

    def create_timer(self, period_s: float, callback: Callable[[], None]) -> None:
        self.timers.append(callback)

    def get_logger(self) -> Logger:
        return self.logger

    def get_clock(self) -> SimpleNamespace:
        return SimpleNamespace(now=lambda: SimpleNamespace(nanoseconds=self.clock_ns))

    def destroy_node(self) -> None: ...
