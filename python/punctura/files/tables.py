"""Checks keys and types of TOML tables by a pydantic model and reports problems in plain words."""

import difflib
import json
import os
import re
from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal
from pathlib import Path
from typing import Generic, TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError
from pydantic_core import ErrorDetails

from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.toml import Location, read_tables
from punctura.files.units import split_key, to_si

Root = TypeVar("Root", bound=BaseModel)


class Table(BaseModel):
    """A table of a file. It rejects unknown keys and wrong types."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


T = TypeVar("T", bound=Table)


class Schema(Generic[Root]):
    """A file's schema: the root model, and the tables by key."""

    def __init__(
        self,
        root: type[Root],
        tables: Mapping[str, type[BaseModel]] | None = None,
        lists: Mapping[str, type[BaseModel]] | None = None,
    ) -> None:
        """tables: written [key]. lists: lists of tables, each written [[key]]."""
        self._root = root
        self._tables = dict(tables or {}) | dict(lists or {})
        self.heads = {key: f"[{key}]" for key in tables or {}} | {key: f"[[{key}]]" for key in lists or {}}

    def checked(self, tables: Mapping[str, object]) -> tuple[Root | None, list[Problem]]:
        """The file of the tables, or None and its problems."""
        try:
            return self._root.model_validate(tables), []
        except ValidationError as error:
            return None, [problem for _, problem in self.problems(error)]

    def problems(self, error: ValidationError) -> list[tuple[Location, Problem]]:
        """The problems, each with its place in the file."""
        return [(e["loc"], self._problem(e)) for e in error.errors(include_url=False)]

    def _problem(self, error: ErrorDetails) -> Problem:
        location, given = error["loc"], shown(error["input"])
        path = path_of(location)
        if error["type"] == "missing":
            return Problem(path, MISSING, missing(self.heads.get(path)))
        return Problem(path, given, self._reason(error, location))

    def _reason(self, error: ErrorDetails, location: Location) -> str:
        kind, key = error["type"], str(location[-1])
        if kind == "extra_forbidden":
            names = [part for part in location if isinstance(part, str)]
            return unknown_key(names[-1], self._root if len(names) == 1 else self._tables[names[0]])
        if kind == "literal_error":
            return f"must be {error['ctx']['expected']}"
        if kind == "bool_type":
            return "must be true or false"
        if kind in ("model_type", "model_attributes_type"):
            return f"must be a table, {self.heads.get(str(location[0]), f'[{key}]')}"
        if kind == "list_type":
            return f"must be a list of tables; begin each with [[{key}]]"
        unit = split_key(key)[1].name
        return error["msg"] + (f" ({unit})" if unit else "")


def missing(head: str | None) -> str:
    """The reason for a key that is missing. head: of a table, such as "[needle]"."""
    return f"is missing; write a table {head}" if head else "is missing"


def unknown_key(key: str, table: type[BaseModel]) -> str:
    """The reason for an unknown key, with a suggestion if a known key is similar."""
    known = list(table.model_fields)
    near = difflib.get_close_matches(key, known, n=1) or [k for k in known if split_key(k)[0] == key]
    return f"unknown key; did you mean {near[0]}?" if near else f"unknown key; known here: {', '.join(known)}"


def path_of(location: Location) -> str:
    """The path as text: `membrane[1].friction`. A key that needs quotes in TOML is quoted, since it may hold dots."""
    text = ""
    for part in location:
        if isinstance(part, int):
            text += f"[{part}]"
        else:
            key = part if re.fullmatch("[A-Za-z0-9_-]+", part) else json.dumps(part, ensure_ascii=False)
            text += f".{key}" if text else key
    return text


def location_of(path: str) -> Location:
    """The reverse of path_of, for paths without quotes."""
    return tuple(int(part) if part.isdigit() else part for part in re.findall(r"[^.\[\]]+", path))


def shown(value: object) -> object:
    """A value for a message. Tables and lists of tables are left out, because they are too long."""
    if isinstance(value, Decimal):
        return float(value)
    if isinstance(value, list) and not any(isinstance(v, (dict, list)) for v in value):
        return [shown(v) for v in value]
    return MISSING if isinstance(value, (dict, list)) else value


def read_table(path: str | os.PathLike[str], what: str, model: type[T], makers: Sequence[Callable[[T], object]]) -> T:
    """The file's table. what: kind of file, for the messages. Every key of the model must be optional.

    makers: make the core's structs from the table; the problems that the core finds are told under the file's keys.
    Raises ConfigurationError with everything that is wrong, in the order of the file.
    """
    data = read_tables(Path(path), what)
    located: list[tuple[Location, Problem]] = []
    try:
        table = model.model_validate(data)
    except ValidationError as error:
        located = Schema(model).problems(error)
        wrong = {location[0] for location, _ in located}
        table = model.model_validate({key: value for key, value in data.items() if key not in wrong})
    keys = {split_key(key)[0]: key for key in model.model_fields}
    for make in makers:
        try:
            make(table)
        except ConfigurationError as error:
            for problem in error.problems:
                key = keys[problem.path.rpartition(".")[2]]
                located.append(((key,), Problem(key, shown(data[key]), problem.reason)))
    if located:
        order = {key: place for place, key in enumerate(data)}
        located.sort(key=lambda one: order[str(one[0][0])])
        raise ConfigurationError([problem for _, problem in located], str(path))
    return table


def in_si(key: str, value: Decimal) -> float:
    """The value of a key in SI units: 12.5 of `deadline_ms` is 0.0125."""
    return to_si(value, split_key(key)[1])
