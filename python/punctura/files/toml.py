"""Reads TOML files: scenes, limits, placements, exercises. Errors are plain sentences."""

from __future__ import annotations

import re
import stat
import sys
from collections.abc import Callable
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import TypeAlias, cast

from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.files.toml_bounds import MOST_BYTES, excess

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

Tables: TypeAlias = dict[str, object]  # tables of a TOML file


def _error(path: Path, reason: str, where: str = "") -> ConfigurationError:
    return ConfigurationError([Problem(where, MISSING, reason)], str(path))


def _file_of(what: str) -> str:
    return f"{'an' if what[0] in 'aeiou' else 'a'} {what} file"


def read_text(path: Path, what: str) -> str:
    """The text of a TOML file, without a byte-order mark. what: kind of file, for messages.

    Raises ConfigurationError, also for a device, a pipe, or a file larger than MOST_BYTES.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode) and not path.is_dir():  # check first: opening a pipe could block
            raise _error(path, f"is a device or a pipe, not {_file_of(what)}; save its text in a file")
        with path.open("rb") as file:
            data = file.read(MOST_BYTES + 1)
        if len(data) > MOST_BYTES:
            raise _error(path, f"is larger than {MOST_BYTES // 1024} KiB: no {what} needs that")
        return decoded(data, path)
    except FileNotFoundError:
        raise _error(path, "there is no such file") from None
    except IsADirectoryError:
        raise _error(path, f"is a folder, not {_file_of(what)}") from None
    except OSError as bad:
        raise _error(path, f"cannot be read: {bad.strerror}") from None


def decoded(data: bytes, path: Path) -> str:
    """The text of a TOML file's bytes, without a byte-order mark. path: for messages. Raises ConfigurationError."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as bad:
        line = bad.object[: bad.start].count(b"\n") + 1
        raise _error(path, "is not UTF-8 text; save it as UTF-8", f"line {line}") from None


def read_tables(path: Path, what: str, parse_float: Callable[[str], object] | None = None) -> Tables:
    """The tables of a TOML file. what, parse_float: see read_text and parse_toml. Raises ConfigurationError."""
    return parse_toml(read_text(path, what), path, parse_float)


def _decimal(text: str) -> Decimal:
    try:
        return Decimal(text)
    except InvalidOperation:  # an exponent of 19 digits: too large for Decimal; as a double it is 0 or infinite
        return Decimal(float(text))


def parse_toml(text: str, path: Path, parse_float: Callable[[str], object] | None = None) -> Tables:
    """The tables of a TOML text. parse_float: converts numbers with a fraction; default: exact decimals.

    Raises ConfigurationError.
    """
    beyond = excess(text)
    if beyond:
        raise _error(path, beyond.reason, f"line {beyond.line}")
    try:
        return cast(Tables, tomllib.loads(text, parse_float=parse_float or _decimal))
    except tomllib.TOMLDecodeError as bad:
        message = str(bad)
        found = re.search(r" \(at (line \d+, column \d+|end of document)\)$", message)
        where = found[1] if found else ""
        if where == "end of document":
            where = f"line {text.count(chr(10)) + 1}, at the end of the file"
        raise _error(path, f"is not TOML: {message[: found.start()] if found else message}", where) from None
