"""A stand-in for what the controller uses of SofaPython3, for tests without SOFA. No copy of its code."""

from collections.abc import Iterator
from contextlib import contextmanager
from types import SimpleNamespace

import numpy as np


class Data:
    def __init__(self, value: list[list[float]]) -> None:
        self.value = np.array(value, float)

    @contextmanager
    def writeable(self) -> Iterator[np.ndarray]:
        yield self.value


class MechanicalObject:
    def __init__(self, pose: list[float]) -> None:
        self.position = Data([pose])
        self.context = SimpleNamespace(time=SimpleNamespace(value=0.0))

    def getContext(self) -> SimpleNamespace:
        return self.context


class ConstantForceField:
    def __init__(self) -> None:
        self.forces = Data([[0.0] * 6])


class Core:
    class Controller:
        def __init__(self, *args: object, **kwargs: object) -> None: ...
