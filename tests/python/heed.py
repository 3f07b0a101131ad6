"""Resets signals to their state in a terminal, even if the tests were started by nohup or in the background."""

import signal


def heed_signals():
    """For preexec_fn: runs in the new process before its program."""
    for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT", "SIGTSTP"):
        signal.signal(getattr(signal, name), signal.SIG_DFL)
