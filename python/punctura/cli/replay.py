"""`punctura replay`: computes a recording's forces again from its inputs."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from punctura.cli._out import notice
from punctura.cli._status import FAILED
from punctura.progress import progress_bar


def command(
    file: Annotated[Path, typer.Argument(help="A recording, finished or not.", metavar="FILE")],
    out: Annotated[
        Path | None, typer.Option("--out", help="Recording to write the computed ticks to.", metavar="FILE2.parquet")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,
) -> None:
    """Computes a recording again and compares the forces. Equal means equal to the last bit.

    Status 0: all ticks are identical. 1: some are not, some could not be computed, or there are none.
    """
    from punctura.record import replay

    with progress_bar("replay") as progress:
        result = replay(file, out, progress)
    for note in result.notes:
        notice(f"note: {note}")
    if as_json:
        typer.echo(json.dumps(asdict(result), indent=2))
    elif result.ticks == 0:
        typer.echo(f"{result.file}: nothing was compared")
    elif result.first_difference is None:
        rest = "" if result.complete else "; the others could not be computed"
        typer.echo(f"{result.file}: {result.ticks} ticks, identical{rest}")
    else:
        first = result.first_difference
        typer.echo(
            f"{result.file}: differs first at tick {first['tick']}: {first['column']} was {first['recorded']!r}, "
            f"is {first['computed']!r}"
        )
    if not (result.identical and result.complete):
        raise typer.Exit(FAILED)
