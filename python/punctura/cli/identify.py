"""`punctura identify`: membranes from a measured trace of force against depth."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from punctura.cli import _rig, _trace
from punctura.cli._out import check_apart, check_folder, check_place, notice
from punctura.cli._status import FAILED
from punctura.files.whole_file import write_whole
from punctura.progress import progress_bar

if TYPE_CHECKING:
    from punctura.identify import Identification
    from punctura.identify.folder import Task
    from punctura.identify.records import FolderRecord
    from punctura.trace.reading import Reading


@_trace.with_reading("punctura.identify")
def command(
    *,
    context: typer.Context,
    trace: Annotated[
        Path,
        typer.Argument(
            exists=True,
            help="A file as machines write them (docs/identify.md), a recording of Punctura, or a folder of them.",
            metavar="TRACE",
        ),
    ],
    needle: Annotated[
        str,
        typer.Option(
            "--needle",
            help="The needle: diameter_mm=2,tip_angle_deg=45, or diameter_mm=1.27+-0.03. A recording has its own.",
            metavar="NAME=VALUE,...",
        ),
    ] = "",
    membranes: Annotated[str, typer.Option("--membranes", help="Number of membranes, or auto.", metavar="N")] = "auto",
    reading: Reading,
    rig: _rig.Option = None,
    scene: Annotated[
        Path | None, typer.Option("--scene", help="Scene file to write, for punctura run.", metavar="OUT.toml")
    ] = None,
    report: Annotated[
        Path | None, typer.Option("--report", help="One-page report to write.", metavar="OUT.html")
    ] = None,
    plan: Annotated[
        Path | None,
        typer.Option("--plan", help="Motion of the next experiment to write, for a robot.", metavar="OUT.csv"),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder for the results of a folder, or of all sheets of a file.", metavar="FOLDER"),
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option("--workers", min=1, help="For a folder: number of processes. Default: one for each processor."),
    ] = None,
    hold_out: Annotated[
        bool,
        typer.Option(
            "--hold-out",
            help="Predict instead, beside the rivals: the second insertion from the first, or each trace of a folder "
            "from the others.",
        ),
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print everything as JSON.")] = False,
) -> None:
    """Identifies membranes from a measured trace. Gives values, 95 % intervals, and what the trace cannot tell."""
    from punctura.identify import identify
    from punctura.identify.folder import Task, write_specimens
    from punctura.identify.report import report_html
    from punctura.scene.build import scene_text
    from punctura.trace.bags import is_bag

    count = number_of(membranes)
    known_rig, needle = _rig.rig_of(rig, needle)
    folder = trace.is_dir() and not is_bag(trace)
    if hold_out:
        from punctura.cli._hold_out import predict_folder, predict_insertion

        if scene or report or plan or out:
            raise typer.BadParameter(
                "predicts only: leave out --scene, --report, --plan and --out", param_hint="--hold-out"
            )
        if folder:
            predict_folder(trace, Task(_trace.needle_of(needle), count, reading, known_rig), as_json)
        else:
            predict_insertion(*_trace.read_with_needle(trace, reading, needle, context), count, known_rig, as_json)
        return
    if folder or out is not None:
        if scene or report or plan:
            raise typer.BadParameter("--scene, --report and --plan need a single trace, without --out")
        if out is None:
            raise typer.BadParameter("a folder of traces needs --out FOLDER for the results", param_hint="--out")
        check_folder(out, "--out")
        task = Task(_trace.needle_of(needle, trace), count, reading, known_rig)
        if not folder:
            write_specimens(trace, reading, out / "specimens")
            trace, task = out / "specimens", replace(task, reading=replace(reading, sheet=None))
        _folder(trace, out, task, workers, as_json)
        return
    written = {"--scene": scene, "--report": report, "--plan": plan}
    for option, path in written.items():
        check_place(path, option)
    check_apart({"TRACE": trace, **written})
    read, known = _trace.read_with_needle(trace, reading, needle, context)
    found = identify(read, known, count, notice, known_rig)
    typer.echo(json.dumps(found.as_dict(), indent=2) if as_json else in_words(found))  # first: a disk may be full
    if not as_json and not found.doubts.explained.whole:
        from punctura.rivals.comparison import better_in_words

        notice("the rivals")
        typer.echo(better_in_words(found))
    if scene is not None:
        write_whole(scene, scene_text(found.scene).encode())
    if report is not None:
        write_whole(report, report_html(found))
    if plan is not None:
        _plan(plan, found)


def _folder(folder: Path, out: Path, task: Task, workers: int | None, as_json: bool) -> None:
    from punctura.identify.folder import identify_folder

    with progress_bar("identify") as progress:
        done = identify_folder(folder, out, task, workers, progress)
    if as_json:
        typer.echo(json.dumps(done, indent=2))
    else:
        _print_folder(out, done)
    if done["failed"]:
        raise typer.Exit(FAILED)


def _print_folder(out: Path, done: FolderRecord) -> None:
    typer.echo(f"{out}: {done['identified']} of {done['traces']} traces identified, {done['kept']} kept from before")
    for name, reason in done["failed"].items():
        typer.echo(f"  {name}: {reason}")
    for row in done["population"]:
        spread = f"{100 * row['spread']:.3g} %" if row["spread_is_relative"] else f"{row['spread']:.3g} {row['unit']}"
        typer.echo(f"  {row['name']:28} {row['mean']:10.4g} {row['unit']:6} [{row['low']:.4g}, {row['high']:.4g}], "
                   f"spread {spread}")  # fmt: skip


def _plan(path: Path, found: Identification) -> None:
    from punctura.identify.plan import plans

    deepest = float(found.trace.depth.max())
    best = plans(found.parameters, found.fit.free.names, deepest, found.fit.rmse)[0]
    write_whole(path, best.csv())
    notice(f"{path}: {best.name}; {best.time[-1]:.0f} s")


def number_of(membranes: str) -> int | Literal["auto"]:
    """The option --membranes as a number, or "auto"."""
    if membranes == "auto":
        return "auto"
    if not membranes.isdigit() or not 1 <= int(membranes) <= 12:
        raise typer.BadParameter(f"{membranes!r} must be auto or a number from 1 to 12", param_hint="--membranes")
    return int(membranes)


def in_words(found: Identification) -> str:
    """The result as lines for a reader."""
    from punctura.identify.doubts import NOT_EXPLAINED

    lines = [
        f"{found.trace.source}: {len(found.trace)} samples, as many as {found.effective_samples:.0f} independent ones"
    ]
    lines += [f"  {finding}" for finding in found.trace.findings]
    lines.append(
        f"{len(found.parameters.membranes)} membrane(s), {', '.join(found.extensions) or 'K06 without extensions'}: "
        f"rms error {found.fit.rmse:.3g} N, {100 * found.fit.rmse / found.peak:.2g} % of the greatest force"
        f"{'' if found.doubts.whole else f'; {NOT_EXPLAINED}'}"
    )
    for e in found.estimates:
        low, high = ("?" if bound is None else f"{bound:.4g}" for bound in (e.low, e.high))
        mark = "" if e.identifiable else "  not identifiable"
        lines.append(f"  {e.name:28} {e.value:10.4g} {e.unit:6} [{low}, {high}]{mark}")
    lines += [f"  of the rig: {value}" for value in found.rig]
    return "\n".join([*lines, *found.verdicts])
