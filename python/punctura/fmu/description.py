"""The model description of an FMU, modelDescription.xml, in the words of FMI 2.0 and 3.0."""

from __future__ import annotations

from collections.abc import Iterable
from math import isfinite
from uuid import UUID, uuid5
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from punctura import __version__
from punctura._core import Scene
from punctura.fmu.units import base_units
from punctura.fmu.variables import Variable, scene_file_text

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


def _variability(variable: Variable) -> str:
    if variable.causality == "parameter":
        return "fixed"
    return "discrete" if variable.kind == "integer" else "continuous"


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
        attributes = {"name": variable.name, "valueReference": str(variable.reference)}
        attributes |= {"causality": variable.causality, "variability": _variability(variable)}
        if variable.causality in ("parameter", "output"):
            attributes["initial"] = "exact" if variable.causality == "parameter" else "calculated"
        if variable.description:
            attributes["description"] = variable.description
        element = SubElement(listed, "ScalarVariable", attributes)
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
        attributes = {"name": variable.name, "valueReference": str(variable.reference)}
        attributes |= {"causality": variable.causality, "variability": _variability(variable)}
        if variable.causality in ("parameter", "output"):
            attributes["initial"] = "exact" if variable.causality == "parameter" else "calculated"
        if variable.description:
            attributes["description"] = variable.description
        SubElement(listed, types[variable.kind], attributes | _type_attributes(variable))
    structure = SubElement(root, "ModelStructure")
    for name in ("Output", "InitialUnknown"):
        for variable in found:
            if variable.causality == "output":
                SubElement(structure, name, valueReference=str(variable.reference))
    return _finish(root)
