"""A stand-in for a message of builtin_interfaces."""

from dataclasses import dataclass


@dataclass
class Time:
    sec: int = 0
    nanosec: int = 0
