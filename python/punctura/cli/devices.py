"""`punctura devices`: lists the devices, and why a device is not available."""

import json
from typing import Annotated

import typer

from punctura.live import enumerate_devices


def command(
    verbose: Annotated[bool, typer.Option("--verbose", help="Also print where a library was looked for.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the list as JSON.")] = False,
) -> None:
    """Lists the devices. If one is not available, says what to do."""
    entries = enumerate_devices()
    if as_json:
        typer.echo(json.dumps(entries, indent=2))
        return
    for entry in entries:
        names = ": " + ", ".join(entry["devices"]) if entry["devices"] else ""
        typer.echo(f"{entry['backend']:16} {entry['state'].replace('_', ' ')}{names}")
        for line in entry["detail"].splitlines()[: None if verbose else 1]:
            typer.echo(f"{'':16} {line}")
