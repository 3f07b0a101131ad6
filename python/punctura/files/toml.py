"""Reads TOML files: scenes, limits, placements, exercises. Errors are plain sentences."""

import re
import stat
import sys
from collections.abc import Callable
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import NamedTuple, TypeAlias, cast

from punctura.errors import MISSING, ConfigurationError, Problem

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

Tables: TypeAlias = dict[str, object]  # tables of a TOML file
Location: TypeAlias = tuple[int | str, ...]  # place of a value in the file: ("membrane", 1, "friction")

MOST_BYTES = 256 * 1024  # a scene of 64 membranes takes a tenth of it
_MOST_NESTED = 16  # nested lists and tables; a scene has three levels
_MOST_DOTS = 16  # in one key; a scene needs one
_LONGEST_WORD = 1000  # characters of a number or an unquoted key

# A string without an end quote counts up to the end of the file, so that no character is scanned twice.
TOKEN = re.compile(
    r'''"""(?:[^\\]|\\.)*?(?:"{3,5}|\\?\Z)'''
    r"""|\'\'\'.*?(?:'{3,5}|\Z)"""
    r"""|"(?:[^"\\\n]|\\.)*"?|'[^'\n]*'?"""
    r"""|\#[^\n]*|[\w-]+|[\[\]{}.=,\n]""",
    re.DOTALL,
)


class Excess(NamedTuple):
    """The first place that exceeds a limit: the line and the reason."""

    line: int
    reason: str


def excess(text: str) -> Excess | None:
    """The first place of a text that exceeds a limit, None if there is none. The text need not be valid TOML."""
    line, nested, dots = 1, 0, 0
    for found in TOKEN.finditer(text):
        token = found[0]
        first = token[0]
        if first in "\"'":
            line += token.count("\n")
        elif first in "[{":
            nested, dots = nested + 1, 0
        elif first in "]}":
            nested = max(0, nested - 1)
        elif first in "=,\n":
            line, dots = line + (first == "\n"), 0
        elif first == ".":
            dots += 1
        elif first != "#" and len(token) > _LONGEST_WORD:
            return Excess(line, f"a number or a key has {len(token)} characters; the limit is {_LONGEST_WORD}")
        if nested > _MOST_NESTED:
            return Excess(line, f"lists and tables are nested more than {_MOST_NESTED} deep")
        if dots > _MOST_DOTS:
            return Excess(line, f"a key has more than {_MOST_DOTS} dots")
    return None


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


def key_lines(text: str) -> dict[Location, int]:
    """The line of each key and each table head of a valid TOML text, by its place, as ("membrane", 1, "friction").

    Keys inside inline tables are not among them.
    """
    lines: dict[Location, int] = {}
    counts: dict[Location, int] = {}  # tables of each list
    table: Location = ()
    line, nested, brackets, in_value = 1, 0, 0, False
    names: list[str] = []
    for found in TOKEN.finditer(text):
        token = found[0]
        if token == "\n":
            if nested == 0:
                if brackets:
                    table = _place(names, counts, brackets == 2)
                    lines.setdefault(table, line)
                names, brackets, in_value = [], 0, False
            line += 1
        elif token[0] == "#":
            continue
        elif in_value:
            nested += (token in "[{") - (token in "]}")
            line += token.count("\n")
        elif token == "[":
            brackets += 1
        elif token == "=":
            lines.setdefault((*table, *names), line)
            in_value = True
        elif token not in "].,":
            names.append(token[1:-1] if token[0] in "\"'" else token)
    return lines


def _place(names: list[str], counts: dict[Location, int], in_list: bool) -> Location:
    """The place of a table head, with the number of the last table in each list on the way."""
    place: Location = ()
    for i, name in enumerate(names):
        place = (*place, name)
        if in_list and i == len(names) - 1:
            counts[place] = counts.get(place, 0) + 1
        if place in counts:
            place = (*place, counts[place] - 1)
    return place
