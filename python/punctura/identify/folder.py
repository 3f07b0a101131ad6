"""Identifies every trace of a folder: in parallel, resumable; a broken file never stops the others."""

from __future__ import annotations

import json
import multiprocessing
import os
from collections.abc import Callable, Mapping
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import pyarrow as pa
import pyarrow.parquet

from punctura import Needle, PuncturaError
from punctura.files.whole_file import whole_file, write_whole
from punctura.identify.identify import identify
from punctura.identify.population import population
from punctura.trace import read_trace

SUFFIXES = (".csv", ".txt", ".parquet", ".mat", ".xlsx")


@dataclass(frozen=True)
class Task:
    """How to read and identify the traces of a folder."""

    needle: Needle
    membranes: int | Literal["auto"] = "auto"
    columns: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    order: Literal["recorded", "depth"] = "recorded"

    def key(self) -> dict[str, Any]:
        """What a result depends on, beside its file."""
        needle = [self.needle.diameter, self.needle.tip_angle]
        return {"needle": needle, "membranes": self.membranes, "columns": dict(self.columns),
                "units": dict(self.units), "order": self.order}  # fmt: skip


def traces_in(folder: Path) -> list[Path]:
    """The trace files of a folder, by name."""
    return sorted(path for path in folder.iterdir() if path.suffix.lower() in SUFFIXES and path.is_file())


def identify_folder(
    folder: str | os.PathLike[str],
    out: str | os.PathLike[str],
    task: Task,
    processes: int | None = None,
    progress: Callable[[float], None] = lambda _: None,
) -> dict[str, Any]:
    """Identifies all traces of `folder` and writes `out`: a JSON file a trace, traces.parquet, population.parquet.

    A trace whose JSON file fits to the present file and task is not computed again. Returns the summary: how many were
    identified, kept from before and failed, and the population. Raises OSError, ValueError for a folder without traces.
    """
    paths, out = traces_in(Path(folder)), Path(out)
    if not paths:
        raise ValueError(f"{folder}: holds no trace ({', '.join(SUFFIXES)})")
    out.mkdir(parents=True, exist_ok=True)
    results: dict[str, dict[str, Any]] = {}
    for path in paths:
        known = _known(out / f"{path.name}.json", path, task)
        if known is not None:
            results[path.name] = known
    kept = len(results)
    missing = [path for path in paths if path.name not in results]
    # "spawn": a forked copy of a program with threads may hang.
    with ProcessPoolExecutor(processes or os.cpu_count(), multiprocessing.get_context("spawn")) as pool:
        running = {pool.submit(_one, str(path), task): path for path in missing}
        for done, future in enumerate(as_completed(running), 1):
            path = running[future]
            try:
                result = future.result()
            except Exception as error:  # the process of this trace died
                result = _failed(path, task, f"{type(error).__name__}: {error}")
            write_whole(out / f"{path.name}.json", json.dumps(result, indent=1).encode())
            results[path.name] = result
            progress(done / len(missing))
    return _summary(out, [results[path.name] for path in paths], kept)


def _one(path: str, task: Task) -> dict[str, Any]:
    """The result of one trace, in a process of its own."""
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    try:
        trace = read_trace(path, dict(task.columns), dict(task.units), order=task.order)
        told = identify(trace, task.needle, task.membranes).as_dict()
    except (PuncturaError, OSError, ValueError, ArithmeticError) as error:
        return _failed(Path(path), task, str(error))
    return {"task": task.key(), "stamp": _stamp(Path(path)), "error": None, **told}


def _failed(path: Path, task: Task, reason: str) -> dict[str, Any]:
    return {"task": task.key(), "stamp": _stamp(path), "error": reason, "source": str(path), "parameters": []}


def _stamp(path: Path) -> list[int]:
    try:
        status = path.stat()
    except OSError:
        return []
    return [status.st_size, status.st_mtime_ns]


def _known(result: Path, path: Path, task: Task) -> dict[str, Any] | None:
    """The earlier result of a trace, if neither its file nor the task has changed since."""
    try:
        told = json.loads(result.read_bytes())
    except (OSError, ValueError):
        return None
    same = isinstance(told, dict) and told.get("task") == task.key() and told.get("stamp") == _stamp(path)
    return told if same else None


def _summary(out: Path, results: list[dict[str, Any]], kept: int) -> dict[str, Any]:
    rows = [
        {"trace": Path(told["source"]).name, "rmse_N": told["rmse_N"], "membranes": told["membranes"],
         "extensions": ", ".join(told["extensions"]), **parameter}
        for told in results if told["error"] is None for parameter in told["parameters"]
    ]  # fmt: skip
    people = population(rows)
    for name, table in (("traces.parquet", rows), ("population.parquet", people)):
        with whole_file(out / name) as place:
            pa.parquet.write_table(pa.Table.from_pylist(table), place)
    failed = {Path(told["source"]).name: told["error"] for told in results if told["error"] is not None}
    return {"traces": len(results), "identified": len(results) - len(failed), "kept": kept, "failed": failed,
            "population": people}  # fmt: skip
