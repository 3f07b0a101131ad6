"""What Punctura raises. A configuration error names everything that is wrong, at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final, NamedTuple

from punctura._core import PuncturaError


class _Missing:
    """Stands for the value of a field that is not there."""

    def __repr__(self) -> str:
        return "MISSING"


MISSING: Final = _Missing()


class Problem(NamedTuple):
    """One thing that is wrong: the field, what was given, and the bound it breaks with the reason for that bound."""

    path: str
    value: object
    reason: str

    def __str__(self) -> str:
        given = "" if self.value is MISSING else f" = {_brief(repr(self.value))}"
        return f"{self.path}{given}: {self.reason}" if self.path else self.reason


def _brief(text: str) -> str:
    """For a line of a message: whole lists of numbers would bury the reason."""
    return text if len(text) <= 200 else f"{text[:150]} ... ({len(text)} characters)"


class ConfigurationError(PuncturaError, ValueError):
    """A needle, membrane or scene that cannot be. `problems` holds every one of its faults."""

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
