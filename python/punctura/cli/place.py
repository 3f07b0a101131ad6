"""`punctura place`: measures the place of the device in the scene, with the force off."""

import math
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from punctura._core import DeviceError, PuncturaError, ServoLoop
from punctura.cli._out import check_place
from punctura.files.whole_file import write_whole
from punctura.live import fit_direction, open_for, placement_from_pose, placement_text, present_pose
from punctura.scene import load_scene

IN_FRONT = 20e-3  # m in front of the first membrane: the user holds the tip there


def command(
    scene: Annotated[str, typer.Argument(help="The scene to place the device in.", metavar="SCENE")] = "k06-fig10",
    device: Annotated[str, typer.Option("--device", help="Device name (punctura devices).")] = "",
    tip_offset_mm: Annotated[
        float,
        typer.Option("--tip-offset-mm", help="Distance from the device's point to the needle's tip along the stylus."),
    ] = 0.0,
    out: Annotated[Path, typer.Option("--out", help="Placement file to write.", metavar="FILE.toml")] = Path(
        "placement.toml"
    ),
) -> None:
    """Asks for one pose and writes a placement file. Gives no force. The file is for `punctura run --placement`."""
    if device.startswith("replay:"):
        raise typer.BadParameter("a replay has no hand that holds a pose; choose another device", param_hint="--device")
    check_place(out, "--out")
    if not math.isfinite(tip_offset_mm):
        raise typer.BadParameter("must be a finite number", param_hint="--tip-offset-mm")
    loaded = load_scene(scene)
    try:
        opened = open_for(loaded, device)
    except DeviceError as error:
        raise typer.BadParameter(str(error), param_hint="--device") from None
    fitted, note = fit_direction(loaded, opened)
    first = fitted.membranes[0]
    inward = np.array(first.inward_normal) / np.linalg.norm(first.inward_normal)
    loop = ServoLoop(opened, fitted)
    loop.start()  # disarmed: no force
    try:
        typer.echo(
            f"Hold the stylus so that the tip is {IN_FRONT * 1e3:g} mm in front of '{first.name}'"
            + ("" if note else " and points straight into it")
        )
        try:
            typer.prompt("Then press Enter", default="", show_default=False, prompt_suffix=" ")
        except typer.Abort:
            typer.echo()
            raise PuncturaError(f"the input ended before Enter was pressed; {out} was not written") from None
        position, axis = present_pose(loop)
    except DeviceError as error:
        raise typer.BadParameter(str(error), param_hint="--device") from None
    finally:
        loop.stop()
    placement = placement_from_pose(
        position, inward if note else axis, np.array(first.point) - IN_FRONT * inward, inward, tip_offset_mm * 1e-3
    )
    write_whole(out, placement_text(placement).encode("utf-8"))
    on = f" --device {device}" if device else ""
    typer.echo(f"{out}: written. Try it: punctura run {scene} --headless{on} --placement {out}")
