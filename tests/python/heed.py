"""Signals as a program has them that was typed in a terminal, whatever has started the tests (nohup, a script's &)."""

import signal


def heed_signals():
    """In the new process, before its program: preexec_fn."""
    for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT", "SIGTSTP"):
        signal.signal(getattr(signal, name), signal.SIG_DFL)
