"""`punctura run`: the studio in a browser."""

import sys
from collections.abc import Sequence
from pathlib import Path

from punctura._core import Placement
from punctura.cli._headless import USUAL_SCENE, Wishes, begun
from punctura.cli._out import notice
from punctura.extras import optional
from punctura.process.dropping_stream import DroppingStream


def need_studio(user: str) -> None:
    """Raises MissingPackageError. user: the part of Punctura that shows the studio's page."""
    for package in ("pyarrow", "starlette", "uvicorn", "websockets"):
        optional(package, "studio", user)


def run_page(
    wishes: Wishes, port: int, browser: bool, recordings: Path | None, page: Path | None, own: Sequence[str] = ()
) -> None:
    """own: exercise files that the page lists, too; without a scene, the first exercise's scene runs.

    Raises DeviceError, Ended if a signal ended the run, StudioError (its text says what to do), ConfigurationError.
    """
    need_studio("the page of punctura run")
    # Imported here, because importing the server takes long.
    from punctura.exercise import load_exercise
    from punctura.studio import serve
    from punctura.studio.catalog import Exercises
    from punctura.studio.loaded import from_name
    from punctura.studio.run import Settings

    folder = page or serve.PAGE
    serve.need_page(folder)
    exercises = Exercises(own)
    for file, warning in exercises.warnings:
        notice(f"warning: {file}: {warning}")
    scene = load_exercise(own[0]).scene_name if own and not wishes.scene else wishes.scene or USUAL_SCENE
    loaded = from_name(scene)
    for sentence in loaded.unusual:
        notice(f"warning: {sentence}")
    settings = Settings(
        wishes.device, wishes.placement or Placement(), wishes.scene_filter, wishes.limits, wishes.processor,
        wishes.second,
    )  # fmt: skip
    token = serve.token_from_environment()

    def make() -> serve.StudioServer:
        server = serve.StudioServer(loaded, settings, port, token, folder, recordings, exercises)
        for note in server.session.run.notes:
            notice(f"note: {note}")
        session = server.session
        notice(begun(loaded.scene.name, session.run.loop, session.bench.device, session.run.thumb))
        return server

    out = DroppingStream(sys.stdout)
    serve.run_studio(make, browser, wishes.duration, lambda address: print(address, file=out))
