"""`punctura export`: a recording for other programs."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from punctura.cli._out import notice
from punctura.progress import progress_bar


def command(
    file: Annotated[Path, typer.Argument(help="A recording, finished or not.", metavar="FILE")],
    out: Annotated[Path, typer.Option("--out", help="File to write.", metavar="OUT.csv|.parquet|.mcap")],
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,
) -> None:
    """Converts a recording to CSV, Parquet or MCAP. Also reads the file of a run that was killed."""
    from punctura.record import export

    with progress_bar("export") as progress:
        result = export(file, out, progress)
    for note in result.notes:
        notice(f"note: {note}")
    lost = f", {result.lost} lost" if result.lost else ""
    typer.echo(json.dumps(asdict(result), indent=2) if as_json else f"{result.out}: {result.ticks} ticks{lost}")
