"""`punctura rivals`: force models of other authors fitted to a measured trace, beside each other."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from punctura import save_scene
from punctura.cli import _trace
from punctura.cli._out import check_apart, check_folder, check_place, notice
from punctura.extras import optional
from punctura.progress import progress_bar

if TYPE_CHECKING:
    from punctura.trace.reading import Reading


@_trace.with_reading("punctura.rivals")
def command(
    *,
    context: typer.Context,
    trace: Annotated[
        Path, typer.Argument(exists=True, help="A trace file (docs/identify.md), or a recording.", metavar="TRACE")
    ],
    models: Annotated[
        str | None,
        typer.Option(
            "--models", help="Names of models (docs/rivals.md), with commas between. Default: all.", metavar="NAMES"
        ),
    ] = None,
    reading: Reading,
    needle: Annotated[
        str | None,
        typer.Option(
            "--needle",
            help="For K06: diameter_mm=1.27,tip_angle_deg=20. A recording has its own.",
            metavar="NAME=VALUE,...",
        ),
    ] = None,
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
    from punctura.rivals.words import as_json as numbers
    from punctura.rivals.words import notes, table
    from punctura.trace.read import recorded_needle

    if plot is not None:
        optional("matplotlib", "plots", "--plot")
        from punctura.rivals.figure import SUFFIXES, save_figure

        if plot.suffix.lower() not in SUFFIXES:
            raise typer.BadParameter(f"must end in {' or '.join(SUFFIXES)}", param_hint="--plot")
    check_place(plot, "--plot")
    check_apart({"TRACE": trace, "--plot": plot})
    check_folder(out, "--out")
    read = _trace.read_or_ask(trace, reading, context)
    for finding in read.findings:
        notice(f"note: {finding}")
    names = None if models is None else [name.strip() for name in models.split(",")]
    with progress_bar("rivals") as progress:
        found = compare_trace(
            read, names, needle=_trace.needle_of(needle) if needle else recorded_needle(trace), with_chatter=chatter,
            progress=progress,
        )  # fmt: skip
    if plot is not None:
        save_figure(found, plot)
    if out is not None:
        out.mkdir(parents=True, exist_ok=True)
        for row in found.rows:
            if row.layers:
                save_layers(out / f"{row.name}.json", row.layers)
            elif row.scene is not None:
                save_scene(row.scene, out / f"{row.name}.toml")
    if as_json:
        typer.echo(json.dumps(numbers(found), indent=2))
        return
    typer.echo(table(found))
    for note in notes(found):
        typer.echo(note)
