"""`punctura identify`: membranes from a measured trace of force against depth."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Annotated, Literal

import typer

from punctura import Needle
from punctura.files.whole_file import write_whole
from punctura.identify import Identification, identify
from punctura.identify.choose import extended_parameters
from punctura.identify.scene import left_out
from punctura.scene.write import scene_text
from punctura.trace import read_trace


def command(
    trace: Annotated[Path, typer.Argument(help="CSV, Parquet, MAT or XLSX file, or a recording of Punctura.")],
    needle: Annotated[
        str, typer.Option("--needle", help="The needle: diameter_mm=2,tip_angle_deg=45.", metavar="KEY=VALUE,...")
    ] = "",
    membranes: Annotated[str, typer.Option("--membranes", help="Number of membranes, or auto.", metavar="N")] = "auto",
    column: Annotated[
        list[str] | None,
        typer.Option("--column", help="A column by name or number: depth=z, force=2.", metavar="ROLE=NAME"),
    ] = None,
    unit: Annotated[
        list[str] | None, typer.Option("--unit", help="A unit: depth=mm, force=mN, time=ms.", metavar="ROLE=UNIT")
    ] = None,
    order: Annotated[
        str, typer.Option("--order", help="recorded, or depth for a digitised curve of one insertion.")
    ] = "recorded",
    scene: Annotated[
        Path | None, typer.Option("--scene", help="Scene file to write, for punctura run.", metavar="OUT.toml")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print everything as JSON.")] = False,
) -> None:
    """Identifies membranes from a trace: values, 95 % intervals, and what the trace cannot tell."""
    if order not in ("recorded", "depth"):
        raise typer.BadParameter("must be recorded or depth", param_hint="--order")
    read = read_trace(
        trace, pairs(column, "--column"), pairs(unit, "--unit"), order="depth" if order == "depth" else "recorded"
    )
    found = identify(
        read, needle_of(needle), number_of(membranes), lambda word: typer.echo(f"punctura: {word}", err=True)
    )
    if scene is not None:
        write_whole(scene, (left_out(extended_parameters(found.fit)) + scene_text(found.scene)).encode())
    typer.echo(json.dumps(found.as_dict(), indent=2) if as_json else in_words(found))


def pairs(given: list[str] | None, option: str) -> dict[str, str]:
    """{"depth": "mm"} of ["depth=mm"]."""
    found = {}
    for text in given or []:
        role, equals, value = text.partition("=")
        if not equals or not value:
            raise typer.BadParameter(f"{text!r} must be ROLE=VALUE, for example depth=mm", param_hint=option)
        found[role.strip()] = value.strip()
    return found


def number_of(membranes: str) -> int | Literal["auto"]:
    """The option --membranes as a number, or "auto"."""
    if membranes == "auto":
        return "auto"
    if not membranes.isdigit() or not 1 <= int(membranes) <= 12:
        raise typer.BadParameter(f"{membranes!r} must be auto or a number from 1 to 12", param_hint="--membranes")
    return int(membranes)


def needle_of(text: str) -> Needle:
    """The needle of `diameter_mm=2,tip_angle_deg=45`."""
    if not text:
        raise typer.BadParameter("state the needle: --needle diameter_mm=2,tip_angle_deg=45", param_hint="--needle")
    values = pairs(text.split(","), "--needle")
    unknown = set(values) - {"diameter_mm", "tip_angle_deg", "tip_angle_rad"}
    if unknown or "diameter_mm" not in values or not {"tip_angle_deg", "tip_angle_rad"} & set(values):
        raise typer.BadParameter("must be diameter_mm=...,tip_angle_deg=... (or tip_angle_rad)", param_hint="--needle")
    try:
        angle = (
            float(values["tip_angle_rad"])
            if "tip_angle_rad" in values
            else math.radians(float(values["tip_angle_deg"]))
        )
        return Needle(float(values["diameter_mm"]) * 1e-3, angle)
    except ValueError as error:
        raise typer.BadParameter(str(error), param_hint="--needle") from None


def in_words(found: Identification) -> str:
    """The result as lines for a reader."""
    lines = [
        f"{found.trace.source}: {len(found.trace)} samples, as many as {found.effective_samples:.0f} independent ones"
    ]
    lines += [f"  {finding}" for finding in found.trace.findings]
    lines.append(
        f"{len(found.parameters.membranes)} membrane(s), {', '.join(found.extensions) or 'K06 without extensions'}: "
        f"rms error {found.fit.rmse:.3g} N, {100 * found.fit.rmse / found.peak:.2g} % of the greatest force"
    )
    for e in found.estimates:
        low, high = ("?" if bound is None else f"{bound:.4g}" for bound in (e.low, e.high))
        mark = "" if e.identifiable else "  not identifiable"
        lines.append(f"  {e.name:28} {e.value:10.4g} {e.unit:6} [{low}, {high}]{mark}")
    return "\n".join([*lines, *found.verdicts])
