"""`punctura simulate`: the model's force for a recorded motion."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from punctura.cli._options import rivals_of
from punctura.cli._out import notice
from punctura.progress import progress_bar
from punctura.simulation import SimulationSummary, simulate


def command(
    scene: Annotated[
        str, typer.Argument(help="A scene file, or the name of a ready scene (punctura scenes).", metavar="SCENE")
    ],
    motion: Annotated[
        Path,
        typer.Option(
            "--motion", help="CSV, Parquet or NumPy file: time_s,x_m,y_m,z_m[,axis_x,axis_y,axis_z].", metavar="FILE"
        ),
    ],
    out: Annotated[Path, typer.Option("--out", help="Result file to write.", metavar="OUT.csv|.parquet")],
    rival: Annotated[
        list[str] | None,
        typer.Option("--rival", help="A rival's name or a file of punctura rivals --out.", metavar="NAME|FILE"),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the summary as JSON.")] = False,
) -> None:
    """Computes the model's force for a motion file. There are no safety limits.

    With --rival, a force model of another author takes the place of the scene's law, at the places of its membranes.
    """
    with progress_bar("simulate") as progress:
        summary = simulate(scene, motion, out, progress, rivals=rivals_of(rival) or None)
    for note in summary.notes:
        notice(f"note: {note}")
    typer.echo(json.dumps(asdict(summary), indent=2) if as_json else _in_words(summary))


def _in_words(summary: SimulationSummary) -> str:
    lines = [
        f"{summary.out}: {summary.ticks} ticks at {summary.rate_hz:g} Hz, "
        f"{summary.start_s:.6g} s to {summary.end_s:.6g} s, strongest force {summary.peak_N:.4g} N"
    ]
    for membrane in summary.membranes:
        lines.append(f"  {membrane.name}: {membrane.deepest_m * 1e3:.4g} mm deep, {membrane.peak_N:.4g} N")
    return "\n".join(lines)
