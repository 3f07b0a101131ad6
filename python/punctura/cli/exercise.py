"""`punctura exercise`: lists exercises, and scores a recorded attempt."""

import json
from pathlib import Path
from typing import Annotated, Literal

import typer

from punctura.cli._out import check_place, notice
from punctura.cli._status import FAILED

command = typer.Typer(no_args_is_help=True, help="Lists exercises; scores a recording; exports results.")


@command.command("list")
def list_exercises(as_json: Annotated[bool, typer.Option("--json", help="Print the list as JSON.")] = False) -> None:
    """Lists the ready exercises by name."""
    from punctura.exercise import exercises

    all_of_them = exercises()
    if as_json:
        entries = [{"name": e.name, "title": e.title, "scene": e.scene_name, "file": str(e.path)} for e in all_of_them]
        typer.echo(json.dumps(entries, indent=2))
        return
    width = max(len(exercise.name) for exercise in all_of_them)
    for exercise in all_of_them:
        typer.echo(f"{exercise.name:{width}}  {exercise.title}: {exercise.instruction}")


@command.command()
def score(
    recording: Annotated[Path, typer.Argument(help="A recording, finished or not.", metavar="RECORDING")],
    exercise: Annotated[str, typer.Option(help="Name of a ready exercise, or an exercise file.", metavar="NAME|FILE")],
    person: Annotated[str, typer.Option(help="Name of the person, for --json.")] = "",
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,
) -> None:
    """Scores a recorded attempt as the studio would have.

    The exit status is 0 for passed and not passed; the first line says which.
    """
    from punctura.exercise import Result, load_exercise
    from punctura.exercise import score as judge
    from punctura.exercise.quantities import tenths
    from punctura.exercise.words import state
    from punctura.live import felt_force

    wanted = load_exercise(exercise)
    for warning in wanted.warnings:
        notice(f"warning: {wanted.path}: {warning}")
    result: Result = judge(recording, wanted, person)
    if as_json:
        typer.echo(result.model_dump_json(indent=2))
        return
    typer.echo(f"{result.title}: {result.verdict}")
    for reason in result.reasons:
        typer.echo(f"  {reason}")
    for heading, remarks in (("Next time", result.coaching.change), ("What went well", result.coaching.good)):
        for remark in remarks[:1]:
            typer.echo(f"  {heading}: {remark.text}")
    width = max(len(state(goal)) for goal in result.goals)
    for goal in result.goals:
        typer.echo(f"  {state(goal):{width}}  {goal.text}")
    m = result.metrics
    typer.echo(f"  {m.entries} {'entry' if m.entries == 1 else 'entries'}, model force {m.peak_force:.2f} N at most")
    if m.peak_felt_force is not None:
        typer.echo(f"  {felt_force(m.force_scale)} {m.peak_felt_force:.2f} N at most")
    for loss in m.losses:
        needed = "" if loss.needed is None else f" ({loss.needed:.2g} N needed)"
        drop = f"{loss.drop:.2f} N" if loss.drop > 0 else "no"
        typer.echo(f"  {drop} loss of resistance felt at the pop of the {loss.name}{needed}")
    typer.echo(f"  {tenths(m.total_time)} s from the first contact to the decision")
    typer.echo(f"  {tenths(m.dwell)} s in the space, at most {tenths(m.longest_stay)} s without a break")
    for one in m.overshoot:
        typer.echo(f"  {one.distance * 1e3:.1f} mm past the {one.name} within {one.seconds:g} s of its pop")
    for gave in m.yields:
        typer.echo(
            f"  plunger gave way under {gave.push:.2f} N; "
            f"{gave.injected * 1e6:.1f} mL injected within {gave.seconds:g} s"
        )
        if gave.loss is not None:
            needed = "" if gave.loss.needed is None else f" ({gave.loss.needed:.2g} N needed)"
            typer.echo(f"  {gave.loss.drop:.2f} N loss of resistance felt at the plunger{needed}")
    if m.straightness is not None and m.lateral_deviation is not None:
        aside = m.lateral_deviation * 1e3
        typer.echo(f"  path {m.straightness:.2f} times the straight one, at most {aside:.1f} mm to the side")


@command.command()
def export(
    format: Annotated[Literal["csv", "xapi"], typer.Option("--format", help="xapi: one statement a line.")],
    person: Annotated[str | None, typer.Option(help="Only the results of this person.")] = None,
    group: Annotated[str | None, typer.Option("--class", help="Only the results of this class.")] = None,
    results: Annotated[
        Path | None,
        typer.Option(help="Folder of the results. Default: that of the studio.", exists=True, file_okay=False),
    ] = None,
    home_page: Annotated[
        str | None, typer.Option(help="For xapi: address of the system that knows the persons.", metavar="URL")
    ] = None,
    out: Annotated[Path | None, typer.Option(help="File to write. Default: standard output.", metavar="FILE")] = None,
) -> None:
    """Exports the results that the studio has saved, the oldest first. Ends with status 1 if a file cannot be read."""
    from punctura.exercise import ResultStore, default_folder
    from punctura.exercise.results import ResultsError, to_csv
    from punctura.exercise.xapi import HOME, to_xapi
    from punctura.files.whole_file import write_whole

    if home_page is not None and not home_page.startswith(("http://", "https://")):
        raise typer.BadParameter("must begin with http:// or https://", param_hint="--home-page")
    if home_page is not None and format == "csv":
        raise typer.BadParameter("is for --format xapi", param_hint="--home-page")
    special = out is not None and out.exists() and not out.is_file() and not out.is_dir()  # such as /dev/stdout
    check_place(None if special else out, "--out")
    folder = results or default_folder()
    unread: list[ResultsError] = []
    found = ResultStore(folder).all(person, group, unread)[::-1]
    for error in unread:
        notice(f"{folder}: {error}: it is left out")
    if not found:
        whose = "".join([f" of {person}" if person else "", f" of the class {group}" if group else ""])
        notice(f"there are no results{whose} in {folder}")
    text = to_csv(found) if format == "csv" else to_xapi(found, home_page or HOME)
    if out is None:
        typer.echo(text, nl=False)
    elif special:
        out.write_text(text, encoding="utf-8")
    else:
        write_whole(out, text.encode("utf-8"), private=True)
    if unread:
        raise typer.Exit(FAILED)
