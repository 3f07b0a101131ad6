"""In place of the computation of a trace, in a process of its own."""

import os
import signal
import threading
from pathlib import Path

from punctura.identify.folder import _failed


def dies(path, task):
    """One trace ends its process, as a lack of memory does."""
    if path.endswith("dies.csv"):
        os.kill(os.getpid(), signal.SIGKILL)
    return _failed(Path(path), task, "was reached"), False


def goes_on(path, task):
    """One trace is there at once; the others take for ever."""
    if not path.endswith("a.csv"):
        threading.Event().wait()
    return _failed(Path(path), task, "was reached"), False


def holds_ctrl_c(path, task):
    """Tells whether this process holds Ctrl-C back."""
    held = signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, [])
    return _failed(Path(path), task, "held" if held else "a traceback"), False
