"""Ends a command that got a signal."""

from __future__ import annotations

import signal
import sys
from typing import NoReturn

from punctura.cli._status import SIGNAL
from punctura.cli._streams import give_up_stdout
from punctura.process.signals import Ended, ignore_more_signals


def leave(end: Ended, more: str = "") -> NoReturn:
    """Prints the signal's name, and exits with its status."""
    ignore_more_signals()
    give_up_stdout()
    words = "interrupted" if end.number == signal.SIGINT else f"ended by {end.name}"
    print(f"punctura: {words}{more}", file=sys.stderr)
    sys.exit(SIGNAL + end.number)
