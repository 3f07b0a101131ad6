"""In place of the computation of a trace, in a process of its own."""

import os
import signal
from pathlib import Path

from punctura.identify.folder import _failed


def dies(path, task):
    """One trace ends its process, as a lack of memory does."""
    if path.endswith("dies.csv"):
        os.kill(os.getpid(), signal.SIGKILL)
    return _failed(Path(path), task, "was reached"), False
