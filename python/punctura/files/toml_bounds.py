"""Size limits for TOML files: scenes, limits, placements, exercises.

TOML itself has no limits. A file beyond these could take hours to read.
"""

from __future__ import annotations

import re
from typing import NamedTuple

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
