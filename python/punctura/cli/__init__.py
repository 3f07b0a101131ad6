"""The command line. Each verb is a file in this folder: `simulate.py` holds `command`, which is `punctura simulate`.

A new verb needs only a new file. Files whose names begin with an underscore are not verbs.
"""

import os
import sys
from collections.abc import Sequence

from punctura.extras import MissingPackageError, optional

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> None:
    """Runs the command line; ends the process with its exit status."""
    try:
        optional("typer", "cli", "the command punctura")
    except MissingPackageError as error:
        sys.exit(f"punctura: {error}")  # status 1, as for every package that is missing
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")  # else it searches every package that is installed
    from punctura.cli._app import main as run

    run(arguments)
