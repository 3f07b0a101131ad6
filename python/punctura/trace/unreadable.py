"""The words for a file that a reader of its kind cannot read."""

from __future__ import annotations

import errno
from pathlib import Path

from punctura.trace.trace import TraceError

_BEGINNINGS = {
    "Parquet": b"PAR1",
    "MAT": b"MATLAB",
    "XLSX": b"PK",
    "XLS": b"\xd0\xcf\x11\xe0",
    "HDF5": b"",
    "TDMS": b"TDS",
    "ROS bag": b"",
}


def unreadable(path: Path, kind: str, error: Exception) -> TraceError:
    """What is wrong with a file that is named as a `kind`, and what to do. error: the reader's.

    Raises OSError; also `error` itself if it is one of the system. Those of readers for damaged data have no number.
    """
    if isinstance(error, OSError) and error.errno not in (None, errno.EINVAL):  # EINVAL: a place before the file
        raise error
    with path.open("rb") as file:
        head = file.read(8)
    if not head:
        return TraceError(f"{path}: is empty; export or copy it again")
    if not head.startswith(_BEGINNINGS[kind]):
        return TraceError(
            f"{path}: is no {kind} file, although its name ends in {path.suffix}. If it is another kind of file, give "
            "it that ending, for example .csv; else export it again"
        )
    cause = (str(error).splitlines() or [type(error).__name__])[0].rstrip(".")
    return TraceError(
        f"{path}: is damaged or cut off: it begins as {kind}, and the rest cannot be read ({cause}). Copy it again, or "
        "export it again"
    )
