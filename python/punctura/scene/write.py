"""Writes scene files."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from decimal import Decimal
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from punctura._core import DisplaySettings, Membrane, PlacedMembrane, Scene, SyringeSettings, Tissue
from punctura.files.units import from_si, split_key
from punctura.files.whole_file import write_whole
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

_DENSE = PlacedMembrane("", Membrane.unchecked(1, 0, 1, 0), (0, 0, 0), (0, -1, 0)).outflow  # the default
_SKIPPED = ("gauge", "tip_angle_deg")  # the alternatives of diameter_mm and tip_angle_rad
# Written only where they differ from K06's membrane.
_ONLY_MEASURED = (
    "grip", "growth_per_mm", "tip_length_mm", "tail_length_mm", "tail_floor", "cutting_N", "set",
)  # fmt: skip


def scene_text(scene: Scene) -> str:
    """TOML from which load_scene reads the same scene, bit for bit."""
    lines = [f"name = {_string(scene.name)}"]
    needle = {"diameter": scene.needle.diameter, "tip_angle": scene.needle.tip_angle, "direction": scene.direction}
    lines += _table("[needle]", NeedleTable, needle)
    branches = [(branch.stiffness, branch.time_constant) for branch in scene.relaxation]
    coupling = _attributes(scene.coupling, CouplingTable) | _lists("coupling", {"relaxation": branches})
    lines += _table("[coupling]", CouplingTable, coupling)
    lines += _table("[servo]", ServoTable, _attributes(scene.servo, ServoTable))
    if scene.display != DisplaySettings():
        lines += _table("[display]", DisplayTable, _attributes(scene.display, DisplayTable))
    if scene.syringe is not None:
        lines += _table("[syringe]", SyringeTable, _syringe(scene.syringe))
    for placed in scene.membranes:
        values = _attributes(placed.membrane, MembraneTable) | _attributes(placed, MembraneTable) | _outflow(placed)
        values |= _tissue(placed.tissue)
        lines += _table("[[membrane]]", MembraneTable, values)
    return "\n".join(lines) + "\n"


def file_text(file: SceneFile) -> str:
    """TOML of a scene file's tables, with every number in its original key, unit and digits."""
    lines = [f"name = {_string(file.name)}"]
    for head, table in (("[needle]", file.needle), ("[coupling]", file.coupling), ("[servo]", file.servo)):
        lines += ["", head, *_given(table)]
    if file.display != DisplayTable():
        lines += ["", "[display]", *_given(file.display)]
    if file.syringe is not None:
        lines += ["", "[syringe]", *_given(file.syringe)]
    for membrane in file.membrane:
        lines += ["", "[[membrane]]", *_given(membrane)]
    return "\n".join(lines) + "\n"


def save_scene(scene: Scene, path: str | os.PathLike[str]) -> None:
    """Writes a scene file. A file at `path` stays until the new one is complete. Raises TypeError or OSError."""
    if not isinstance(scene, Scene):
        raise TypeError(f"save_scene needs a Scene, then a path; the first argument is {type(scene).__name__}")
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"save_scene needs a Scene, then a path; the second argument is {type(path).__name__}")
    write_whole(Path(path), scene_text(scene).encode("utf-8"))


def _attributes(struct: object, model: type[BaseModel]) -> dict[str, object]:
    names = [split_key(key)[0] for key in model.model_fields]
    return {name: getattr(struct, name) for name in names if hasattr(struct, name)}


def _syringe(settings: SyringeSettings) -> dict[str, object]:
    thumb = {"thumb_stiffness": settings.thumb.stiffness, "thumb_damping": settings.thumb.damping}
    return _attributes(settings.syringe, SyringeTable) | thumb


def _outflow(placed: PlacedMembrane) -> dict[str, float]:
    """Empty for tissue that takes no liquid, as in most scenes."""
    values: dict[str, float] = {}
    for name, outlet in (("outflow", placed.outflow), ("behind", placed.outflow_behind)):
        if outlet != _DENSE:
            values |= {f"{name}_resistance": outlet.resistance, f"{name}_pressure": outlet.pressure}
    return values


def _tissue(tissue: Tissue) -> dict[str, object]:
    """Only what differs from K06's membrane."""
    none = Tissue()
    values = {name: value for name, value in _attributes(tissue, MembraneTable).items() if value != getattr(none, name)}
    return values | _lists("membrane", {"grip_table": tissue.grip_table, "profile": tissue.profile})


def _lists(kind: str, rows: Mapping[str, Sequence[tuple[float, ...]]]) -> dict[str, object]:
    """Rows of the core as the lists of a table (schema.ROWS); empty ones are left out."""
    lists: dict[str, object] = {}
    for name, columns in ROWS[kind].items():
        if rows[name]:
            each = zip(columns, zip(*rows[name], strict=True), strict=True)
            lists |= {split_key(key)[0]: list(column) for key, column in each}
    return lists


def _table(head: str, model: type[BaseModel], values: Mapping[str, object]) -> list[str]:
    lines = ["", head]
    for key in model.model_fields:
        name, unit = split_key(key)
        if key not in _SKIPPED and name in values:  # keys that only describe are not in a Scene
            lines.append(f"{key} = {_value(values[name], unit)}")
    return lines


def _value(value: Any, unit: Any) -> str:
    if isinstance(value, str):
        return _string(value)
    if isinstance(value, (float, int)):
        return _number(from_si(float(value), unit))
    return "[" + ", ".join(_value(float(v), unit) for v in value) + "]"


def _given(table: BaseModel) -> list[str]:
    fields = type(table).model_fields
    left_out = {key for key, value in table if value is None or (value == () and fields[key].default == ())}
    left_out |= {key for key, value in table if key in _ONLY_MEASURED and value == fields[key].default}
    return [f"{key} = {_as_given(value)}" for key, value in table if key not in left_out]


def _as_given(value: Any) -> str:
    if isinstance(value, str):
        return _string(value)
    if isinstance(value, tuple):
        return "[" + ", ".join(_number(v) for v in value) + "]"
    return str(value) if isinstance(value, int) else _number(value)


def _number(value: Decimal) -> str:
    """A TOML float: it needs a point or an exponent."""
    text = str(value.normalize())
    if value == value.to_integral_value() and abs(value) < 10**17:
        text = f"{value:.1f}" if not value.is_zero() else str(float(value))
    elif "E" not in text and "." not in text:
        text += ".0"
    return text.replace("E+", "e").replace("E", "e")


def _string(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
