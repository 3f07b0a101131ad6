"""Shows the progress of a long computation: a function of the caller, or a bar on the terminal or in a notebook."""

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from time import monotonic
from typing import Any, TextIO, TypeAlias

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
    """A bar that is shown only in a notebook or on a terminal, and after one second."""
    stream = stream or sys.stderr
    in_notebook = _in_notebook()
    if not in_notebook and not stream.isatty():
        yield lambda share: None
        return
    began = monotonic()
    with ExitStack() as stack:
        bar: Report | None = None

        def report(share: float) -> None:
            nonlocal bar
            if bar is None and monotonic() - began > PATIENCE_S:
                bar = _notebook_bar() if in_notebook else stack.enter_context(_terminal_bar(what, stream))
            if bar is not None:
                bar(share)

        yield report


@contextmanager
def _terminal_bar(what: str, stream: TextIO) -> Iterator[Report]:
    from rich.console import Console  # only here: it takes long to import
    from rich.progress import Progress as Bar

    with Bar(console=Console(file=stream), transient=True) as bar:
        task = bar.add_task(what, total=1.0)
        yield lambda share: bar.update(task, completed=share)


def _in_notebook() -> bool:
    """Whether this is the kernel of a notebook, which has no terminal."""
    shell = sys.modules.get("IPython")
    return shell is not None and hasattr(shell.get_ipython(), "kernel")


def _notebook_bar() -> Report:
    from IPython.display import ProgressBar

    kind: Any = ProgressBar  # without types
    bar = kind(100)
    bar.display()

    def report(share: float) -> None:
        if round(100 * share) != bar.progress:  # each assignment is a message to the page
            bar.progress = round(100 * share)

    return report
