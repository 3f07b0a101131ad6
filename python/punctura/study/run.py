"""Runs the trials of a plan in chunks; a later run goes on where an earlier one ended."""

from __future__ import annotations

import hashlib
import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow as pa

from punctura import BatchResult, __version__, batch
from punctura.errors import ConfigurationError
from punctura.progress import Progress, reporting
from punctura.scene.write import scene_text
from punctura.study.design import Design, design
from punctura.study.folder import Folder, StudyError
from punctura.study.plan import Plan
from punctura.study.report import write_report

__all__ = ["StudyError", "StudySummary", "run_study"]


@dataclass(frozen=True)
class StudySummary:
    """What a run of a study has done."""

    plan: str
    table: str  # Parquet file, one row for each trial
    report: str
    trials: int
    kept: int  # trials that an earlier run had computed
    faults: int  # trials that a fault of the servo step ended


def run_study(
    plan: Plan, out: str | os.PathLike[str], threads: int | None = None, progress: Progress = None
) -> StudySummary:
    """Runs all trials that the folder `out` does not hold yet, and writes trials.parquet and report.md there.

    threads: default: one for each processor; the rows do not depend on it. Raises ConfigurationError if a trial's
    numbers are no scene, StudyError, OSError.
    """
    folder, all_of_them = Folder(Path(out)), design(plan)
    n, size = len(all_of_them.seeds), plan.file.chunk
    starts = range(0, n, size)
    kept = 0
    with folder.locked(), reporting(progress, "study") as tell:
        folder.claim(_digest(plan, all_of_them))
        if folder.is_complete(n):
            kept = n
            folder.drop_chunks()
        else:
            for begin in starts:  # all trials are checked before the first one runs
                run_part(plan, all_of_them, begin, min(begin + size, n), threads, duration=0.0)
            for number, begin in enumerate(starts):
                end = min(begin + size, n)
                if folder.has(number, end - begin):
                    kept += end - begin
                else:
                    folder.save(number, _table(plan, run_part(plan, all_of_them, begin, end, threads), begin))
                tell(end / n)
            folder.join(len(starts))
        report, faults = write_report(plan, folder)
    return StudySummary(str(plan.path), str(folder.table), str(report), n, kept, faults)


def run_part(
    plan: Plan, trials: Design, begin: int, end: int, threads: int | None = None, duration: float | None = None
) -> BatchResult:
    """The trials from `begin` up to `end`. duration: s; default: the plan's. Raises ConfigurationError."""
    part = trials.part(begin, end)
    try:
        return batch(
            plan.scene,
            plan.motion,
            vary=part.values,
            seeds=part.seeds,
            duration=plan.duration if duration is None else duration,
            plant=plan.plant,
            hand=plan.hand,
            threads=threads,
        )
    except ConfigurationError as bad:
        raise ConfigurationError(bad.problems, f"{plan.path}: trials from row {begin} on") from None
    except MemoryError as bad:
        raise StudyError(f"{plan.path}: {bad} Give a smaller chunk.") from None


def _table(plan: Plan, result: BatchResult, begin: int) -> pa.Table:
    table = result.to_arrow()
    kept = [*(one.path for one in plan.variables), "seed", *plan.results]
    names = [*kept, *([] if "fault" in kept else ["fault"])]
    row = pa.array(np.arange(begin, begin + len(result), dtype=np.int64))
    return table.select(names).add_column(0, "row", row)


def _digest(plan: Plan, trials: Design) -> str:
    """What the rows depend on."""
    said = repr((__version__, plan.file.chunk, plan.duration, plan.results, plan.motion, plan.plant, plan.hand))
    found = hashlib.sha256(said.encode() + scene_text(plan.scene).encode())
    for path, column in trials.values.items():
        found.update(path.encode() + column.tobytes())
    found.update(trials.seeds.tobytes())
    return found.hexdigest()
