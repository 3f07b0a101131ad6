"""Shows the progress of a long computation: a function of the caller, or a bar on the terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from time import monotonic
from typing import TYPE_CHECKING, TextIO, TypeAlias

if TYPE_CHECKING:
    from rich.progress import Progress as Bar

Report: TypeAlias = Callable[[float], None]
# The argument `progress`: None, a function that takes the finished share (0 to 1), or True for a bar.
Progress: TypeAlias = Report | bool | None

PATIENCE_S = 1.0


@contextmanager
def reporting(progress: Progress, what: str = "running") -> Iterator[Report]:
    """Gives the function to call with the finished share. Raises TypeError."""
    if progress is None or progress is False:
        yield lambda share: None
    elif progress is True:
        with progress_bar(what) as report:
            yield report
    elif callable(progress):
        yield progress
    else:
        raise TypeError(f"progress must be a function of the finished share, or True for a bar, not {progress!r}")


@contextmanager
def progress_bar(what: str, stream: TextIO | None = None) -> Iterator[Report]:
    """A bar that is shown only on a terminal and after one second."""
    stream = stream or sys.stderr
    if not stream.isatty():
        yield lambda share: None
        return
    began = monotonic()
    with ExitStack() as stack:
        bar: Bar | None = None

        def report(share: float) -> None:
            nonlocal bar
            if bar is None and monotonic() - began > PATIENCE_S:
                from rich.console import Console  # only here: it takes long to import
                from rich.progress import Progress as Bar

                bar = stack.enter_context(Bar(console=Console(file=stream), transient=True))
                bar.add_task(what, total=1.0)
            if bar is not None:
                bar.update(bar.task_ids[0], completed=share)

        yield report
