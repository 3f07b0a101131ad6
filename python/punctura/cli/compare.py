"""`punctura compare`: force models of other authors fitted to a measured trace, beside each other."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from punctura.progress import progress_bar


def command(
    trace: Annotated[Path, typer.Argument(help="CSV, Parquet, MAT, XLSX, or a recording.", metavar="TRACE")],
    models: Annotated[
        str | None, typer.Option("--models", help="Names, with commas between. Default: all.", metavar="NAMES")
    ] = None,
    column: Annotated[
        list[str] | None,
        typer.Option("--column", help="Column by name or number, depth=NAME.", metavar="ROLE=COLUMN"),
    ] = None,
    unit: Annotated[
        list[str] | None, typer.Option("--unit", help="Unit of a column, such as depth=mm.", metavar="ROLE=UNIT")
    ] = None,
    by_depth: Annotated[
        bool, typer.Option("--by-depth", help="Sort the samples by depth: a digitised curve of one insertion.")
    ] = False,
    plot: Annotated[Path | None, typer.Option("--plot", help="Write a .png, .svg or .pdf.", metavar="FILE")] = None,
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder for the fitted models, to feel them.", metavar="FOLDER")
    ] = None,
    chatter: Annotated[bool, typer.Option(help="Measure how much each model shakes at rest.")] = True,
    as_json: Annotated[bool, typer.Option("--json", help="Print the numbers as JSON.")] = False,
) -> None:
    """Fits force models to a measured trace and compares them.

    Columns of the trace are found by name, such as depth_mm, force_N and time_s. The studio's Lab and punctura.compare
    compare recordings with each other.
    """
    from punctura.rivals import compare_trace, save_layers
    from punctura.rivals.figure import SUFFIXES, save_figure
    from punctura.rivals.words import as_json as numbers
    from punctura.rivals.words import notes, table
    from punctura.trace import read_trace

    if plot is not None and plot.suffix.lower() not in SUFFIXES:
        raise typer.BadParameter(f"must end in {', '.join(SUFFIXES)}", param_hint="--plot")
    if out is not None and out.exists() and not out.is_dir():
        raise typer.BadParameter(f"{out} is not a folder", param_hint="--out")
    columns = {role: int(name) if name.isdigit() else name for role, name in _pairs(column, "--column").items()}
    read = read_trace(trace, columns or None, _pairs(unit, "--unit") or None, order="depth" if by_depth else "recorded")
    for finding in read.findings:
        typer.echo(f"punctura: note: {finding}", err=True)
    names = None if models is None else [name.strip() for name in models.split(",")]
    with progress_bar("compare") as tell:
        found = compare_trace(read, names, with_chatter=chatter, progress=tell)
    if plot is not None:
        save_figure(found, plot)
    if out is not None:
        out.mkdir(parents=True, exist_ok=True)
        for row in found.rows:
            if row.layers:
                save_layers(out / f"{row.name}.json", row.layers)
    if as_json:
        typer.echo(json.dumps(numbers(found), indent=2))
        return
    typer.echo(table(found))
    for note in notes(found):
        typer.echo(note)


def _pairs(given: list[str] | None, option: str) -> dict[str, str]:
    """{"depth": "mm"} from ["depth=mm"]."""
    found = {}
    for text in given or []:
        role, equals, value = text.partition("=")
        if not (equals and role and value):
            raise typer.BadParameter(f"must be ROLE=VALUE, such as depth=mm, not {text}", param_hint=option)
        found[role] = value
    return found
