"""Short TOML files of numbers: where a device stands, what is allowed on it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from punctura.errors import ConfigurationError, Problem
from punctura.scene.parse import read_tables


@dataclass(frozen=True)
class Number:
    """One number. field: what it becomes; per_si: how many of the key's own unit are one SI unit."""

    field: str = ""
    per_si: float = 1
    words: ClassVar[str] = "a number"

    def fits(self, value: Any) -> bool:
        return isinstance(value, float) or (_whole(value) and abs(value) < 2**63)


@dataclass(frozen=True)
class Vector:
    """So many numbers."""

    size: int

    @property
    def words(self) -> str:
        return f"{self.size} numbers"

    def fits(self, value: Any) -> bool:
        return isinstance(value, list) and len(value) == self.size and all(Number().fits(x) for x in value)


@dataclass(frozen=True)
class Buttons:
    """Buttons by their numbers, the device's first being 1."""

    field: str
    words: ClassVar[str] = "a list of buttons, each 1 to 32"

    def fits(self, value: Any) -> bool:
        return isinstance(value, list) and all(_whole(x) and 1 <= x <= 32 for x in value)


def _whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


Key = Number | Vector | Buttons


def read_table(
    path: str | os.PathLike[str],
    what: str,
    keys: Mapping[str, Key],
    more: Callable[[dict[str, Any]], list[Problem]] | None = None,
) -> dict[str, Any]:
    """What the file says, under the file's keys. more: what else is wrong with the values that fit their keys.

    what: kind of file, for the messages. Raises ConfigurationError with all that is wrong.
    """
    table = read_tables(Path(path), what)
    problems = list(_problems(table, keys))
    if more:
        problems += more({name: table[name] for name, key in keys.items() if name in table and key.fits(table[name])})
    if problems:
        raise ConfigurationError(problems, str(path))
    return table


def _problems(table: dict[str, Any], keys: Mapping[str, Key]) -> Iterator[Problem]:
    for name, value in table.items():
        if name not in keys:
            yield Problem(name, value, f"unknown key; there are {', '.join(keys)}")
    for name, key in keys.items():
        if name in table and not key.fits(table[name]):
            yield Problem(name, table[name], f"must be {key.words}")
