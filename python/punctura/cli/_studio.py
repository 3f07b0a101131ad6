"""`punctura run`: the studio in a browser."""

from __future__ import annotations

import sys
from pathlib import Path

from punctura._core import Placement
from punctura.cli._headless import Wishes, begun, say
from punctura.live import DroppingStream


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
            say(f"punctura: note: {note}")
        session = server.session
        say(begun(loaded.scene.name, session.run.loop, session.bench.device))
        return server

    out = DroppingStream(sys.stdout)
    serve.run_studio(make, browser, wishes.duration, lambda address: print(address, file=out))
