"""`punctura run`: the studio in a browser."""

from __future__ import annotations

from pathlib import Path

import typer

from punctura._core import Placement
from punctura.cli._headless import Wishes, begun


def run_page(wishes: Wishes, port: int, browser: bool, recordings: Path | None, page: Path | None) -> None:
    """Raises DeviceError; Ended where a signal has ended it; StudioError, which says what to do."""
    from punctura.studio import serve  # a server is a lot to import for those who want none
    from punctura.studio.loaded import from_name
    from punctura.studio.run import Settings

    folder = page or serve.PAGE
    serve.need_page(folder)
    loaded = from_name(wishes.scene)
    settings = Settings(
        wishes.device, wishes.placement or Placement(), wishes.scene_filter, wishes.limits, wishes.processor
    )
    token = serve.token_from_environment()

    def make() -> serve.StudioServer:
        server = serve.StudioServer(loaded, settings, port, token, folder, recordings)
        for note in server.session.run.notes:
            typer.echo(f"punctura: note: {note}", err=True)
        session = server.session
        typer.echo(begun(loaded.scene.name, session.run.loop, session.bench.device), err=True)
        return server

    serve.run_studio(make, browser, wishes.duration, typer.echo)
