"""Converts a scene file's tables to the core's scene in SI, and a scene to the text of a file."""

import json
import os
from collections.abc import Collection, Iterator, Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any

from punctura._core import Scene, SceneKey, gauge_diameters, scene_from_values, scene_values
from punctura.errors import ConfigurationError, Problem
from punctura.files.units import from_si, split_key, to_si
from punctura.files.whole_file import write_whole
from punctura.scene.schema import KEYS, ROWS, SceneFile, in_file


class Parts:
    """What a file's tables give, by the paths of the core.

    unsound: paths that the schema has refused. They are left out, so that the core checks the others.
    """

    def __init__(self, data: Mapping[str, Any], unsound: Collection[str] = ()) -> None:
        self._unsound = unsound
        self.values: dict[str, float | str] = {}
        self.keys: dict[str, str] = {}  # core path -> path in the file
        self.left_out: set[str] = set()  # core paths that the file should have, but does not have or has wrong
        tables = data.get("membrane")
        self.membranes = len(tables) if isinstance(tables, list) else 0
        if not isinstance(tables, list) or "membrane" in unsound:
            self.left_out.add("membrane")
        self.syringe = data.get("syringe") is not None
        self._read(data, "", "")
        for table in KEYS:
            if table == "membrane":
                for i in range(self.membranes):
                    self._read(data[table][i], table, f"{table}[{i}].")
            elif table and (table != "syringe" or self.syringe):
                self._read(data.get(table), table, f"{table}.")

    def scene(self) -> tuple[Scene | None, list[Problem]]:
        """The scene, or its problems, with the paths of the core."""
        scene, problems = scene_from_values(self.values, self.membranes, self.syringe)
        return scene, [Problem(*problem) for problem in problems]

    def _read(self, raw: object, table: str, dot: str) -> None:
        given: Mapping[str, Any] = raw if isinstance(raw, dict) else {}
        for key in KEYS[table]:
            path, place = dot + key.name, dot + key.key
            if key.kind != "column" and key.key in given and place not in self._unsound:
                self.keys[path] = place
                self._set(path, _si(key, given[key.key]))
        self.left_out |= {dot + key.name for key in KEYS[table] if key.required} - self.keys.keys()
        for name, columns in ROWS[table].items():
            self._read_rows(given, f"{dot}{name}", {f"{dot}{key}": column for key, column in columns.items()}, dot)

    def _read_rows(self, given: Mapping[str, Any], path: str, columns: Mapping[str, str], dot: str) -> None:
        self.keys[path] = next(iter(columns))
        if any(place in self._unsound for place in columns):
            self.left_out.add(path)
            return
        for place, column in columns.items():
            key = place[len(dot) :]
            for i, value in enumerate(given.get(key, ())):
                self.keys[f"{path}[{i}].{column}"] = f"{place}[{i}]"
                self._set(f"{path}[{i}].{column}", to_si(_decimal(value), split_key(key)[1]))

    def _set(self, path: str, value: Any) -> None:
        if isinstance(value, list):
            self.values |= {f"{path}[{k}]": number for k, number in enumerate(value)}
        else:
            self.values[path] = value


def _decimal(value: Any) -> Decimal:
    return value if isinstance(value, Decimal) else Decimal(repr(value))


def _si(key: SceneKey, value: Any) -> Any:
    if key.kind == "gauge":
        return gauge_diameters()[value]
    if isinstance(value, str):
        return value
    unit = split_key(key.key)[1]
    return [to_si(_decimal(v), unit) for v in value] if key.kind == "vector" else to_si(_decimal(value), unit)


def build_scene(scene_file: SceneFile) -> Scene:
    """The scene of a valid scene file."""
    scene, problems = Parts(scene_file.model_dump(mode="python", exclude_none=True)).scene()
    if scene is None:
        raise ConfigurationError(problems)
    return scene


def scene_text(scene: Scene) -> str:
    """TOML from which load_scene reads the same scene, bit for bit."""
    values = scene_values(scene)
    lines: list[str] = []
    for table, keys in KEYS.items():
        for i in range(len(scene.membranes) if table == "membrane" else 1):
            dot = "" if not table else f"membrane[{i}]." if table == "membrane" else f"{table}."
            given = [(key, values.get(dot + key.name)) for key in keys if not key.instead_of]
            lines += _table(table, [
                f"{key.key} = {_value(value, split_key(key.key)[1])}" for key, value in given
                if value is not None and value != [] and not (key.sparse and value == key.default)
            ])  # fmt: skip
    return "\n".join(lines) + "\n"


def file_text(file: SceneFile) -> str:
    """TOML of a scene file's tables, with every number in its original key, unit and digits."""
    lines: list[str] = []
    for table, keys in KEYS.items():
        given = getattr(file, table) if table else file
        for one in given if isinstance(given, list) else [given] if given is not None else []:
            written = [(key, getattr(one, key.key)) for key in keys]
            lines += _table(table, [
                f"{key.key} = {_as_given(value)}" for key, value in written
                if value is not None and value != () and not (key.sparse and value == in_file(key, key.default))
            ])  # fmt: skip
    return "\n".join(lines) + "\n"


def _table(table: str, body: list[str]) -> Iterator[str]:
    if table and body:
        yield from ("", f"[[{table}]]" if table == "membrane" else f"[{table}]")
    yield from body


def save_scene(scene: Scene, path: str | os.PathLike[str]) -> None:
    """Writes a scene file. A file at `path` stays until the new one is complete. Raises TypeError or OSError."""
    if not isinstance(scene, Scene):
        raise TypeError(f"save_scene needs a Scene, then a path; the first argument is {type(scene).__name__}")
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"save_scene needs a Scene, then a path; the second argument is {type(path).__name__}")
    write_whole(Path(path), scene_text(scene).encode("utf-8"))


def _value(value: Any, unit: Any) -> str:
    if isinstance(value, str):
        return _string(value)
    if isinstance(value, (float, int)):
        return _number(from_si(float(value), unit))
    return "[" + ", ".join(_value(float(v), unit) for v in value) + "]"


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
