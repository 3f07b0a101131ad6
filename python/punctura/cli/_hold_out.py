"""`punctura identify --hold-out`: how well K06 and its rivals predict what they did not see."""

import json
from pathlib import Path
from typing import Literal

import typer

from punctura import Needle
from punctura.cli._out import notice
from punctura.cli._status import FAILED
from punctura.defects import PATIENCE_S, explain
from punctura.files.names import as_text, traces_in
from punctura.identify.folder import Task
from punctura.identify.rig import Rig, check
from punctura.rivals.hold_out import another_trace, fitted, in_words, means, records, second_insertion
from punctura.trace import Trace
from punctura.trace.read import read_as


def predict_insertion(trace: Trace, needle: Needle, membranes: int | Literal["auto"], rig: Rig, as_json: bool) -> None:
    """Predicts the second insertion from the first one."""
    found = records(second_insertion(trace, needle, membranes, notice, rig))
    what = f"{trace.source}: fitted to the first insertion; error of the second one"
    typer.echo(json.dumps({"hold_out": found}, indent=2) if as_json else in_words(what, found))


def predict_folder(folder: Path, task: Task, as_json: bool) -> None:
    """Predicts each trace of a folder from all others."""
    check(task.rig, task.needle)
    all_of_them, failed = {}, {}
    for path in traces_in(folder):
        name = as_text(path.name)
        notice(name)
        try:
            one = fitted(read_as(path, task.reading), task.needle, task.membranes, lambda _: None, task.rig)
            _ = one.contact
            all_of_them[name] = one
        except Exception as error:
            failed[name] = explain(error, PATIENCE_S)
    found = another_trace(all_of_them)
    if as_json:
        typer.echo(json.dumps({"hold_out": records(found), "mean": means(found), "failed": failed}, indent=2))
    else:
        for name in all_of_them:
            typer.echo(in_words(f"{name}, predicted from the others:", records([p for p in found if p.trace == name])))
        typer.echo(in_words(f"Mean over {len(all_of_them)} traces:", means(found)))
        for name, reason in failed.items():
            typer.echo(f"{name}: {reason}")
    if failed:
        raise typer.Exit(FAILED)
