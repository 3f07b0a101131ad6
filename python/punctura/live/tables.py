"""Short TOML files of one table: the place of a device, its limits."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from decimal import Decimal
from pathlib import Path
from typing import TypeVar

from pydantic import ValidationError

from punctura.errors import ConfigurationError, Problem
from punctura.files.tables import Schema, Table, shown
from punctura.files.toml import Location, read_tables
from punctura.files.units import split_key, to_si

T = TypeVar("T", bound=Table)


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
