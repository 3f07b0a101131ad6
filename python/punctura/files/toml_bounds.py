"""Bounds of what the reader of TOML files takes on: scenes, limits, placements, exercises.

TOML itself has no bounds; beyond these a file could take a reader hours.
"""

from __future__ import annotations

import re
from typing import NamedTuple

MOST_BYTES = 256 * 1024  # 64 membranes take a tenth of it
_MOST_NESTED = 16  # lists and tables in each other; a scene has three
_MOST_DOTS = 16  # in one key; a scene has one
_LONGEST_WORD = 1000  # characters of a number or of a key without quotes

# Of each text that begins, the end counts as its end where it has no other: then none is looked at twice.
_TOKEN = re.compile(
    r'''"""(?:[^\\]|\\.)*?(?:"{3,5}|\\?\Z)'''
    r"""|\'\'\'.*?(?:'{3,5}|\Z)"""
    r"""|"(?:[^"\\\n]|\\.)*"?|'[^'\n]*'?"""
    r"""|\#[^\n]*|[\w-]+|[\[\]{}.=,\n]""",
    re.DOTALL,
)


class Excess(NamedTuple):
    """Where a text goes beyond what is read, and how."""

    line: int
    reason: str


def excess(text: str) -> Excess | None:
    """The first place of a text, whether it is TOML or not, that the reader does not take on."""
    line, nested, dots = 1, 0, 0
    for found in _TOKEN.finditer(text):
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
            return Excess(line, f"a number or a key has {len(token)} characters; {_LONGEST_WORD} are read at most")
        if nested > _MOST_NESTED:
            return Excess(line, f"lists and tables stand more than {_MOST_NESTED} deep in each other")
        if dots > _MOST_DOTS:
            return Excess(line, f"a key has more than {_MOST_DOTS} dots")
    return None
