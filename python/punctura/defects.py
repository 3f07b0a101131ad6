"""Tells a defect of Punctura from a mistake of its user, and keeps the traceback of a defect in a log."""

import contextlib
import logging
import os
import platform
import sys
import threading
import time
import traceback
from io import TextIOWrapper
from logging.handlers import RotatingFileHandler
from opcode import opmap
from pathlib import Path
from types import TracebackType

from punctura import __version__
from punctura.errors import sentence_of
from punctura.files.names import user_folder
from punctura.files.whole_file import private, private_folder

DEBUG = "PUNCTURA_DEBUG"  # 1: every traceback is printed on the terminal, too
PATIENCE_S = 10.0  # for the log and the terminal, of a program that ends
AGAIN_S = 60.0  # after this time the same defect is logged again: some occur in every turn of a loop
_RAISE = opmap["RAISE_VARARGS"]
_logged: dict[tuple[object, ...], float] = {}


def log_file() -> Path:
    """The log of defects, in the operating system's folder for the state of this user's programs."""
    return user_folder("state") / "defects.log"


def is_defect(error: BaseException) -> bool:
    """Whether Punctura did not foresee this error.

    It has foreseen its own classes, errors of the system (OSError, MemoryError), and each ValueError of a `raise` in
    its own code. A ValueError of numpy or Arrow says that Punctura has called them wrongly.
    """
    if type(error).__module__.partition(".")[0] == "punctura" or isinstance(error, OSError | MemoryError):
        return False
    innermost = _innermost(error)
    if not isinstance(error, ValueError) or innermost is None:
        return True
    package = str(innermost.tb_frame.f_globals.get("__package__")).partition(".")[0]
    return package != "punctura" or innermost.tb_frame.f_code.co_code[innermost.tb_lasti] != _RAISE


def explain(error: BaseException, patience: float = 0.0) -> str:
    """The sentence about an error for a person; logs a defect. Never raises, and does not wait for the disk.

    patience: PATIENCE_S in a program that ends.
    """
    defect, debug = is_defect(error), os.environ.get(DEBUG, "") not in ("", "0")
    new = defect and _is_new(error)
    if new or (debug and not defect):
        with contextlib.suppress(RuntimeError):  # no more threads
            writer = threading.Thread(target=_keep, args=(error, new, debug), name="punctura-defect", daemon=True)
            writer.start()
            writer.join(patience)
    if defect:
        return f"a defect, please report it: {_brief(error)}. Its traceback is in {log_file()}"
    return "there is not enough memory" if isinstance(error, MemoryError) else sentence_of(error)


def _brief(error: BaseException) -> str:
    try:
        return repr(error)
    except Exception:  # a defect of its own
        return type(error).__name__


def _innermost(error: BaseException) -> TracebackType | None:
    """The place that raised it; None if nothing did."""
    place = error.__traceback__
    while place is not None and place.tb_next is not None:
        place = place.tb_next
    return place


def _keep(error: BaseException, log: bool, show: bool) -> None:
    """Prints the traceback where the log cannot be written, too."""
    with contextlib.suppress(Exception):  # such as of a closed terminal
        text = "".join(traceback.format_exception(error))
        try:
            if log:
                _append(text)
        except OSError as bad:
            text, show = f"punctura: the log cannot be written: {sentence_of(bad)}\n{text}", True
        if show:
            print(text, end="", file=sys.stderr, flush=True)


def _is_new(error: BaseException) -> bool:
    innermost = _innermost(error)
    place = (type(error), innermost and (innermost.tb_frame.f_code, innermost.tb_lineno))
    now = time.monotonic()
    is_new = now - _logged.get(place, -AGAIN_S) >= AGAIN_S
    _logged[place] = now if is_new else _logged[place]
    return is_new


def _append(text: str) -> None:
    """Raises OSError."""
    log = log_file()
    private_folder(log.parent)
    about = f"Punctura {__version__}, Python {platform.python_version()}, {platform.platform()}\n{text}"
    record = logging.LogRecord("punctura", logging.ERROR, "", 0, about, None, None)
    handler = _Log(log, maxBytes=1_000_000, backupCount=3, encoding="utf-8", errors="backslashreplace", delay=True)
    handler.setFormatter(logging.Formatter("%(asctime)s, process %(process)d: %(message)s"))
    try:
        handler.emit(record)
    finally:
        handler.close()


class _Log(RotatingFileHandler):
    """Its files are the user's alone, and its errors are raised."""

    def _open(self) -> TextIOWrapper:
        return open(self.baseFilename, "a", encoding=self.encoding, errors=self.errors, opener=private)

    def handleError(self, record: logging.LogRecord) -> None:
        raise
