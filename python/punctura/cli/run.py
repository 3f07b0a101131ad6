"""`punctura run`: runs a scene on a device, with a page or in this terminal."""

import os
import sys
from pathlib import Path
from typing import Annotated

import typer

from punctura._core import DeviceError
from punctura.cli._headless import USUAL_SCENE, Wishes, run_headless
from punctura.cli._options import LimitsFile, NoBrowser, PlacementFile, Port, rivals_of
from punctura.cli._out import check_place
from punctura.cli._streams import leave, never_wait_for_stderr
from punctura.cli._studio import run_page
from punctura.errors import ConfigurationError
from punctura.live import (
    ANY_PROCESSOR,
    Ended,
    RunLimits,
    SecondDevice,
    SecondDeviceError,
    direction_of,
    load_limits,
    load_placement,
)
from punctura.process.signals import ends_on_signals


def command(
    scene: Annotated[
        str,
        typer.Argument(
            help="A scene file, or the name of a ready scene (punctura scenes).",
            metavar="SCENE",
            show_default=USUAL_SCENE,
        ),
    ] = "",
    headless: Annotated[bool, typer.Option("--headless", help="Run in the terminal, without the studio.")] = False,
    port: Port = 0,
    no_browser: NoBrowser = False,
    device: Annotated[
        str,
        typer.Option(
            "--device",
            help="Device name (punctura devices), or replay:FILE.parquet. Default: the first available device, "
            "else the simulated one.",
        ),
    ] = "",
    second_device: Annotated[
        str,
        typer.Option(
            "--second-device",
            help="Device under the thumb, on the plunger of the scene's syringe (docs/syringe.md); a name as above.",
        ),
    ] = "",
    second_direction: Annotated[
        str | None,
        typer.Option(
            "--second-direction",
            help="Direction in which the thumb pushes, in the second device's axes. Default: 0,-1,0.",
            metavar="X,Y,Z",
        ),
    ] = None,
    duration: Annotated[
        float | None, typer.Option("--duration", help="Seconds to run. Default: until Ctrl-C.", min=0.0)
    ] = None,
    placement: PlacementFile = None,
    limits: LimitsFile = None,
    max_force: Annotated[
        float | None, typer.Option("--max-force-N", help="Largest force, N. Overrides --limits.")
    ] = None,
    scene_filter: Annotated[
        bool, typer.Option("--scene-filter", help="Use the scene's position filter, not the one for this device.")
    ] = False,
    processor: Annotated[
        int | None,
        typer.Option("--processor", help="CPU number for the servo thread. Default: any.", min=0),
    ] = None,
    recordings: Annotated[
        Path | None,
        typer.Option("--recordings", help="Folder of the studio's recordings.", metavar="FOLDER"),
    ] = None,
    exercise: Annotated[
        list[str] | None,
        typer.Option(
            "--exercise",
            help="Exercise file to list in the studio. Without SCENE, its scene runs. Can be repeated.",
            metavar="FILE.toml",
        ),
    ] = None,
    rival: Annotated[
        list[str] | None,
        typer.Option(
            "--rival",
            help="With --headless: the force model of another author instead of the scene's law (docs/rivals.md); its "
            "name, or a file of punctura rivals --out.",
            metavar="NAME|FILE",
        ),
    ] = None,
    record: Annotated[
        Path | None,
        typer.Option("--record", help="With --headless: record every tick to this file.", metavar="FILE.parquet"),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="With --headless: print the summary as JSON.")] = False,
    page: Annotated[Path | None, typer.Option("--page", hidden=True)] = None,
) -> None:
    """Runs a scene on a device, in the studio or in the terminal. All safety limits are on.

    The hand of the simulated device follows the mouse in the page; with --headless it makes strokes through the scene.
    """
    never_wait_for_stderr()
    of_the_terminal = (
        (record, "--record", "; the page has a button for it"),
        (as_json, "--json", ""),
        (rival, "--rival", "; the page draws the scene's law"),
    )
    for wrong, name, instead in of_the_terminal:
        if wrong not in (None, False) and not headless:
            raise typer.BadParameter(f"needs --headless{instead}", param_hint=name)
    if record and record.suffix.lower() != ".parquet":
        raise typer.BadParameter("must end in .parquet", param_hint="--record")
    check_place(record, "--record")
    of_the_page = {"--port": port, "--no-browser": no_browser, "--recordings": recordings, "--exercise": exercise}
    for name, given in of_the_page.items():
        if given and headless:
            raise typer.BadParameter("is an option of the page; leave it out with --headless", param_hint=name)
    if placement and device.startswith("replay:"):
        raise typer.BadParameter(
            "recorded positions are already in the scene's frame; leave it out with a replay", param_hint="--placement"
        )
    stands = load_placement(placement) if placement else None
    allowed = load_limits(limits) if limits else RunLimits()
    if max_force is not None:
        try:
            allowed = allowed.at_most(max_force)
        except ConfigurationError as error:
            raise typer.BadParameter(error.problems[0].reason, param_hint="--max-force-N") from None
    if second_direction is not None and not second_device:
        raise typer.BadParameter("needs --second-device", param_hint="--second-direction")
    second = SecondDevice(second_device) if second_device else None
    if second and second_direction is not None:
        second = second._replace(direction=_direction(second_direction))
    wishes = Wishes(
        scene, device, duration, stands, scene_filter, _existing(processor), allowed, second, rivals_of(rival)
    )
    with ends_on_signals() as signals:
        try:
            with signals.raised():
                if headless:
                    run_headless(wishes, record, as_json)
                else:
                    run_page(wishes, port, not no_browser, recordings, page, exercise or ())
        except DeviceError as error:
            hint = "--second-device" if isinstance(error, SecondDeviceError) else "--device"
            chosen = (
                "" if device or second_device else " (the first available device; choose another one with --device)"
            )
            raise typer.BadParameter(f"{error}{chosen}", param_hint=hint) from None
        except Ended as end:
            leave(end, "; the force is off")


def _direction(text: str) -> tuple[float, float, float]:
    """Raises typer.BadParameter."""
    try:
        return direction_of(text)
    except ValueError as error:
        raise typer.BadParameter(str(error), param_hint="--second-direction") from None


def _existing(processor: int | None) -> int:
    """Raises typer.BadParameter for a processor that does not exist or is not allowed."""
    if processor is None:
        return ANY_PROCESSOR
    there = sorted(os.sched_getaffinity(0)) if sys.platform == "linux" else range(os.cpu_count() or 1)
    if processor not in there:
        names = ", ".join(str(one) for one in there)
        raise typer.BadParameter(
            f"processor {processor} cannot be used here; there are {names}", param_hint="--processor"
        )
    return processor
