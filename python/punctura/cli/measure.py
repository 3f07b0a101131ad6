"""`punctura measure`: the numbers of a trace that need no model."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from punctura.cli import _trace
from punctura.cli._out import check_apart, check_place
from punctura.cli._status import FAILED
from punctura.extras import optional

if TYPE_CHECKING:
    from punctura.trace.reading import Reading


@_trace.with_reading("punctura.trace")
def command(
    *,
    context: typer.Context,
    trace: Annotated[
        Path,
        typer.Argument(exists=True, help="A trace file (docs/identify.md), or a folder of them.", metavar="TRACE"),
    ],
    angle: Annotated[
        float,
        typer.Option("--angle-deg", help="Angle between the needle and the normal of the surface.", min=0, max=89),
    ] = 0.0,
    reading: Reading,
    out: Annotated[Path | None, typer.Option("--out", help="Table to write.", metavar="OUT.csv|.parquet")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the numbers as JSON, in SI units.")] = False,
) -> None:
    """Measures peak, gradient, pops and work of a trace. It needs no model."""
    optional("pyarrow", "files", "punctura measure")
    from punctura.files.names import traces_in
    from punctura.ticks.files import SUFFIXES, save
    from punctura.trace.bags import is_bag
    from punctura.trace.numbers_table import in_words, measured, table_of

    if out is not None and out.suffix.lower() not in SUFFIXES:
        raise typer.BadParameter(f"must end in {' or '.join(SUFFIXES)}", param_hint="--out")
    check_place(out, "--out")
    check_apart({"TRACE": trace, "--out": out})
    folder = trace.is_dir() and not is_bag(trace)
    found = measured(traces_in(trace) if folder else [trace], reading, math.radians(angle))
    if not folder and not found["rows"]:
        _trace.read_or_ask(trace, reading, context)  # asks for what the file does not state
    typer.echo(json.dumps(found, indent=2) if as_json else in_words(found))
    if out is not None:
        save(table_of(found["rows"]), out)
    if found["failed"]:
        raise typer.Exit(FAILED)
