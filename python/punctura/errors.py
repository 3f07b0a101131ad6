"""The exceptions of Punctura. A ConfigurationError lists all problems at once."""

import errno
import os
from collections.abc import Sequence
from typing import Any, Final, NamedTuple

from punctura._core import PuncturaError

__all__ = [
    "ConfigurationError",
    "IncompleteCallError",
    "NoSuchFileError",
    "Problem",
    "PuncturaError",
    "sentence_of",
]


FREE_SPACE: Final = "free some space"  # on a full disk, or of a full quota


class _Missing:
    """The value of a missing field."""

    def __repr__(self) -> str:
        return "MISSING"


MISSING: Final = _Missing()


class Problem(NamedTuple):
    """One problem: the field's path, the given value, and the reason (the violated bound)."""

    path: str
    value: object
    reason: str

    def __str__(self) -> str:
        given = "" if self.value is MISSING else f" = {_brief(repr(self.value))}"
        return f"{self.path}{given}: {self.reason}" if self.path else self.reason


def _brief(text: str) -> str:
    """Shortens a value for one line of a message."""
    return text if len(text) <= 200 else f"{text[:150]} ... ({len(text)} characters)"


class ConfigurationError(PuncturaError, ValueError):
    """A needle, membrane, scene or file is invalid. `problems` lists all problems."""

    def __init__(self, problems: Sequence[Problem], source: str = "") -> None:
        self.problems = tuple(problems)
        self.source = source
        head = f"{source}: " if source else ""
        count = len(self.problems)
        super().__init__(
            f"{head}{count} problem{'s' if count != 1 else ''}\n" + "\n".join(f"  {p}" for p in self.problems)
        )

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.problems, self.source)


class NoSuchFileError(PuncturaError):
    """A file that the caller named does not exist. Each kind of file has a subclass, or a ConfigurationError."""


class IncompleteCallError(PuncturaError):
    """Options of a command are missing. The message has the whole command."""


def is_full(error: BaseException) -> bool:
    """Whether the disk, or the user's share of it, is full."""
    return isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT)


def sentence_of(error: BaseException) -> str:
    """The sentence of an error; an error of the system names its file first, has no number, and ends with the remedy
    of a full disk."""
    if not isinstance(error, OSError) or error.filename is None or not error.strerror:
        return str(error)
    what = "there is no such file" if isinstance(error, FileNotFoundError) else error.strerror
    return f"{os.fsdecode(error.filename)}: {what}" + f"; {FREE_SPACE}" * is_full(error)
