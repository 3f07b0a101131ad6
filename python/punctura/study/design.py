"""The trials of a plan, and the rows of some of them."""

from __future__ import annotations

import hashlib
import re
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import pyarrow as pa

from punctura import __version__, batch
from punctura.batches import BatchResult, grid
from punctura.batches.inputs import enough_memory
from punctura.errors import MISSING, ConfigurationError, Problem
from punctura.extras import optional
from punctura.scene.build import scene_text
from punctura.study.folder import MARK, StudyError
from punctura.study.plan import MOST_TRIALS, Plan, VariableTable

Array = npt.NDArray[np.float64]


class Design(NamedTuple):
    """The trials: values by path, each (n,), SI, and seeds (n,)."""

    values: dict[str, Array]
    seeds: npt.NDArray[np.uint64]

    def part(self, begin: int, end: int) -> Design:
        """The trials from `begin` up to `end`."""
        return Design({path: column[begin:end] for path, column in self.values.items()}, self.seeds[begin:end])


def design(plan: Plan) -> Design:
    """The trials of a plan. The same plan gives the same trials. Raises ConfigurationError for too many."""
    file = plan.file
    trials = trials_of(plan)
    try:
        enough_memory(trials * (8.0 + 32 * len(plan.variables)), f"the values of {trials} trials", "Take fewer trials.")
    except MemoryError as bad:
        raise ConfigurationError([Problem("", MISSING, str(bad))], str(plan.path)) from None
    seeds = np.uint64(file.seed) + np.arange(trials, dtype=np.uint64)
    if file.method == "grid":
        values = {one.path: [float(v) for v in one.values or ()] for one in plan.variables}
        return Design(grid(values), seeds)
    n, count = file.samples or 0, len(plan.variables)
    optional("scipy", "study", "punctura study")
    from scipy.stats import qmc

    if file.method == "monte_carlo":
        shares = np.random.default_rng(file.seed).random((n, count))
    elif file.method == "latin_hypercube":
        shares = qmc.LatinHypercube(count, seed=file.seed).random(n)
    else:
        both = qmc.Sobol(2 * count, seed=file.seed).random(n)
        a, b = both[:, :count], both[:, count:]
        mixed = [np.where(np.arange(count) == k, b, a) for k in range(count)]
        shares = np.concatenate([a, b, *mixed])
        # A trial of a mixed matrix has the hand's randomness of its row in A: it differs from it in one variable only.
        seeds = np.concatenate([seeds[: 2 * n], *[seeds[:n]] * count])
    columns = {one.path: _drawn(one, shares[:, k]) for k, one in enumerate(plan.variables)}
    return Design(columns, seeds)


def trials_of(plan: Plan) -> int:
    """The number of trials. Raises ConfigurationError if there are too many."""
    count = len(plan.variables)
    if plan.file.method == "grid":
        n = int(np.prod([float(len(one.values or ())) for one in plan.variables]))
    else:
        n = (plan.file.samples or 0) * (count + 2 if plan.file.method == "sobol" else 1)
    if n > MOST_TRIALS:
        raise ConfigurationError([Problem("", MISSING, f"has {n} trials; at most {MOST_TRIALS}")], str(plan.path))
    return n


def _drawn(one: VariableTable, shares: Array) -> Array:
    """Numbers of a distribution from shares in [0, 1), by its inverse; low and high cut the distribution off."""
    from scipy import stats

    def number(key: str) -> float:
        return float(getattr(one, key))

    if one.distribution == "uniform":
        low, high = number("low"), number("high")
        return np.ascontiguousarray(low + shares * (high - low))
    law: Any = (
        stats.norm(number("mean"), number("sd"))
        if one.distribution == "normal"
        else stats.lognorm(number("sigma"), scale=number("median"))
    )
    begin = 0.0 if one.low is None else float(law.cdf(number("low")))
    end = 1.0 if one.high is None else float(law.cdf(number("high")))
    if not begin < end:
        reason = f"the {one.distribution} distribution has practically no numbers between low and high; widen them"
        raise ConfigurationError([Problem(one.path, MISSING, reason)])
    inside = np.clip(begin + shares * (end - begin), 2.0**-60, 1 - 2.0**-53)
    return np.ascontiguousarray(law.ppf(inside))


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
