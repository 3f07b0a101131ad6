"""`punctura study`: many trials of a scene whose numbers follow a plan file."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from punctura.cli._out import notice
from punctura.process.signals import Ended
from punctura.progress import progress_bar


def command(
    plan: Annotated[Path, typer.Argument(help="The plan of the study, TOML (docs/study.md).", metavar="PLAN")],
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder for the results. Default: PLAN with .study for .toml.", metavar="FOLDER"),
    ] = None,
    workers: Annotated[
        int | None, typer.Option("--workers", min=1, help="Number of threads. Default: one for each processor.")
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option("--scheduler", help="Compute on the workers of this Dask scheduler.", metavar="ADDRESS"),
    ] = None,
    replay: Annotated[
        int | None,
        typer.Option("--replay", min=0, help="Run this row again: its scene and recording go to --out.", metavar="ROW"),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the summary as JSON.")] = False,
) -> None:
    """Runs a parameter study. Its plan is a grid, a Latin hypercube, Sobol points or Monte Carlo.

    Writes one row for each trial and a report. After an interruption, the same command goes on with the missing trials.
    """
    from punctura.study import load_plan, replay_row, run_study
    from punctura.study.report import in_trials
    from punctura.study.run import Forecast

    def on_forecast(forecast: Forecast) -> None:
        if forecast.is_worth_showing:
            notice(str(forecast))

    loaded = load_plan(plan)
    folder = out or plan.with_suffix(".study")
    if replay is not None:
        scene, recording = replay_row(loaded, replay, folder)
        files = {"scene": str(scene), "recording": str(recording)}
        typer.echo(
            json.dumps(files, indent=2)
            if as_json
            else f"{scene}\n{recording}: punctura run --recordings {folder} lists it in the studio"
        )
        return
    try:
        with progress_bar("study") as progress:
            summary = run_study(loaded, folder, workers, progress, scheduler, on_forecast)
    except (KeyboardInterrupt, Ended):
        notice(f"{folder} keeps the finished chunks: the same command goes on with the others")
        raise
    if as_json:
        typer.echo(json.dumps(asdict(summary), indent=2))
        return
    typer.echo(f"{summary.table}: {in_trials(summary.trials)}, of them {summary.kept} from before")
    if summary.faults:
        typer.echo(f"  a fault ended {in_trials(summary.faults)}: column fault")
    typer.echo(summary.report)
