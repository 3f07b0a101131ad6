"""`punctura run --headless`: strokes, or a device in a hand, with a line in the terminal."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import typer

from punctura._core import Device, Placement, ServoLoop
from punctura.cli._status_line import StatusLine
from punctura.live import ANY_PROCESSOR, Limits, RunSummary, fit_conditioning, fit_direction, open_for, run_live
from punctura.record import Recorder, RecorderStatus
from punctura.scene import load_scene

FAULTED = 1


class Wishes(NamedTuple):
    """What every way to run takes from the command line."""

    scene: str
    device: str
    duration: float | None  # s
    placement: Placement | None
    scene_filter: bool
    processor: int = ANY_PROCESSOR
    limits: Limits = Limits()


def run_headless(wishes: Wishes, record: Path | None, as_json: bool) -> None:
    """Raises DeviceError; Ended where a signal has ended it."""
    loaded = load_scene(wishes.scene)
    opened = open_for(loaded, wishes.device, wishes.processor)
    fitted, note = fit_direction(loaded, opened)
    notes = [note]
    if not wishes.scene_filter:
        fitted, note = fit_conditioning(fitted, opened)
        notes.append(note)
    for note in filter(None, notes):
        typer.echo(f"punctura: note: {note}", err=True)
    line = StatusLine()

    def begin(loop: ServoLoop) -> Callable[[], None]:
        recorder = Recorder(loop, record) if record else None
        typer.echo(begun(loaded.name, loop, opened), err=True)

        def finish() -> None:
            line.end()
            if recorder:
                _tell(recorder.finish())

        return finish

    limits = wishes.limits
    summary = run_live(
        opened, fitted, wishes.duration, limits.gate_on(opened), limits.force, wishes.placement, line, begin
    )
    typer.echo(json.dumps(summary.to_dict(), indent=2) if as_json else in_words(summary))
    if summary.fault:
        typer.echo(f"punctura: {summary.fault}", err=True)
        raise typer.Exit(FAULTED)


def begun(scene: str, loop: ServoLoop, device: Device) -> str:
    """What runs on what, and how strong it may get."""
    return f"punctura: {scene} on {device.info.model}, at most {loop.limits.max_force:.3g} N; Ctrl-C ends it"


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
