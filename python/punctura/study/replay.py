"""One trial of a study again, alone, as a scene file and a recording."""

import os
import time
from pathlib import Path

from punctura._core import ServoLoop
from punctura.record import Recorder, RecordingError, open_recording
from punctura.results import JsonObject
from punctura.scene.build import save_scene
from punctura.study.design import design, row_schema, run_trials
from punctura.study.folder import MARK, Folder, NoSuchRowError, StudyError
from punctura.study.plan import Plan


def replay_row(plan: Plan, row: int, out: str | os.PathLike[str]) -> tuple[Path, Path]:
    """Runs the trial of a row again and writes row-N.toml and the recording row-N.parquet to the folder `out`.

    The recording holds each tick of the trial; punctura run --recordings FOLDER lists it in the studio. Returns the
    two paths. Raises StudyError for an unknown row, a lost tick, or files of another plan, RecordingError, OSError.
    """
    trials = design(plan)
    if not 0 <= row < len(trials.seeds):
        raise NoSuchRowError(f"{plan.path}: there is no row {row}; the rows are 0 to {len(trials.seeds) - 1}")
    result = run_trials(plan, trials.part(row, row + 1), row, threads=1, duration=0.0)
    scene, experiment = result.scene(0), result.experiment(0)
    duration = plan.duration or experiment.duration
    ticks = len(experiment.run(duration))
    folder = Path(out)
    schema = row_schema(plan, trials)
    Folder(folder).check(schema)
    folder.mkdir(parents=True, exist_ok=True)
    scene_path, path = folder / f"row-{row}.toml", folder / f"row-{row}.parquet"
    about: JsonObject = {"study": plan.path.name, "row": row, "digest": schema.metadata[MARK].decode()}
    _make_room(path, about)
    save_scene(scene, scene_path)
    device = result.device(0, ticks)
    loop = ServoLoop(device, scene)
    recorder = Recorder(loop, path, ticks, about)
    try:
        loop.arm()
        loop.start()
        while not device.finished:
            time.sleep(0.005)
        loop.stop()
    finally:
        status = recorder.finish()
    if status.lost:
        raise StudyError(f"{path}: the computer was too slow to record {status.lost} of {ticks} ticks; try again")
    return scene_path, path


def _make_room(path: Path, about: JsonObject) -> None:
    """Deletes the recording of the same row of the same plan. Raises StudyError for any other file."""
    if not path.exists():
        return
    try:
        found = open_recording(path).info.about
    except RecordingError:
        found = {}
    if {**found, "study": about["study"]} != about:  # the plan's name says nothing about its numbers
        raise StudyError(f"{path} is no recording of this row of this plan. Give another --out, or move this file away")
    path.unlink()
