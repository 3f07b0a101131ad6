"""Writes scene files."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from decimal import Decimal
from pathlib import Path
from typing import Any

from punctura._core import Scene, scene_values
from punctura.files.units import from_si, split_key
from punctura.files.whole_file import write_whole
from punctura.scene.schema import KEYS, SceneFile, in_file


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
