"""Writes an exercise as the text of a file that load_exercise reads."""

from __future__ import annotations

import json
from collections.abc import Mapping

from punctura.exercise.schema import ExerciseFile


def exercise_text(file: ExerciseFile) -> str:
    """The TOML text of an exercise. Keys with their default values are left out."""
    tables = file.model_dump(exclude_defaults=True)
    heads = {key: tables.pop(key) for key in ("start", "space")}
    goals = [goal.model_dump(exclude_defaults=True) | {"kind": goal.kind} for goal in file.goal]
    tables.pop("goal")
    parts = [_lines(tables)]
    parts += [f"\n[{key}]\n{_lines(table)}" for key, table in heads.items()]
    parts += [f"\n[[goal]]\n{_lines({'kind': goal.pop('kind')} | goal)}" for goal in goals]
    return "".join(parts)


def _lines(table: Mapping[str, object]) -> str:
    return "".join(f"{key} = {_value(value)}\n" for key, value in table.items())


def _value(value: object) -> str:
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return f"[{', '.join(_value(one) for one in value)}]"
    return repr(value)
