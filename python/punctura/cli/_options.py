"""Options that several verbs have: of a device, a page, and the option --rival."""

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from punctura._core import Rival, rival_kinds

Port = Annotated[int, typer.Option("--port", help="Local TCP port of the page; 0 picks a free one.", min=0, max=65535)]
NoBrowser = Annotated[bool, typer.Option("--no-browser", help="Print the page's address; do not open a browser.")]
PlacementFile = Annotated[
    Path | None,
    typer.Option(
        "--placement",
        help="TOML file with the device's pose, written by punctura place.",
        metavar="FILE.toml",
        exists=True,
        dir_okay=False,
    ),
]
LimitsFile = Annotated[
    Path | None,
    typer.Option(
        "--limits",
        help="TOML file with force and input limits (docs/safety.md).",
        metavar="FILE.toml",
        exists=True,
        dir_okay=False,
    ),
]


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
