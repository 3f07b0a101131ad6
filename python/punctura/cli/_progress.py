"""A progress bar, shown only on a terminal and after one second."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import TextIO

from rich.console import Console
from rich.progress import Progress

PATIENCE_S = 1.0


@contextmanager
def progress_bar(what: str, stream: TextIO | None = None) -> Iterator[Callable[[float], None]]:
    """Gives a function that takes the finished share, 0 to 1."""
    console = Console(file=stream or sys.stderr)
    began = time.monotonic()
    with ExitStack() as stack:
        bar: Progress | None = None
        task = None

        def tell(share: float) -> None:
            nonlocal bar, task
            if bar is None and console.is_terminal and time.monotonic() - began > PATIENCE_S:
                bar = stack.enter_context(Progress(console=console, transient=True))
                task = bar.add_task(what, total=1.0)
            if bar is not None and task is not None:
                bar.update(task, completed=share)

        yield tell
