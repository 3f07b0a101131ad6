"""`punctura run`: a scene on a device, now."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from punctura._core import DeviceError, Placement, ServoLoop
from punctura.cli._status_line import StatusLine
from punctura.live import Ended, RunSummary, fit_conditioning, fit_direction, load_placement, open_for, run_live
from punctura.record import Recorder, RecorderStatus
from punctura.scene import load_scene

FAULTED = 1


def command(
    scene: Annotated[
        str, typer.Argument(help="A scene file, or the name of a ready scene (punctura scenes).")
    ] = "k06-fig10",
    headless: Annotated[bool, typer.Option("--headless", help="In this terminal, without a page.")] = False,
    device: Annotated[
        str, typer.Option("--device", help="As punctura devices names it; without it the best there is.")
    ] = "",
    duration: Annotated[
        float | None, typer.Option("--duration", help="How long, s; without it until Ctrl-C.", min=0.0)
    ] = None,
    placement: Annotated[
        Path | None,
        typer.Option("--placement", help="Where the device stands: punctura place.", metavar="FILE.toml"),
    ] = None,
    scene_filter: Annotated[
        bool, typer.Option("--scene-filter", help="Filter positions as the scene says, not as the device needs.")
    ] = False,
    record: Annotated[
        Path | None, typer.Option("--record", help="Every tick goes into this file.", metavar="FILE.parquet")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the summary as JSON.")] = False,
) -> None:
    """A scene on a device at its full rate, with every safety limit on.

    The simulated device makes strokes through the scene.
    """
    if not headless:
        raise typer.BadParameter("there is no page yet; add --headless", param_hint="punctura run")
    loaded = load_scene(scene)
    stands = load_placement(placement) if placement else Placement()
    try:
        opened = open_for(loaded, device)
    except DeviceError as error:
        raise typer.BadParameter(str(error), param_hint="--device") from None
    fitted, note = fit_direction(loaded, opened)
    notes = [note]
    if not scene_filter:
        fitted, note = fit_conditioning(fitted, opened)
        notes.append(note)
    for note in filter(None, notes):
        typer.echo(f"punctura: note: {note}", err=True)
    line = StatusLine()

    def begin(loop: ServoLoop) -> Callable[[], None]:
        recorder = Recorder(loop, record) if record else None
        typer.echo(f"punctura: {loaded.name} on {opened.info.model}; Ctrl-C ends it", err=True)

        def finish() -> None:
            line.end()
            if recorder:
                _tell(recorder.finish())

        return finish

    try:
        summary = run_live(opened, fitted, duration, placement=stands, watch=line, prepare=begin)
    except Ended as end:
        if end.name == "SIGINT":
            raise KeyboardInterrupt from None  # the command line says "interrupted"
        typer.echo(f"punctura: ended by {end.name}; the force is off", err=True)
        sys.exit(128 + end.number)
    typer.echo(json.dumps(summary.to_dict(), indent=2) if as_json else in_words(summary))
    if summary.fault:
        typer.echo(f"punctura: {summary.fault}", err=True)
        raise typer.Exit(FAULTED)


def _tell(status: RecorderStatus) -> None:
    typer.echo(f"punctura: {status.file}: {status.rows} ticks recorded, {status.lost} lost", err=True)
    for text in [*status.notes, *([status.trouble] if status.trouble else [])]:
        typer.echo(f"punctura: recording: {text}", err=True)


def in_words(summary: RunSummary) -> str:
    """The summary for a person."""
    lines = [
        f"{summary.scene} on {summary.device}",
        f"  {summary.ticks} ticks at {summary.rate_Hz:g} Hz, {summary.late} late, {summary.gaps} lost; "
        f"99.9 % were computed within {summary.compute_p99_9_s * 1e6:.3g} us",
        f"  strongest force {summary.strongest_N:.3g} N, limited in {summary.limited_ticks} ticks",
    ]
    for name, depth in zip(summary.membranes, summary.deepest_m, strict=True):
        lines.append(f"  {name}: {depth * 1e3:.3g} mm deep")
    return "\n".join(lines + [f"  {text}" for text in summary.statements])
