"""Options that verbs with a device and a page have in common."""

from pathlib import Path
from typing import Annotated

import typer

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
