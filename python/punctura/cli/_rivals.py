"""The option --rival of `punctura simulate` and `punctura run`."""

from __future__ import annotations

from pathlib import Path

from punctura._core import Rival


def rivals_of(given: str) -> list[Rival]:
    """A rival by name, with its default numbers, or those of a file of `punctura rivals --out`.

    Raises ConfigurationError or PuncturaError.
    """
    from punctura.rivals import kinds, load_layers

    if given in kinds() or not Path(given).exists():
        return [Rival(given)]
    return [layer.rival for layer in load_layers(given)]
