"""The option --rival of `punctura simulate` and `punctura run`."""

import re
from collections.abc import Sequence
from pathlib import Path

import typer

from punctura._core import Rival, rival_kinds


def rivals_of(every: Sequence[str] | None) -> list[Rival]:
    """A rival by name, with its default numbers, or those of a file of `punctura rivals --out`; none if none is given.

    Raises ConfigurationError, and typer.BadParameter for more than one.
    """
    if not every:
        return []
    if len(every) > 1:
        reason = "a run has the force of one model; `punctura rivals TRACE` fits all of them beside each other"
        raise typer.BadParameter(f"is given {len(every)} times: {reason}", param_hint="--rival")
    given = every[0]
    names = {kind["name"] for kind in rival_kinds()}
    if given in names or not given.strip() or not (Path(given).exists() or re.search(r"[./\\]", given)):
        return [Rival(given)]  # needs no package that reads files
    from punctura.rivals import load_layers

    return [layer.rival for layer in load_layers(given)]
