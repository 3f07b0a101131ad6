"""Converts a scene file's tables to the core's structs, in SI."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from decimal import Decimal
from typing import Any, NamedTuple, TypeAlias

from pydantic import BaseModel

from punctura._core import (
    Coupling,
    DisplaySettings,
    MaxwellBranch,
    Membrane,
    Needle,
    Outlet,
    PlacedMembrane,
    Scene,
    ServoSettings,
    Syringe,
    SyringeSettings,
    Tissue,
)
from punctura.files.units import split_key, to_si
from punctura.scene.gauges import GAUGE_DIAMETER_MM
from punctura.scene.schema import (
    ROWS,
    CouplingTable,
    DisplayTable,
    MembraneTable,
    NeedleTable,
    SceneFile,
    ServoTable,
    SyringeTable,
)

Values: TypeAlias = dict[str, Any]  # of one table, by the names of the core; the schema has their types

# What stands in for a value that is missing or of the wrong type while the core looks at the others. Chosen so that
# it never causes a problem in another field: friction times tan(tip_angle) stays far below 1, K06 (7).
_STAND_INS: Values = {
    "name": "", "diameter": 1e-3, "tip_angle": 1e-6, "direction": "stylus", "stiffness": 1.0, "damping": 1.0,
    "rate": 1000.0, "low_pass": 0.0, "solver": "exact", "conditioning": "low_pass", "encoder_step": 0.0,
    "sub_steps": 1.0, "grip": "linear", "growth": 0.0, "tip_length": 0.0, "tail_length": 0.0, "tail_floor": 1.0,
    "cutting": 0.0, "set": 0.0,
    "force_scale": 1.0, "behind": "tissue", "look": "plain", "precompression": 0.0, "friction": 1e-6,
    "thickness": 0.0, "bore": 1e-2, "liquid": 1e-6, "air": 0.0, "compliance": 1e-12,
    "resistance": 1e9, "thumb_stiffness": 1.0, "thumb_damping": 1.0, "outflow_resistance": 1.0,
    "outflow_pressure": 0.0, "behind_resistance": 1.0, "behind_pressure": 0.0,
    "point": [0.0, 0.0, 0.0], "inward_normal": [0.0, -1.0, 0.0],
}  # fmt: skip


class Parts(NamedTuple):
    """The arguments of a Scene, and the mapping from the core's names to the file's keys."""

    arguments: tuple[Any, ...]  # for Scene and for scene_problems
    keys: dict[str, str]  # core path -> path in the file
    stand_ins: set[str]  # core paths with a substitute value instead of the file's


class _Reader:
    def __init__(self, unsound: Collection[str]) -> None:
        self.unsound = unsound
        self.keys: dict[str, str] = {}
        self.stand_ins: set[str] = set()

    def table(self, raw: object, path: str, model: type[BaseModel]) -> Values:
        """The values of one table by the core's names; a default or a substitute for missing or unusable ones."""
        given: Mapping[str, Any] = raw if isinstance(raw, dict) else {}
        values: Values = {}
        for key, info in model.model_fields.items():
            name, unit = split_key(key)
            if key == "gauge":
                name, unit = split_key("diameter_mm")
            core_path, key_path = f"{path}.{name}", f"{path}.{key}"
            if key in given and key_path not in self.unsound:
                self.keys[core_path] = key_path
                value = Decimal(GAUGE_DIAMETER_MM[given[key]]) if key == "gauge" else given[key]
                values[name] = _si(value, unit)
            elif key not in given and info.default is not None and not info.is_required():
                values[name] = _si(info.default, unit)
            elif values.get(name) is None:
                values[name] = None
        for name, value in values.items():
            if value is None:
                self.stand_ins.add(f"{path}.{name}")
                values[name] = _STAND_INS.get(name, ())
        return values

    def rows(self, values: Values, path: str, kind: str) -> dict[str, list[Any]]:
        """The lists of a table (schema.ROWS), as rows; takes them out of `values`. As long as the shortest list."""
        lists: dict[str, list[Any]] = {}
        for name, columns in ROWS[kind].items():
            taken = [values.pop(split_key(key)[0]) for key in columns]
            lists[name] = list(zip(*taken, strict=False))
            if any(f"{path}.{key}" in self.unsound for key in columns):
                self.stand_ins.add(f"{path}.{name}")
            for key, field in columns.items():
                self.keys.setdefault(f"{path}.{name}", f"{path}.{key}")
                for i in range(len(lists[name])):
                    self.keys[f"{path}.{name}[{i}].{field}"] = f"{path}.{key}[{i}]"
        return lists


def _si(value: Any, unit: Any) -> Any:
    if isinstance(value, (list, tuple)):
        return [_si(v, unit) for v in value]
    if isinstance(value, (int, float)):
        value = Decimal(repr(value))
    return to_si(value, unit) if isinstance(value, Decimal) else value


def scene_parts(data: Mapping[str, object], unsound: Collection[str] = ()) -> Parts:
    """Reads all usable values of the tables; `unsound` are the paths that the schema has refused."""
    reader = _Reader(unsound)
    needle = reader.table(data.get("needle"), "needle", NeedleTable)
    coupling = reader.table(data.get("coupling"), "coupling", CouplingTable)
    branches = reader.rows(coupling, "coupling", "coupling")["relaxation"]
    servo = reader.table(data.get("servo"), "servo", ServoTable)
    display = reader.table(data.get("display"), "display", DisplayTable)
    tables = data.get("membrane")
    membranes = []
    for i, raw in enumerate(tables if isinstance(tables, list) else []):
        m = reader.table(raw, f"membrane[{i}]", MembraneTable)
        membrane = Membrane.unchecked(m["stiffness"], m["precompression"], m["friction"], m["thickness"])
        placed = m["name"], membrane, m["point"], m["inward_normal"], m["behind"], m["look"]
        outflow = Outlet.unchecked(m["outflow_resistance"], m["outflow_pressure"])
        behind = Outlet.unchecked(m["behind_resistance"], m["behind_pressure"])
        rows = reader.rows(m, f"membrane[{i}]", "membrane")
        tip_and_tail = {name: m[name] for name in ("tip_length", "tail_length", "tail_floor")}
        hole = {name: m[name] for name in ("cutting", "set")}
        tissue = Tissue.unchecked(
            m["grip"], m["growth"], rows["grip_table"], profile=rows["profile"], **tip_and_tail, **hole
        )
        membranes.append(PlacedMembrane.unchecked(*placed, outflow, behind, tissue))
    name = data.get("name")
    if not isinstance(tables, list) or "membrane" in unsound:
        reader.stand_ins.add("membrane")
    arguments = (
        name if isinstance(name, str) else "scene",
        Needle.unchecked(needle["diameter"], needle["tip_angle"]),
        Coupling.unchecked(coupling["stiffness"], coupling["damping"]),
        membranes,
        ServoSettings.unchecked(**servo),
        needle["direction"],
        DisplaySettings.unchecked(**display),
        _syringe(reader, data.get("syringe")),
        [MaxwellBranch.unchecked(*branch) for branch in branches],
    )
    return Parts(arguments, reader.keys, reader.stand_ins)


def _syringe(reader: _Reader, raw: object) -> SyringeSettings | None:
    if raw is None:
        return None
    s = reader.table(raw, "syringe", SyringeTable)
    thumb = Coupling.unchecked(s.pop("thumb_stiffness"), s.pop("thumb_damping"))
    return SyringeSettings(Syringe.unchecked(**s), thumb)


def build_scene(scene_file: SceneFile) -> Scene:
    """The scene of a valid scene file."""
    return Scene(*scene_parts(scene_file.model_dump(mode="python", exclude_none=True)).arguments)
