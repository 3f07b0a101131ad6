"""`punctura example`: files to try the other verbs with."""

from __future__ import annotations

import enum
import shlex
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, NamedTuple

import numpy as np
import typer
from numpy.typing import NDArray

from punctura import Coupling, Membrane, Needle, Proxy1d, ThickLaw
from punctura.errors import ConfigurationError, Problem
from punctura.files.whole_file import target_problems, whole_file

Columns = Mapping[str, NDArray[np.float64]]


def motion() -> Columns:
    """A motion for the ready scenes: from 5 mm above the surface to 11 mm below it in 2 s, at 1600 Hz."""
    time = np.arange(3200) / 1600
    return {"time_s": time, "x_m": 0 * time, "y_m": 5e-3 - 8e-3 * time, "z_m": 0 * time}


def trace() -> Columns:
    """A trace as a testing machine measures it, but simulated: in, at rest, and out, with noise of 10 mN rms."""
    step = 0.01  # s
    time = np.arange(0, 7, step)
    depth = np.interp(time, [0, 3, 4, 7], [0, 15e-3, 15e-3, 0])
    wall = ThickLaw(Needle(1.2e-3, 0.4), Membrane(600, 0.3, 0.2, 0.5e-3))
    force = -Proxy1d(wall, Coupling(4000, 1.0), step).run(depth - 5e-3).force
    noise = 0.01 * np.random.default_rng(1).standard_normal(len(time))
    return {"time_s": time, "depth_mm": 1e3 * depth, "force_N": force + noise}


class Kind(enum.Enum):
    MOTION = "motion"
    TRACE = "trace"


class Example(NamedTuple):
    columns: Callable[[], Columns]
    next_step: str


EXAMPLES = {
    Kind.MOTION: Example(motion, "punctura simulate venipuncture --motion {file} --out force.csv"),
    Kind.TRACE: Example(
        trace, "punctura identify {file} --needle diameter_mm=1.2,tip_angle_rad=0.4 --scene found.toml"
    ),
}


def command(
    kind: Annotated[Kind, typer.Argument(help="A motion of the needle, or a trace of force against depth.")],
    out: Annotated[
        Path | None, typer.Option("--out", help="File to write; else motion.csv or trace.csv here.", metavar="OUT.csv")
    ] = None,
) -> None:
    """Writes a small file to try other verbs with.

    It prints the command that reads the file. The trace is simulated, with one membrane and noise of 10 mN rms.
    """
    example = EXAMPLES[kind]
    file = out or Path(f"{kind.value}.csv")
    problems = target_problems(file, (".csv",))
    if file.exists() and not problems:
        problems.append("exists already, and an example replaces no file; give --out another name")
    if problems:
        raise ConfigurationError([Problem("--out", str(file), problem) for problem in problems])
    columns = example.columns()
    rows = np.column_stack(list(columns.values()))
    with whole_file(file, replace=False) as path:
        np.savetxt(path, rows, fmt="%.9g", delimiter=",", header=",".join(columns), comments="")
    next_step = example.next_step.format(file=shlex.quote(str(file)))
    typer.echo(f"{file}: {len(rows)} rows of {', '.join(columns)}\nNext: {next_step}")
