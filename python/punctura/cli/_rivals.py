"""The option --rival of `punctura simulate` and `punctura run`."""

import re
from pathlib import Path

from punctura._core import Rival, rival_kinds


def rivals_of(given: str) -> list[Rival]:
    """A rival by name, with its default numbers, or those of a file of `punctura rivals --out`.

    Raises ConfigurationError.
    """
    names = {kind["name"] for kind in rival_kinds()}
    if given in names or not (Path(given).exists() or re.search(r"[./\\]", given)):
        return [Rival(given)]  # needs no package that reads files
    from punctura.rivals import load_layers

    return [layer.rival for layer in load_layers(given)]
