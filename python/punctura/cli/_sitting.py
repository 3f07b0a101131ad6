"""`punctura perception run`: a participant's session in the studio's page."""

from __future__ import annotations

import sys
from pathlib import Path

import typer

from punctura._core import DeviceError, Placement
from punctura.cli._notice import notice
from punctura.cli._studio import need_studio
from punctura.live import RunLimits, load_limits, load_placement
from punctura.perception import Protocol
from punctura.perception.load import check_device
from punctura.process.dropping_stream import DroppingStream


def run_sitting(
    protocol: Protocol, folder: Path, participant: str, device: str, limits: Path | None, placement: Path | None,
    port: int, browser: bool,
) -> None:  # fmt: skip
    """Raises Ended if a signal ended it, SessionError, StudioError, ConfigurationError."""
    need_studio("punctura perception run")
    from punctura.studio import serve
    from punctura.studio.loaded import from_name
    from punctura.studio.run import Settings
    from punctura.studio.sitting import PerceptionSitting

    serve.need_page(serve.PAGE)
    base = from_name(protocol.scene_name)
    settings = Settings(
        device,
        load_placement(placement) if placement else Placement(),
        limits=load_limits(limits) if limits else RunLimits(),
    )

    def make() -> serve.StudioServer:
        server = serve.StudioServer(base, settings, port, serve.token_from_environment(), folder=folder)
        studio = server.session
        check_device(protocol, studio.run.loop.limits)
        studio.sitting = PerceptionSitting(studio, protocol, base, participant)
        studio.call(studio.sitting.start)
        for note in studio.run.notes:
            notice(f"note: {note}")
        return server

    out = DroppingStream(sys.stdout)
    try:
        serve.run_studio(make, browser, report=lambda address: print(address, file=out))
    except DeviceError as error:
        raise typer.BadParameter(str(error), param_hint="--device") from None
