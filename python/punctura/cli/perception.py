"""`punctura perception`: psychophysics by a protocol file, with people or simulated observers."""

from __future__ import annotations

import json
import re
import sys
from dataclasses import asdict
from html import unescape
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from punctura.cli._options import LimitsFile, NoBrowser, PlacementFile, Port
from punctura.cli._out import check_folder, notice
from punctura.cli._streams import leave, never_wait_for_stderr
from punctura.cli._trace import pairs
from punctura.process.signals import Ended
from punctura.progress import progress_bar

if TYPE_CHECKING:
    from punctura.perception import Observer, Protocol

command = typer.Typer(no_args_is_help=True, help="Asks people what they feel; analyses the answers.")

File = Annotated[str, typer.Argument(help="A protocol file, or the name of a ready protocol.", metavar="PROTOCOL")]
Out = Annotated[
    Path | None,
    typer.Option("--out", help="Folder of the sessions. Default: PROTOCOL with .perception.", metavar="FOLDER"),
]
Json = Annotated[bool, typer.Option("--json", help="Print the result as JSON.")]
Observed = Annotated[
    str,
    typer.Option("--observer", help="Some of weber=0.1,noise=0.02,bias=0,lapse=0.02,criterion=0.1."),
]
Seed = Annotated[int, typer.Option(min=0, help="Of the observers.")]


@command.command("list")
def list_protocols(as_json: Json = False) -> None:
    """Lists the ready protocols."""
    from punctura.files.toml import read_tables
    from punctura.ready_protocols import protocol_files

    files = protocol_files()
    titles = {name: read_tables(file, "protocol")["title"] for name, file in files.items()}
    if as_json:
        typer.echo(json.dumps([{"name": n, "title": titles[n], "file": str(files[n])} for n in titles], indent=2))
        return
    for name, title in titles.items():
        typer.echo(f"{name:{max(map(len, titles))}}  {title}")


@command.command()
def check(protocol: File, as_json: Json = False) -> None:
    """Checks a protocol, and says what a hand without tremor feels of each level."""
    from punctura.perception import load_protocol
    from punctura.perception.course import Course

    loaded = load_protocol(protocol)
    trials = len(Course(loaded, 0))
    levels = [{"level": one.level, **dict(one.felt)} for one in loaded.stimuli]
    if as_json:
        found = {"protocol": loaded.name, "unit": loaded.unit, "trials": trials, "levels": levels}
        typer.echo(json.dumps(found, indent=2))
        return
    about = f"scene {loaded.file.scene}, {trials} trials a person, practice and catch trials included"
    typer.echo(f"{loaded.file.title}: {about}")
    for level, felt in ((one.level, one.felt) for one in loaded.stimuli):
        words = f"drop {felt.drop:.3f} N, peak {felt.peak:.3f} N, roughness {felt.roughness * 1e3:.1f} mN"
        typer.echo(f"  {f'{level:g} {loaded.unit}'.rstrip()}: {words}")


@command.command()
def run(
    protocol: File,
    participant: Annotated[str, typer.Option(help="Pseudonym, such as P01; no name.")],
    out: Out = None,
    device: Annotated[str, typer.Option(help="As for punctura run.", metavar="NAME")] = "",
    limits: LimitsFile = None,
    placement: PlacementFile = None,
    port: Port = 0,
    no_browser: NoBrowser = False,
) -> None:
    """Runs a participant's session in the studio's page, or the rest of it: each answered trial is on disk at once."""
    from punctura._core import DeviceError, Placement
    from punctura.cli._headless import begun
    from punctura.cli._studio import need_studio
    from punctura.live import RunLimits, load_limits, load_placement
    from punctura.perception import load_protocol
    from punctura.perception.load import check_device
    from punctura.process.dropping_stream import DroppingStream

    never_wait_for_stderr()
    need_studio("punctura perception run")
    from punctura.studio import serve
    from punctura.studio.loaded import from_name
    from punctura.studio.run import Settings
    from punctura.studio.sitting import PerceptionSitting

    serve.need_page(serve.PAGE)
    folder, loaded = _folder(protocol, out), load_protocol(protocol)
    base, placed = from_name(loaded.scene_name), load_placement(placement) if placement else Placement()
    settings = Settings(device, placed, limits=load_limits(limits) if limits else RunLimits())

    def make() -> serve.StudioServer:
        server = serve.StudioServer(base, settings, port, serve.token_from_environment(), folder=folder)
        studio = server.session
        check_device(loaded, studio.run.loop.limits)
        studio.sitting = PerceptionSitting(studio, loaded, base, participant, notice)
        studio.call(studio.sitting.start)
        for note in studio.run.notes:
            notice(f"note: {note}")
        if studio.bench.simulated:
            notice(f"warning: {loaded.file.words.unfelt} Choose a device with --device; punctura devices lists them.")
        notice(begun(base.scene.name, studio.run.loop, studio.bench.device))
        return server

    shown = DroppingStream(sys.stdout)
    try:
        serve.run_studio(make, not no_browser, report=lambda address: print(address, file=shown))
    except DeviceError as error:
        raise typer.BadParameter(str(error), param_hint="--device") from None
    except Ended as end:
        kept = f", and {folder} keeps the answered trials" if folder.is_dir() else ""
        leave(end, f"; the force is off{kept}")


@command.command()
def simulate(
    protocol: File,
    out: Out = None,
    people: Annotated[int, typer.Option(min=1, max=1000, help="Number of observers.")] = 1,
    observer: Observed = "",
    seed: Seed = 0,
    as_json: Json = False,
) -> None:
    """Runs simulated observers O01, O02, ... through the protocol, and analyses their sessions."""
    from punctura.perception import Simulation, load_protocol

    folder, judge = _folder(protocol, out), _observer(observer)
    loaded = load_protocol(protocol)
    simulation = Simulation(loaded, judge)
    try:
        with progress_bar("observers") as progress:
            for i in range(people):
                simulation.run_on_disk(folder, f"O{i + 1:02d}", seed + i)
                progress((i + 1) / people)
    except (KeyboardInterrupt, Ended):
        notice(f"{folder} keeps the answered trials: the same command goes on with the next one")
        raise
    _analysed(loaded, folder, as_json)


@command.command()
def analyse(protocol: File, out: Out = None, as_json: Json = False) -> None:
    """Analyses all sessions of a folder: report.html, results.json, trials.csv, trials.parquet, dictionary.csv."""
    from punctura.perception import load_protocol

    _analysed(load_protocol(protocol), _folder(protocol, out, there=True), as_json)


def _analysed(protocol: Protocol, folder: Path, as_json: bool) -> None:
    from punctura.perception import write_report

    found = write_report(protocol, folder)
    if as_json:
        typer.echo(found.model_dump_json(indent=1))
        return
    report = unescape((folder / "report.md").read_text(encoding="utf-8"))
    typer.echo(re.split(r"\n(?:## |!\[)", report, maxsplit=1)[0].rstrip())  # without d' at each level and the picture
    typer.echo(str(folder / "report.html"))


@command.command()
def power(
    protocol: File,
    trials: Annotated[str, typer.Option(help="Scored trials of a person, such as 60,120,240.")] = "60,120,240",
    people: Annotated[str, typer.Option(help="Numbers of people, such as 4,8.")] = "4,8",
    experiments: Annotated[int, typer.Option(min=2, max=10_000, help="Simulated experiments a row.")] = 20,
    between: Annotated[float, typer.Option(min=0, max=2, help="Spread of the people's noise, as a share.")] = 0.2,
    observer: Observed = "",
    seed: Seed = 0,
    as_json: Json = False,
) -> None:
    """How wide the intervals become with so many trials and people, by simulated observers."""
    from punctura.perception import load_protocol
    from punctura.perception import power as rows_of

    counts = _numbers(trials, "--trials"), _numbers(people, "--people")
    judge = _observer(observer)
    loaded = load_protocol(protocol)
    if loaded.rates or loaded.adjusts:
        raise typer.BadParameter("has no psychometric function", param_hint="PROTOCOL")
    with progress_bar("power") as progress:
        rows = rows_of(loaded, judge, *counts, experiments, seed, between, progress)
    if as_json:
        typer.echo(json.dumps([asdict(row) for row in rows], indent=2))
        return
    head = "trials  people  interval of a person, UNIT  of the mean, UNIT  without a threshold"
    typer.echo(head.replace("UNIT", loaded.unit or "-"))
    for row in rows:
        typer.echo(
            f"{row.trials:6}  {row.people:6}  {row.person_width:26.3g}  {row.mean_width:14.3g}  {row.without:20.1%}"
        )


def _observer(text: str) -> Observer:
    """Raises BadParameter."""
    from punctura.perception import Observer

    given, known = pairs(list(filter(None, text.split(","))), "--observer", "weber=0.1"), Observer.__dataclass_fields__
    try:
        if unknown := given.keys() - known:
            raise ValueError(f"{min(unknown)} is none of {', '.join(known)}")
        return Observer(**{key: float(value) for key, value in given.items()})
    except ValueError as bad:
        raise typer.BadParameter(str(bad), param_hint="--observer") from None


def _numbers(text: str, option: str) -> list[int]:
    try:
        found = [int(part) for part in text.split(",")]
    except ValueError:
        found = []
    if not found or min(found) < 1:
        raise typer.BadParameter("must be whole numbers from 1, with commas between them", param_hint=option)
    return found


@command.command()
def delete(
    protocol: File, participant: Annotated[str, typer.Argument(help="Pseudonym.", metavar="PSEUDONYM")], out: Out = None
) -> None:
    """Deletes a participant's session and recordings, and the tables and the report that contain them."""
    from punctura.perception import delete_participant

    for path in delete_participant(_folder(protocol, out, there=True), participant):
        typer.echo(f"deleted {path}")


def _folder(protocol: str, out: Path | None, there: bool = False) -> Path:
    """there: it must exist."""
    check_folder(out, "--out")
    folder = out or Path(protocol).with_suffix(".perception")
    if there and not folder.is_dir():
        raise typer.BadParameter(f"there is no folder {folder}; punctura perception run makes one", param_hint="--out")
    return folder
