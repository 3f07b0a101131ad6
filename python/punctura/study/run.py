"""Runs the trials of a plan in chunks; a later run goes on where an earlier one ended."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import monotonic

import pyarrow as pa

from punctura.progress import Progress, reporting
from punctura.study.chunk import chunk_table, row_schema, run_trials
from punctura.study.cluster import Part, needed_package, on_cluster
from punctura.study.design import design
from punctura.study.folder import Folder, StudyError
from punctura.study.forecast import Forecast, forecast
from punctura.study.plan import Plan
from punctura.study.report import write_report

__all__ = ["StudyError", "StudySummary", "run_study"]

CHECKING = 0.05  # of the time of a study, measured with trials of one second


@dataclass(frozen=True)
class StudySummary:
    """The files of a study, and how many trials it has, were kept from before, or were ended by a fault."""

    plan: str
    table: str  # Parquet file, one row for each trial
    report: str
    trials: int
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
