"""Restores pickled proxies, insertions and fleets."""

from typing import Any


def restored(cls: Any, arguments: tuple[Any, ...], state: Any) -> Any:
    """Creates an object from its constructor arguments and sets its state."""
    made = cls(*arguments)
    made.state = state
    return made
