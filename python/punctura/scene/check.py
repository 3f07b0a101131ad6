"""Finds all problems of a scene file's tables, in the file's own keys and units.

The schema finds wrong types, the core finds wrong values, in one pass: what the schema has refused is not given to the
core, which checks the others. It also warns of numbers that are possible, but probably in another unit.
"""

import math
from collections.abc import Iterator, Mapping
from decimal import Decimal
from typing import Any

from pydantic import ValidationError

from punctura import _core
from punctura._core import gauge_diameters
from punctura.errors import MISSING, Problem
from punctura.files.tables import Schema, location_of, shown
from punctura.files.toml import Location, Tables, key_lines
from punctura.files.units import split_key, to_si
from punctura.scene.build import Parts
from punctura.scene.schema import ALTERNATIVES, KEYS, MODELS, ROWS, SceneFile

_SCHEMA = Schema(
    SceneFile,
    {name: model for name, model in MODELS.items() if name != "membrane"},
    {"membrane": MODELS["membrane"]},
)
_EXERCISE = "this is an exercise, not a scene; punctura run --exercise FILE lists it in the tab Exercises of the page"
_ENOUGH = 100  # membranes to check: more than the core allows, and few enough to report all their problems


def check_tables(data: Tables) -> tuple[SceneFile | None, list[Problem]]:
    """The scene file of these tables if it is valid, and all problems."""
    if "goal" in data and "membrane" not in data:
        return None, [Problem("", MISSING, _EXERCISE)]
    tables = data.get("membrane")
    if isinstance(tables, list) and len(tables) > _ENOUGH:
        data = data | {"membrane": tables[:_ENOUGH]}
    problems = [(location_of(p.path), p) for p in _alternative_problems(data)]
    scene_file: SceneFile | None = None
    try:
        scene_file = SceneFile.model_validate(data)
    except ValidationError as error:
        problems = _SCHEMA.problems(error) + problems
    problems += [(location_of(p.path), p) for p in _length_problems(data, {p.path for _, p in problems})]
    problems += [(location_of(p.path), p) for p in _domain_problems(data, {p.path for _, p in problems})]
    order = _Order(data)
    problems.sort(key=lambda located: order.place(located[0]))
    return (None if problems else scene_file), [problem for _, problem in problems]


def _alternative_problems(data: Mapping[str, object]) -> Iterator[Problem]:
    needle = data.get("needle")
    if not isinstance(needle, dict):
        return
    for one, other in ALTERNATIVES:
        if one in needle and other in needle:
            yield Problem(f"needle.{other}", shown(needle[other]), f"give either {one} or {other}, not both")
        elif one not in needle and other not in needle:
            yield Problem(f"needle.{one}", MISSING, f"is missing; give either {one} or {other}")
    gauge = needle.get("gauge")
    if type(gauge) is int and gauge not in gauge_diameters():
        low, high = min(gauge_diameters()), max(gauge_diameters())
        yield Problem("needle.gauge", gauge, f"must be a gauge of ISO 9626, {low} to {high}")


def _length_problems(data: Mapping[str, object], unsound: set[str]) -> Iterator[Problem]:
    """Lists that must have the same length, as the depths and the forces of a profile."""
    membranes = data.get("membrane")
    tables = [("coupling", "coupling", data.get("coupling"))]
    tables += [
        ("membrane", f"membrane[{i}]", m) for i, m in enumerate(membranes if isinstance(membranes, list) else [])
    ]
    for kind, path, table in tables:
        if not isinstance(table, dict):
            continue
        for first, *others in (list(columns) for columns in ROWS[kind].values()):
            size = _size(table.get(first, []))
            for key in others:
                if not {f"{path}.{first}", f"{path}.{key}"} & unsound and _size(table.get(key, [])) != size:
                    reason = f"must have as many numbers as {first}, which has {size}"
                    yield Problem(f"{path}.{key}", shown(table.get(key, [])), reason)


def _size(value: object) -> int:
    return len(value) if isinstance(value, list) else 0


def _domain_problems(data: Mapping[str, object], unsound: set[str]) -> list[Problem]:
    parts = Parts(data, unsound)
    problems = []
    for path, value, reason in parts.scene()[1]:
        if path in parts.left_out:
            continue
        key_path = parts.keys.get(path, path)
        given = _lookup(data, key_path)
        shown_value = value if given is None else shown(given)
        problems.append(Problem(key_path, shown_value, reason + _bound_in_unit(key_path, value)))
    return problems


def _bound_in_unit(key_path: str, value: object) -> str:
    """The broken bound in the key's unit, if that is not the core's unit: `(at most 90 deg)`."""
    unit = split_key(key_path)[1]
    if not isinstance(value, float) or not math.isfinite(value) or unit.si == 1:
        return ""
    table, *_, name = location_of(key_path)
    for key in KEYS[str(table)]:
        if key.key != name:
            continue
        for broken, bound, word in (
            (value <= key.min, key.min, "more than" if key.min_open else "at least"),
            (value >= key.max, key.max, "less than" if key.max_open else "at most"),
        ):
            if broken and bound != 0 and math.isfinite(bound):
                return f" ({word} {bound / to_si(Decimal(1), unit):g} {unit.name})"
    return ""


def _lookup(data: object, path: str) -> object:
    for part in location_of(path):
        if isinstance(data, list) and isinstance(part, int) and part < len(data):
            data = data[part]
        elif isinstance(data, dict):
            data = data.get(part)
        else:
            return None
    return data


class _Order:
    """The order of fields in the file, so that problems are reported from top to bottom."""

    def __init__(self, data: Mapping[str, object]) -> None:
        self._data = data
        self._ranks: dict[int, dict[str, int]] = {}  # ranks of a table's keys, by the table's id

    def place(self, location: Location) -> tuple[int, ...]:
        place: list[int] = []
        here: Any = self._data
        for part in location:
            if isinstance(here, dict) and isinstance(part, str):
                if id(here) not in self._ranks:
                    self._ranks[id(here)] = {key: rank for rank, key in enumerate(here)}
                ranks = self._ranks[id(here)]
                place.append(ranks.get(part, len(ranks)))
                here = here.get(part)
            elif isinstance(here, list) and isinstance(part, int):
                place.append(part)
                here = here[part] if part < len(here) else None
        return tuple(place)


class UnusualWarning(UserWarning):
    """A number of a scene file is probably in another unit."""


def unusual_numbers(scene_file: SceneFile, text: str = "", source: str = "") -> tuple[str, ...]:
    """A sentence for each such number, with the remedy; with its line if the text of the file is given."""
    data = scene_file.model_dump(mode="python", exclude_none=True)
    lines = key_lines(text)
    return tuple(_sentences(data, lines, f"{source}, " if source else ""))


def _sentences(data: Mapping[str, object], lines: Mapping[Location, int], source: str) -> Iterator[str]:
    for path, key_path in Parts(data).keys.items():
        if "." not in path:
            continue
        table, *numbers, key = location_of(key_path)
        owner = data[str(table)]
        if numbers and isinstance(owner, list) and isinstance(numbers[0], int):
            owner = owner[numbers[0]]
        written = owner.get(key) if isinstance(owner, dict) else None
        if not isinstance(written, Decimal):
            continue
        advice = _core.unusual(path, float(written), float(split_key(str(key))[1].si))
        if advice:
            line = lines.get(location_of(key_path))
            head = f"[[{table}]]" if numbers else f"[{table}]"
            where = f"line {line}: {head} {key}" if line else key_path
            yield f"{source}{where} = {written} is unusual. {advice}"
    yield from _list_sentences(data, lines, source)


def _list_sentences(data: Mapping[str, object], lines: Mapping[Location, int], source: str) -> Iterator[str]:
    """The same for the lists of a membrane, a profile or a grip table: for one number of each."""
    membranes = data.get("membrane")
    for i, membrane in enumerate(membranes if isinstance(membranes, list) else []):
        for name, columns in ROWS["membrane"].items():
            for key, column in columns.items():
                written = [float(number) for number in membrane.get(key) or ()]
                found = _core.unusual_list(f"{name}[].{column}", written, float(split_key(key)[1].si))
                if found:
                    line = lines.get(("membrane", i, key))
                    where = f"line {line}: [[membrane]] {key}" if line else f"membrane[{i}].{key}"
                    yield f"{source}{where} has {found[0]:g}, which is unusual. {found[1]}"
