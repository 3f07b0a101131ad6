"""The variables of an FMU, and the scene as the binary reads it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf

from punctura._core import Scene, scene_values

# The value references of integrations/fmi/instance.hpp
_TIME, _INPUTS, _OUTPUTS, _RAMP, _MEMBRANES, _PARAMETERS = 0, 1, 7, 10, 100, 1000
_NO_EFFECT = ("syringe.", "display.")  # on the force on the needle
_NO_EFFECT_OF_A_MEMBRANE = (".outflow_", ".behind", ".look")


@dataclass(frozen=True)
class Variable:
    """A variable of the model description. kind: real, integer or boolean."""

    name: str
    reference: int
    causality: str
    kind: str = "real"
    unit: str = ""
    description: str = ""
    start: float | bool | None = None
    minimum: float = -inf
    maximum: float = inf


def scene_lines(scene: Scene) -> Iterator[tuple[str, float | str]]:
    """The paths and values of a scene, SI, as punctura_scene_from_values() of the C library reads them."""
    for path, word in scene_values(scene).items():
        if isinstance(word, str) and _has_effect(path):
            yield path, _one_line(word)
    for number in scene.fields():
        if _has_effect(number.path):
            yield number.path, number.value


def _has_effect(path: str) -> bool:
    return not path.startswith(_NO_EFFECT) and not any(part in path for part in _NO_EFFECT_OF_A_MEMBRANE)


def scene_file_text(scene: Scene) -> str:
    """The text of resources/scene.txt."""
    return "".join(
        f'{path} = "{value}"\n' if isinstance(value, str) else f"{path} = {value!r}\n"
        for path, value in scene_lines(scene)
    )


def variables(scene: Scene) -> list[Variable]:
    """All variables: time, inputs, outputs, the outputs of each membrane, parameters."""
    first = scene.membranes[0]
    point, normal = list(first.point), list(first.inward_normal)
    start = [p - 0.01 * n for p, n in zip(point, normal, strict=True)]
    found = [Variable("time", _TIME, "independent", unit="s", description="Simulation time")]
    for k, (name, x) in enumerate(zip("xyz", start, strict=True)):
        text = "Position of the needle's tip"
        found.append(Variable(f"position.{name}", _INPUTS + k, "input", unit="m", description=text, start=x))
    for k, (name, x) in enumerate(zip("xyz", normal, strict=True)):
        text = "Direction in which the needle points, of any length but 0"
        found.append(Variable(f"axis.{name}", _INPUTS + 3 + k, "input", description=text, start=x))
    for k, name in enumerate("xyz"):
        text = "Force on the needle"
        found.append(Variable(f"force.{name}", _OUTPUTS + k, "output", unit="N", description=text))
    text = "Inputs move in a straight line during a step; false: they jump at its start"
    found.append(Variable("ramp", _RAMP, "parameter", "boolean", description=text, start=True))
    for i, membrane in enumerate(scene.membranes):
        found += _of_membrane(i, _one_line(membrane.name))
    numbers = {number.path: number for number in scene.fields()}
    paths = [path for path, value in scene_lines(scene) if not isinstance(value, str)]
    for k, path in enumerate(paths):
        number = numbers[path]
        unit = "" if number.unit == "-" else number.unit
        symbol = f"K06: {number.symbol}" if number.symbol not in ("", "-") else ""
        bounds = (number.min, number.max)
        found.append(Variable(path, _PARAMETERS + k, "parameter", "real", unit, symbol, number.value, *bounds))
    return found


def _of_membrane(i: int, name: str) -> Iterator[Variable]:
    at, path = _MEMBRANES + 4 * i, f"membrane[{i}]"
    yield Variable(f"{path}.depth", at, "output", unit="m", description=f"{name}: depth of the needle")
    yield Variable(f"{path}.axial_force", at + 1, "output", unit="N", description=f"{name}: force along the needle")
    phases = "0 outside, 1 sticking, 2 sliding in, 3 sliding out, 4 barred"
    yield Variable(f"{path}.phase", at + 2, "output", "integer", description=f"{name}: {phases}")


def _one_line(text: str) -> str:
    return " ".join(text.split())
