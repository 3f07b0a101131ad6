"""The variables of an FMU and its model description, in the words of FMI 2.0 and 3.0."""

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import inf, isfinite
from uuid import UUID, uuid5
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from punctura import __version__
from punctura._core import Scene, scene_values

_UNITS: dict[str, dict[str, int]] = {
    "m": {"m": 1},
    "s": {"s": 1},
    "kg": {"kg": 1},
    "rad": {"rad": 1},
    "Hz": {"s": -1},
    "N": {"kg": 1, "m": 1, "s": -2},
    "Pa": {"kg": 1, "m": -1, "s": -2},
}


def base_units(unit: str) -> dict[str, int]:
    """The exponents of the base units: `N s/m` is kg 1, s -1. Raises ValueError for an unknown unit."""
    above, _, below = unit.partition("/")
    exponents: Counter[str] = Counter()
    for part, sign in ((above, 1), (below, -1)):
        for factor in part.split():
            match = re.fullmatch(r"([A-Za-z]+)(?:\^(\d+))?", factor)
            if factor == "1":
                continue
            if match is None or match[1] not in _UNITS:
                raise ValueError(f"unit {unit!r}: {factor!r} is unknown")
            for base, exponent in _UNITS[match[1]].items():
                exponents[base] += sign * exponent * int(match[2] or 1)
    return {base: exponent for base, exponent in exponents.items() if exponent}


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


_NAMESPACE = UUID("6f3f5d0e-53a7-4d0a-9d51-0b1b7d3f6a10")
_ABILITIES = {
    "canHandleVariableCommunicationStepSize": "true",
    "canBeInstantiatedOnlyOncePerProcess": "false",
}


def model_description(scene: Scene, found: list[Variable], version: int, identifier: str) -> bytes:
    """modelDescription.xml. version: 2 or 3. identifier: the name of the binary without suffix."""
    token = str(uuid5(_NAMESPACE, f"{__version__}\n{identifier}\n{scene_file_text(scene)}"))
    return (_version_2 if version == 2 else _version_3)(scene, found, identifier, token)


def _root(scene: Scene, version: str, names: dict[str, str]) -> Element:
    attributes = {
        "fmiVersion": version,
        "modelName": scene.name or "scene",
        "description": "The force of a needle that goes through tissue membranes (K06)",
        "generationTool": f"Punctura {__version__}",
        "variableNamingConvention": "structured",
    }
    return Element("fmiModelDescription", attributes | names)


def _add_units(root: Element, found: Iterable[Variable]) -> None:
    definitions = SubElement(root, "UnitDefinitions")
    for unit in sorted({variable.unit for variable in found} - {""}):
        exponents = {base: str(exponent) for base, exponent in base_units(unit).items()}
        SubElement(SubElement(definitions, "Unit", {"name": unit}), "BaseUnit", exponents)


def _add_experiment(root: Element, scene: Scene) -> None:
    period = repr(1 / scene.servo.rate)
    SubElement(root, "DefaultExperiment", startTime="0.0", stopTime="1.0", stepSize=period)


def _type_attributes(variable: Variable) -> dict[str, str]:
    attributes = {"unit": variable.unit} if variable.unit else {}
    for name, bound in (("min", variable.minimum), ("max", variable.maximum)):
        if isfinite(bound):
            attributes[name] = repr(bound)
    if variable.start is not None:
        attributes["start"] = str(variable.start).lower() if isinstance(variable.start, bool) else repr(variable.start)
    return attributes


def _attributes(variable: Variable) -> dict[str, str]:
    attributes = {"name": variable.name, "valueReference": str(variable.reference), "causality": variable.causality}
    varies = "discrete" if variable.kind == "integer" else "continuous"
    attributes["variability"] = "fixed" if variable.causality == "parameter" else varies
    if variable.causality in ("parameter", "output"):
        attributes["initial"] = "exact" if variable.causality == "parameter" else "calculated"
    if variable.description:
        attributes["description"] = variable.description
    return attributes


def _finish(root: Element) -> bytes:
    indent(root)
    xml: bytes = tostring(root, encoding="utf-8", xml_declaration=True)
    return xml + b"\n"


def _version_2(scene: Scene, found: list[Variable], identifier: str, token: str) -> bytes:
    root = _root(scene, "2.0", {"guid": token})
    abilities = {"canInterpolateInputs": "true", "canGetAndSetFMUstate": "true", "canSerializeFMUstate": "true"}
    SubElement(root, "CoSimulation", {"modelIdentifier": identifier, **_ABILITIES, **abilities})
    _add_units(root, found)
    _add_experiment(root, scene)
    listed = SubElement(root, "ModelVariables")
    types = {"real": "Real", "integer": "Integer", "boolean": "Boolean"}
    for variable in found:
        element = SubElement(listed, "ScalarVariable", _attributes(variable))
        SubElement(element, types[variable.kind], _type_attributes(variable))
    structure = SubElement(root, "ModelStructure")
    indices = [str(i) for i, variable in enumerate(found, 1) if variable.causality == "output"]
    for name in ("Outputs", "InitialUnknowns"):
        unknowns = SubElement(structure, name)
        for index in indices:
            SubElement(unknowns, "Unknown", index=index)
    return _finish(root)


def _version_3(scene: Scene, found: list[Variable], identifier: str, token: str) -> bytes:
    root = _root(scene, "3.0", {"instantiationToken": token})
    period = repr(1 / scene.servo.rate)
    abilities = {"canGetAndSetFMUState": "true", "canSerializeFMUState": "true", "fixedInternalStepSize": period}
    SubElement(root, "CoSimulation", {"modelIdentifier": identifier, **_ABILITIES, **abilities})
    _add_units(root, found)
    _add_experiment(root, scene)
    listed = SubElement(root, "ModelVariables")
    types = {"real": "Float64", "integer": "Int32", "boolean": "Boolean"}
    for variable in found:
        SubElement(listed, types[variable.kind], _attributes(variable) | _type_attributes(variable))
    structure = SubElement(root, "ModelStructure")
    for name in ("Output", "InitialUnknown"):
        for variable in found:
            if variable.causality == "output":
                SubElement(structure, name, valueReference=str(variable.reference))
    return _finish(root)
