"""Runs the trials of a plan in chunks; a later run goes on where an earlier one ended. Also runs one trial again."""

import os
import shutil
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import monotonic, sleep

import pyarrow as pa

from punctura._core import ServoLoop
from punctura.progress import Progress, reporting
from punctura.record import Recorder, RecordingError, open_recording
from punctura.results import JsonObject
from punctura.scene.build import save_scene
from punctura.study.cluster import Part, needed_package, on_cluster
from punctura.study.design import chunk_table, design, row_schema, run_trials
from punctura.study.folder import MARK, Folder, NoSuchRowError, StudyError
from punctura.study.plan import Plan
from punctura.study.report import write_report

WORTH_S = 60.0  # a shorter study needs no forecast


@dataclass(frozen=True)
class Forecast:
    """What is left of a study. seconds: None where a cluster computes; bytes: of disk, for the chunks and the table."""

    trials: int
    seconds: float | None
    bytes: int
    free: int  # bytes of the disk

    @property
    def is_worth_showing(self) -> bool:
        """Whether it takes long, or the disk may be too small."""
        return (self.seconds or 0.0) > WORTH_S or self.bytes > 0.9 * self.free

    def __str__(self) -> str:
        lasts = "" if self.seconds is None else f" about {_span(self.seconds)} and"
        text = f"{self.trials} trials are left: they need{lasts} {_size(self.bytes)} of disk"
        if self.bytes <= 0.9 * self.free:
            return text
        return f"{text}, and {_size(self.free)} are free: name fewer results in the plan, or give --out on another disk"


def forecast(folder: Folder, first: int, seconds: float | None, chunks_left: int, chunks: int, trials: int) -> Forecast:
    """From chunk `first`, which took `seconds`. chunks_left: without it; chunks: all; trials: that are left."""
    size = folder.chunk(first).stat().st_size
    lasts = None if seconds is None else seconds * chunks_left
    return Forecast(trials, lasts, size * (chunks_left + chunks), shutil.disk_usage(folder.path).free)


def _span(seconds: float) -> str:
    for unit, name in ((86400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 1.5 * unit:
            return f"{seconds / unit:.2g} {name}"
    return f"{seconds:.0f} s"


def _size(count: int) -> str:
    return f"{count / 1e9:.2g} GB" if count >= 1e8 else f"{count / 1e6:.2g} MB"


__all__ = ["StudyError", "StudySummary", "run_study"]

CHECKING = 0.05  # of the time of a study, measured with trials of one second


@dataclass(frozen=True)
class StudySummary:
    """The files of a study, and how many trials it has, were kept from before, or were ended by a fault."""

    plan: str  # its file
    table: str  # Parquet file, one row for each trial
    report: str  # its file
    trials: int  # of the whole plan
    kept: int  # trials that an earlier run had computed
    faults: int  # trials that a fault of the servo step ended


def run_study(
    plan: Plan,
    out: str | os.PathLike[str],
    threads: int | None = None,
    progress: Progress = None,
    scheduler: str | None = None,
    on_forecast: Callable[[Forecast], None] = lambda _: None,
) -> StudySummary:
    """Runs all trials that the folder `out` does not hold yet, and writes trials.parquet and report.md there.

    threads: default: one for each processor; the rows do not depend on it. scheduler: the address of a Dask scheduler,
    whose workers compute the trials instead. on_forecast: is called after the first chunk, if more follow. Raises
    ConfigurationError if a trial's numbers are no scene, StudyError, OSError.
    """
    folder, all_of_them = Folder(Path(out)), design(plan)
    n, size = len(all_of_them.seeds), plan.file.chunk
    starts = range(0, n, size)
    kept = 0
    with folder.locked(), reporting(progress, "study") as update:
        folder.claim(row_schema(plan, all_of_them))
        if scheduler is not None:
            needed_package()
        if folder.is_complete(n):
            kept = n
            folder.drop_chunks()
        else:
            parts = []
            for number, begin in enumerate(starts):  # all trials are checked before the first one runs
                part = Part(number, begin, all_of_them.part(begin, min(begin + size, n)))
                run_trials(plan, part.trials, begin, threads, duration=0.0)
                if folder.has(number, begin, len(part.trials.seeds)):
                    kept += len(part.trials.seeds)
                else:
                    parts.append(part)
                update(CHECKING * (number + 1) / len(starts))
            done, began = kept, monotonic()
            for number, table in _computed(plan, parts, threads, scheduler):
                folder.save(number, table)
                done += table.num_rows
                update(1 - (1 - CHECKING) * (1 - done / n))
                if done == kept + table.num_rows < n:
                    took = monotonic() - began if scheduler is None else None
                    on_forecast(forecast(folder, number, took, len(parts) - 1, len(starts), n - done))
            folder.join(len(starts))
        report, faults = write_report(plan, folder)
    return StudySummary(str(plan.path), str(folder.table), str(report), n, kept, faults)


def _computed(
    plan: Plan, parts: Sequence[Part], threads: int | None, scheduler: str | None
) -> Iterator[tuple[int, pa.Table]]:
    """The table of each part, with the part's number; from a cluster, in any order."""
    if not parts:
        return
    if scheduler is not None:
        yield from on_cluster(scheduler, plan, parts)
        return
    for part in parts:
        yield part.number, chunk_table(plan, part.trials, part.begin, threads)


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
            sleep(0.005)
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
