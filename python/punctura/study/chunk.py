"""The rows of some trials of a plan."""

from __future__ import annotations

import hashlib
import re

import numpy as np
import pyarrow as pa

from punctura import __version__, batch
from punctura.batches import BatchResult
from punctura.errors import ConfigurationError, Problem
from punctura.scene.build import scene_text
from punctura.study.design import Design
from punctura.study.folder import MARK, StudyError
from punctura.study.plan import Plan


def run_trials(
    plan: Plan, trials: Design, begin: int, threads: int | None = None, duration: float | None = None
) -> BatchResult:
    """These trials, which begin at row `begin`. duration: s; default: the plan's. Raises ConfigurationError."""
    try:
        return batch(
            plan.scene,
            plan.motion,
            vary=trials.values,
            seeds=trials.seeds,
            duration=plan.duration if duration is None else duration,
            plant=plan.plant,
            hand=plan.hand,
            threads=threads,
        )
    except ConfigurationError as bad:
        raise ConfigurationError([_in_row(problem, begin) for problem in bad.problems], str(plan.path)) from None
    except MemoryError as bad:
        raise StudyError(f"{plan.path}: {bad} Give a smaller chunk.") from None


def _in_row(problem: Problem, begin: int) -> Problem:
    """The problem of a trial, "trial 2: ...", as that of its row."""
    trial = re.match(r"trial (\d+): ", problem.path)
    return (
        problem
        if trial is None
        else problem._replace(path=f"row {begin + int(trial[1])}: {problem.path[trial.end() :]}")
    )


def chunk_table(plan: Plan, trials: Design, begin: int, threads: int | None = None) -> pa.Table:
    """The rows of these trials, as they are in the table of a study."""
    return _rows(plan, run_trials(plan, trials, begin, threads), begin)


def row_schema(plan: Plan, trials: Design) -> pa.Schema:
    """The columns of the table of a study, and the digest of what its rows depend on."""
    one = _rows(plan, run_trials(plan, trials.part(0, 1), 0, threads=1, duration=0.0), 0)
    return one.schema.with_metadata({MARK: _digest(plan, trials)})


def _rows(plan: Plan, result: BatchResult, begin: int) -> pa.Table:
    table = result.to_arrow()
    kept = [*(one.path for one in plan.variables), "seed", *plan.results]
    names = [*kept, *([] if "fault" in kept else ["fault"])]
    row = pa.array(np.arange(begin, begin + len(result), dtype=np.int64))
    return table.select(names).add_column(0, "row", row)


def _digest(plan: Plan, trials: Design) -> str:
    """What the rows depend on."""
    parts = repr((__version__, plan.file.chunk, plan.duration, plan.results, plan.motion, plan.plant, plan.hand))
    found = hashlib.sha256(parts.encode() + scene_text(plan.scene).encode())
    for path, column in trials.values.items():
        found.update(path.encode() + column.tobytes())
    found.update(trials.seeds.tobytes())
    return found.hexdigest()
