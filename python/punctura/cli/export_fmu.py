"""`punctura export-fmu`: a scene for a simulator with the Functional Mock-up Interface."""

from pathlib import Path
from typing import Annotated

import typer

from punctura.cli._out import check_place
from punctura.fmu import export_fmu


def command(
    scene: Annotated[
        str, typer.Argument(help="A scene file, or the name of a ready scene (punctura scenes).", metavar="SCENE")
    ],
    out: Annotated[Path, typer.Option("-o", "--out", help="File to write.", metavar="FILE.fmu")],
    fmi: Annotated[int, typer.Option("--fmi", help="The version of FMI, 2 or 3.", min=2, max=3)] = 3,
) -> None:
    """Writes an FMU for co-simulation. Inputs: the needle's position and direction. Output: the force."""
    check_place(out, "--out")
    path = export_fmu(scene, out, version=fmi)
    typer.echo(f"{path}: FMI {fmi}.0, {path.stat().st_size // 1024} KiB")
