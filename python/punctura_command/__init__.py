"""The program `punctura`. It imports the package late: before that, Ctrl-C ends the program without a traceback."""

import os
import signal
from types import FrameType


def main() -> None:
    """`punctura.cli.main`, which has its own handlers for signals."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # not what the caller ignores
        signal.signal(signal.SIGINT, _interrupted)
    from punctura.cli import main as run

    run()


def _interrupted(number: int, _frame: FrameType | None) -> None:
    """Ends at once. An exception could come out of the import of any module, and some turn it into another one."""
    os.write(2, b"punctura: interrupted\n")
    os._exit(128 + number)
