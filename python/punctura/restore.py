"""How pickle makes a proxy or an insertion again."""

from __future__ import annotations

from typing import Any


def restored(cls: Any, arguments: tuple[Any, ...], state: bytes) -> Any:
    """An object of the class, made of what its constructor was given, that goes on from the state."""
    made = cls(*arguments)
    made.state = state
    return made
