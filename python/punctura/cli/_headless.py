"""`punctura run --headless`: runs strokes or a real device, with a status line in the terminal."""

from __future__ import annotations

import errno
import importlib
import json
import os
import select
import sys
import time
from collections.abc import Callable, Collection, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import typer

from punctura._core import Device, FedDevice, Placement, Rival, ServoLoop
from punctura.cli._out import notice
from punctura.cli._status import FAILED
from punctura.cli._streams import give_up_stdout, never_wait_for_stderr
from punctura.extras import optional
from punctura.live import (
    ANY_PROCESSOR,
    MODEL_FORCE,
    Ended,
    RunLimits,
    RunSummary,
    SecondDevice,
    ThumbLoop,
    felt_force,
    fit_conditioning,
    fit_direction,
    open_for,
    run_live,
    run_notes,
)
from punctura.process.dropping_stream import DroppingStream
from punctura.scene import load_scene

if TYPE_CHECKING:
    from punctura.record import Recorder, RecorderStatus

USUAL_SCENE = "venipuncture"
READ_S = 1.0  # for the reader of standard output to take a piece, after a signal


class Wishes(NamedTuple):
    """Options of the command line for both ways to run."""

    scene: str  # empty: none was named
    device: str
    duration: float | None  # s
    placement: Placement | None
    scene_filter: bool
    processor: int = ANY_PROCESSOR
    limits: RunLimits = RunLimits()
    second: SecondDevice | None = None
    rivals: Sequence[Rival] = ()  # in place of the scene's law


def run_headless(wishes: Wishes, record: Path | None, as_json: bool) -> None:
    """Raises DeviceError, and Ended if a signal ended the run."""
    tape = Tape(record, StatusLine(never_wait_for_stderr()))
    loaded = load_scene(wishes.scene or USUAL_SCENE)
    opened = open_for(loaded, wishes.device, wishes.processor)
    thumb: ThumbLoop | None = None
    if wishes.second:
        thumb = wishes.second.loop(wishes.second.open(loaded, opened, wishes.processor), wishes.limits)
    fitted, note = fit_direction(loaded, opened)
    notes, tape.thumb = [note], thumb
    if not wishes.scene_filter:
        fitted, note = fit_conditioning(fitted, opened)
        notes.append(note)
    for note in filter(None, notes):
        notice(f"note: {note}")

    limits = wishes.limits
    shown: list[str] = []

    def begin(loop: ServoLoop) -> Callable[[], None]:
        notice(begun(loaded.name, loop, opened, thumb))
        shown.extend([*limits.notes(loop, thumb), *run_notes(loop)])
        for note in shown:
            notice(f"note: {note}")
        return tape.begin(loop)

    def report(summary: RunSummary, print_result: Callable[[str], None]) -> None:
        record = asdict(summary) | ({"recording": asdict(tape.status)} if tape.status else {})
        print_result(json.dumps(record, indent=2, default=os.fspath) if as_json else in_words(summary, shown))
        if not summary.force_was_on and summary.ticks > 0:
            button = "the dead-man button was never held, or " if wishes.limits.gate.get("dead_man") else ""
            notice(f"note: there was no force at any time: {button}the tip was never in front of all membranes")
        tape.report_fault(summary.fault)

    try:
        summary = run_live(
            opened, fitted, wishes.duration, limits.gate_on(opened), limits.force, wishes.placement, tape.watch, begin,
            thumb, wishes.rivals,
        )  # fmt: skip
    except Ended as end:
        if end.summary is not None and end.summary.ticks > 0:
            report(end.summary, print_if_read)
        raise
    if summary.ticks == 0 and isinstance(opened, FedDevice) and not summary.fault:
        summary.fault = "the device gave no reading: the program that feeds it has failed, or has not begun"
    report(summary, print_result)
    if summary.fault or not tape.whole:
        raise typer.Exit(FAILED)


class Tape:
    """The optional recording of one run, and the status line of both."""

    def __init__(self, path: Path | None, line: StatusLine) -> None:
        self.status: RecorderStatus | None = None  # how it ended
        self._path, self._line = path, line
        if path:  # before the run, which would wait for the import
            optional("pyarrow", "files", "--record")
            importlib.import_module("punctura.record")
        self._fault = ""  # that was reported
        self._recorder: Recorder | None = None
        self.thumb: ThumbLoop | None = None  # the second device's loop

    def begin(self, loop: ServoLoop) -> Callable[[], None]:
        """Raises RecordingError. Returns a function that finishes the file and prints its path."""
        if self._path:
            from punctura.record import Recorder

            self._recorder = Recorder(loop, self._path, thumb=self.thumb)
        return self._finish

    def watch(self, summary: RunSummary) -> None:
        status = self._recorder.status() if self._recorder else None
        self._line(summary, "" if status is None else status.words)
        self.report_fault(summary.fault)

    def report_fault(self, fault: str) -> None:
        """Prints the fault at once, and later additions: a driver call that never returns would delay the end."""
        if fault and fault != self._fault:
            news, self._fault = fault.removeprefix(f"{self._fault}: "), fault
            self._line.end()
            notice(news)

    @property
    def whole(self) -> bool:
        return self.status is None or (self.status.finished and self.status.lost == 0)

    def _finish(self) -> None:
        if self._recorder:
            self._line.show(f"punctura: finishing the recording {self._path}; please wait")
            self.status = self._recorder.finish()
        self._line.end()
        if self.status is None:
            return
        name = self.status.file or f"the file that was {self._path}"
        notice(f"{name}: {self.status.rows} ticks recorded, {self.status.lost} lost")
        for text in [*self.status.notes, *([self.status.trouble] if self.status.trouble else [])]:
            notice(f"recording: {text}")


def print_if_read(text: str) -> None:
    """Prints after a signal: no reader and no error of the stream delays the end or changes its status."""
    try:
        where = sys.stdout.fileno()
        data = f"{text}\n".encode(sys.stdout.encoding or "utf-8", "replace")
        piece = getattr(select, "PIPE_BUF", 512)  # a pipe that can be written takes so much without waiting
        for at in range(0, len(data), piece):
            if os.name == "posix" and not select.select([], [where], [], READ_S)[1]:
                return
            os.write(where, data[at : at + piece])
    except (OSError, ValueError):
        return


def print_result(text: str) -> None:
    """Prints after the run, and waits for the reader. Raises OSError, except for a closed terminal."""
    try:
        typer.echo(text)
    except OSError as error:
        if error.errno != errno.EIO:
            raise
        give_up_stdout()


def begun(scene: str, loop: ServoLoop, device: Device, thumb: ThumbLoop | None = None) -> str:
    """The scene, the devices and the limits of the force."""
    most = loop.limits
    strong = f"at most {most.max_force:.3g} N, {most.continuous_force:.3g} N rms in any {most.continuous_time:.3g} s"
    scale = "" if loop.force_scale == 1 else f", {felt_force(loop.force_scale)}"
    second = ""
    if thumb is not None:
        second = f"; thumb on {thumb.device.info.model}, at most {thumb.limits.max_force:.3g} N"
    return f"{scene} on {device.info.model}, {strong}{scale}{second}; Ctrl-C ends it"


def in_words(summary: RunSummary, shown: Collection[str] = ()) -> str:
    """The summary for a person, without the statements that have been shown already."""
    lines = [
        f"{summary.scene} on {summary.device}",
        f"  {summary.ticks} ticks at {summary.rate_hz:g} Hz, {summary.late} late, {summary.lost} lost; "
        f"99.9 % were computed within {summary.compute_p99_9_s * 1e6:.3g} us",
        f"  strongest {felt_force(summary.force_scale)} {summary.felt_peak_N:.3g} N, "
        f"strongest {MODEL_FORCE} {summary.peak_N:.3g} N, "
        + (f"cut by {summary.limits_in_words}" if summary.limited_ticks else "never cut by a limit"),
    ]
    if summary.too_few_ticks:
        lines.insert(2, f"  {summary.too_few_ticks}")
    if summary.second_device:
        lines.append(
            f"  thumb on {summary.second_device}: strongest felt force {summary.thumb_peak_N:.3g} N, "
            f"{summary.injected_m3 * 1e6:.2f} mL injected at most"
        )
    for name, depth in zip(summary.membranes, summary.deepest_m, strict=True):
        lines.append(f"  {name}: {depth * 1e3:.3g} mm deep" if depth > 0 else f"  {name}: not reached")
    return "\n".join(lines + [f"  {text}" for text in summary.statements if text not in shown])


EVERY_S = 0.1


class StatusLine:
    """Prints nothing without a terminal, or while the terminal takes no text."""

    def __init__(self, stream: DroppingStream) -> None:
        self._stream = stream
        self._next = 0.0
        self._width = 0

    def __call__(self, summary: RunSummary, trouble: str = "") -> None:
        """trouble: of the recording, in words."""
        now = time.monotonic()
        if now >= self._next:
            self._next = now + EVERY_S
            self.show(status_text(summary) + (f"  RECORDING: {trouble}" if trouble else ""))

    def show(self, text: str) -> None:
        if self._stream.isatty() and self._stream.offer("\r" + text.ljust(self._width)):
            self._width = len(text)

    def end(self) -> None:
        if self._width:
            self._stream.write("\r" + " " * self._width + "\r")
            self._stream.flush()
            self._width = 0


def status_text(summary: RunSummary) -> str:
    """Time, rate, state, force, and of each membrane depth and phase."""
    x, y, z = summary.force_N
    wanted = summary.force_scale * summary.model_force_N
    cut = f" (of {wanted:.2f} N: {summary.limit})" if summary.limit else ""
    membranes = "  ".join(
        f"{name} {depth * 1e3:.1f} mm {phase.replace('_', ' ')}"
        for name, depth, phase in zip(summary.membranes, summary.depth_m, summary.phases, strict=False)
    )
    thumb = f"  thumb {summary.thumb_N:+.2f} N" if summary.second_device else ""
    return (
        f"{summary.time_s:6.1f} s  {summary.rate_hz:g} Hz  {summary.state}  "
        f"{felt_force(summary.force_scale)} {x:+.2f} {y:+.2f} {z:+.2f} N{cut}{thumb}  {membranes}  lost {summary.lost}"
    )
