"""Identifies every trace of a folder: in parallel, resumable; a broken file never stops the others."""

import hashlib
import json
import multiprocessing
import os
import re
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, replace
from io import BytesIO
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Literal

import pyarrow as pa
import pyarrow.parquet

import punctura
from punctura import Needle
from punctura.defects import PATIENCE_S, explain
from punctura.files.names import as_text, traces_in
from punctura.files.whole_file import whole_file, write_whole
from punctura.identify.identify import identify
from punctura.identify.population import population
from punctura.identify.records import FailedRecord, FolderRecord, TaskRecord, TraceRecord, TraceRow
from punctura.identify.rig import UNKNOWN, Rig, check
from punctura.trace.read import read_as
from punctura.trace.reading import Reading, SheetError
from punctura.trace.tables import read_table

LONGEST = 200  # bytes of a name; a temporary file adds to it
DIED = "its process ended early; is there enough memory?"  # tried again by the next run


@dataclass(frozen=True)
class Task:
    """How to read and identify the traces of a folder."""

    needle: Needle
    membranes: int | Literal["auto"] = "auto"
    reading: Reading = field(default_factory=Reading)
    rig: Rig = UNKNOWN

    def key(self) -> TaskRecord:
        """What a result depends on, beside its file."""
        needle = [self.needle.diameter, self.needle.tip_angle]
        return {"needle": needle, "membranes": self.membranes, "reading": asdict(self.reading),
                "rig": asdict(self.rig), "punctura": punctura.__version__}  # fmt: skip


def identify_folder(
    folder: str | os.PathLike[str],
    out: str | os.PathLike[str],
    task: Task,
    workers: int | None = None,
    progress: Callable[[float], None] = lambda _: None,
) -> FolderRecord:
    """Identifies all traces of `folder` and writes `out`: a JSON file a trace, traces.parquet, population.parquet.

    A trace whose JSON file fits to the present file and task is not computed again. Returns the summary: how many were
    identified, kept from before and failed, and the population. Raises OSError, ValueError for a folder without traces
    and for a rig that cannot be.
    """
    check(task.rig, task.needle)
    paths, out = traces_in(Path(folder)), Path(out)
    if out.resolve() == Path(folder).resolve():
        raise ValueError(
            f"{out}: holds the traces; the results need another folder, because some are Parquet files, too"
        )
    out.mkdir(parents=True, exist_ok=True)
    results: dict[str, TraceRecord] = {}
    for path in paths:
        known = _known(_result_file(out, path), path, task)
        if known is not None:
            results[path.name] = known
    kept = len(results)
    missing = [path for path in paths if path.name not in results]
    for done, (path, result, again) in enumerate(_computed(missing, task, workers), 1):
        results[path.name] = result
        if not again:
            write_whole(_result_file(out, path), json.dumps(result, indent=1).encode())
        progress(done / len(missing))
    return _summary(out, [results[path.name] for path in paths], kept)


def _result_file(out: Path, path: Path) -> Path:
    """The JSON file of a trace. A name that would become too long for a file system ends in a digest."""
    name = os.fsencode(path.name)
    if len(name) > LONGEST:
        return out / f"{path.name[:50]}-{hashlib.sha256(name).hexdigest()[:16]}.json"
    return out / f"{path.name}.json"


def _computed(paths: Sequence[Path], task: Task, workers: int | None) -> Iterator[tuple[Path, TraceRecord, bool]]:
    """Each path with its result, as they come, and whether the next run shall try it again.

    A trace whose process dies has failed; the others do not die with it.
    """
    left = list(paths)
    with _pool(workers or os.cpu_count()) as pool:
        with _ctrl_c_later():
            running = {pool.submit(_one, str(path), task): path for path in left}
        for future in as_completed(running):
            if not isinstance(future.exception(), BrokenProcessPool):
                left.remove(running[future])
                yield running[future], *future.result()
    for path in left:  # one process died, and all lost their results; which one it was, is not known
        with _pool(1) as pool:
            with _ctrl_c_later():
                alone = pool.submit(_one, str(path), task)
            died = isinstance(alone.exception(), BrokenProcessPool)
            yield path, *((_failed(path, task, DIED), True) if died else alone.result())


@contextmanager
def _pool(workers: int | None) -> Iterator[ProcessPoolExecutor]:
    """Processes that leave Ctrl-C to this one. After an error they end at once: a trace may take minutes."""
    # "spawn": a forked copy of a program with threads may hang.
    context = multiprocessing.get_context("spawn")
    closed, stop = context.Pipe(duplex=False)
    with closed, stop, ProcessPoolExecutor(workers, context, _follow_parent, (closed,)) as pool:
        try:
            yield pool
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


@contextmanager
def _ctrl_c_later() -> Iterator[None]:
    """For the start of processes: they inherit that a Ctrl-C waits, and this process gets it at the end of the block.

    Without it, a process that Ctrl-C meets before _follow_parent prints a traceback.
    """
    if not hasattr(signal, "pthread_sigmask"):  # on Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _follow_parent(stopped: Connection) -> None:
    """In a process of the pool: Ctrl-C is the parent's. If that closes its end of `stopped` or dies, this one ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def watch() -> None:
        if parent is not None:
            wait([parent.sentinel, stopped])
            os._exit(1)

    threading.Thread(target=watch, name="punctura-parent", daemon=True).start()


def _one(path: str, task: Task) -> tuple[TraceRecord, bool]:
    """The result of one trace, in a process of its own, and whether the next run shall try it again."""
    try:
        trace = read_as(path, task.reading)
        record = identify(trace, task.needle, task.membranes, rig=task.rig).as_dict()
    except Exception as error:  # a defect in one trace does not stop the others
        return _failed(Path(path), task, explain(error, PATIENCE_S)), isinstance(error, ImportError)
    return {"task": task.key(), "stamp": _stamp(Path(path)), "error": None, **record}, False


def _failed(path: Path, task: Task, reason: str) -> FailedRecord:
    return {"task": task.key(), "stamp": _stamp(path), "error": reason, "trace": str(path), "parameters": []}


def _stamp(path: Path) -> list[int]:
    try:
        status = path.stat()
    except OSError:
        return []
    return [status.st_size, status.st_mtime_ns]


def _known(result: Path, path: Path, task: Task) -> TraceRecord | None:
    """The earlier result of a trace, if neither its file nor the task has changed since."""
    try:
        record = json.loads(result.read_bytes())
    except (OSError, ValueError, RecursionError):
        return None
    wanted = json.loads(json.dumps({"task": task.key(), "stamp": _stamp(path)}))  # JSON has no tuples
    if not isinstance(record, dict) or wanted != {key: record.get(key) for key in wanted}:
        return None
    known: TraceRecord = record  # type: ignore[assignment]  # the same version of punctura wrote it
    return known


def _summary(out: Path, results: list[TraceRecord], kept: int) -> FolderRecord:
    rows: list[TraceRow] = [
        {"trace": _shown(record["trace"]), "rmse_N": record["rmse_N"], "membranes": record["membranes"],
         "extensions": ", ".join(record["extensions"]), **parameter}
        for record in results if record["error"] is None for parameter in record["parameters"]
    ]  # fmt: skip
    people = population(rows)
    for name, table in (("traces.parquet", rows), ("population.parquet", people)):
        with whole_file(out / name) as place:
            pa.parquet.write_table(pa.Table.from_pylist(table), place)
    failed = {_shown(record["trace"]): record["error"] for record in results if record["error"] is not None}
    return {"traces": len(results), "identified": len(results) - len(failed), "kept": kept, "failed": failed,
            "population": people}  # fmt: skip


def _shown(source: str) -> str:
    """The name of a file as text."""
    return as_text(Path(source).name)


def write_specimens(path: Path, reading: Reading, folder: Path) -> None:
    """Writes each table of a file that can be a trace to `folder` as Parquet. Raises TraceError, OSError.

    A file with the same table is left as it is, so that its result is kept; one of a former specimen is removed.
    """
    try:
        tables = {path.stem: read_table(path, reading)}
    except SheetError as several:
        if reading.sheet is not None:
            raise
        tables = {name: read_table(path, replace(reading, sheet=name)) for name in several.sheets}
    folder.mkdir(parents=True, exist_ok=True)
    written = set()
    for number, (name, table) in enumerate(tables.items(), 1):
        plain = re.sub(r"[^\w .-]", "_", name)[:80]
        place = folder / f"{number:02}-{plain}.parquet"
        held = BytesIO()
        pa.parquet.write_table(pa.table(dict(table)), held)
        if not place.exists() or place.read_bytes() != held.getvalue():
            write_whole(place, held.getvalue())
        written.add(place)
    for former in set(folder.glob("[0-9]*-*.parquet")) - written:
        former.unlink()
